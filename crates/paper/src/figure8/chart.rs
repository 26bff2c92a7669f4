//! The picture of figure 8: one diagram with its zooms and numbered bifurcations (Peterka 2003).

use anyhow::Result;
use softstop::Ratios;
use softstop_dynamics::{Chain, SweepStep};

use super::{Bifurcation, Diagram};
use crate::diagram::{self, WAYS, by_way, dots, steps};
use crate::figure::Figure;
use crate::figure9;
use crate::table1::report;
use softstop_draw::{Align, Chart, Layer, Panel, Stroke, style};

/// Radius of a dot.
const DOT: f64 = 0.65;
/// Above this frequency bifurcations are numbered in the overview.
const BEYOND: f64 = 1.03;
/// Motions that are met on no sweep from rest.
const ISOLATED: (&str, &str) = ("on none of these sweeps", style::NEITHER_WAY);
/// The line at a bifurcation.
const MARK: Stroke = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
/// Share of the range that a motion has to fill to be named.
const LEAST: f64 = 0.02;

/// The overview first, then the zooms, with steps of motions that no sweep from rest reaches.
pub(super) fn chart(
    figure: &Figure,
    diagrams: &[Diagram],
    isolated: &[SweepStep],
    bifurcations: &[Bifurcation<'_>],
) -> Result<Chart> {
    let letters = figure9::letters()?;
    let mut chart = figure.chart.clone();
    for (index, (panel, diagram)) in chart.panels.iter_mut().zip(diagrams).enumerate() {
        let (low, high) = diagram.part.range;
        let is_own = |eta: f64| low <= eta && eta <= high;
        let is_numbered = |eta: f64| is_own(eta) && (index > 0 || eta > BEYOND);
        let inside = isolated.iter().filter(|step| is_own(step.value));
        diagram.draw(&inside.collect::<Vec<_>>(), panel);
        let numbered = bifurcations.iter().filter(|it| is_numbered(it.1.eta));
        panel
            .layers
            .extend(numbered.map(|it| Layer::vertical(it.1.eta, MARK, words(it))));
        if index == 0 {
            for Diagram { part: zoom, .. } in &diagrams[1..] {
                let stripe = [zoom.range, (f64::NEG_INFINITY, f64::INFINITY)];
                let stripe = Layer::boxes([stripe], style::ALLOWED, 0.22);
                panel.layers.insert(0, stripe);
                let line = Stroke::solid(style::ALLOWED, 0.5);
                let middle = f64::midpoint(zoom.range.0, zoom.range.1);
                let name = Layer::vertical(middle, line, &*zoom.name);
                panel.layers.push(name);
            }
        } else {
            let letters = letters.iter().filter(|it| is_own(it.1));
            let [low, high] = panel.y.ends.map(|end| end.unwrap_or(0.0));
            let arrow = |eta| {
                let tail = low + 0.05 * (high - low);
                Layer::arrow((eta, tail), (eta, low), Stroke::solid(style::INK, 1.0))
            };
            panel.layers.extend(letters.flat_map(|(letters, eta)| {
                let text = Layer::text((*eta, low), Align::Middle, letters);
                [arrow(*eta), text.moved(0.0, -18.0).plated()]
            }));
        }
    }
    Ok(chart)
}

/// Number, direction and symbols.
fn words((number, found): &Bifurcation<'_>) -> String {
    let arrow = match found.direction() {
        "both" => '↔',
        "up" => '→',
        _ => '←',
    };
    let symbols = found.transition.symbols().replace(" -> ", ", ");
    format!("{number} {arrow} {symbols}")
}

impl Diagram<'_> {
    /// Draws it into a panel as high as the velocities, with the names of motions beside them.
    fn draw(&self, isolated: &[&SweepStep], panel: &mut Panel) {
        let all = steps(self.ways).chain(isolated.iter().copied());
        let top = all.map(SweepStep::hardest_impact).fold(0.0, f64::max);
        let top = if top > 0.0 { top } else { 1.0 };
        let fleeting = steps(self.fleeting).filter(|step| step.hardest_impact() > 0.0);
        let fleeting = Layer::dots(fleeting.flat_map(dots), 0.8 * DOT, style::OPTIMUM);
        let [up, down] = [0, 1].map(|way: usize| {
            let steps = self.ways[way].rising_steps();
            let all = 0..steps.len();
            all.map(|index| (steps[index], is_passing(&steps, index)))
                .collect::<Vec<_>>()
        });
        let ways = by_way(&up, &down, |it| it.0).into_iter().zip(WAYS);
        let ways = ways.map(|(steps, (name, color))| {
            let stays = steps.into_iter().filter(|it| !it.1);
            Layer::dots(stays.flat_map(|it| dots(it.0)), DOT, color).named(name)
        });
        let settled = isolated.iter().filter(|step| step.is_settled());
        let settled = Layer::dots(settled.flat_map(|step| dots(step)), DOT, ISOLATED.1);
        let (low, high) = self.part.range;
        let names = self.names(isolated).into_iter().map(|(at, name)| {
            // Beside the frame there is no room for one half of a name.
            let align = match (at.0 - low) / (high - low) {
                ..0.06 => Align::Left,
                0.94.. => Align::Right,
                _ => Align::Middle,
            };
            Layer::text(at, align, name).moved(0.0, -7.0).plated()
        });
        let layers = [fleeting].into_iter().chain(ways);
        panel.x.ends = [low, high].map(Some);
        panel.y.ends = [-0.16 * top, 1.12 * top].map(Some);
        let layers = layers.chain([settled.named(ISOLATED.0)]).chain(names);
        panel.layers = layers.collect();
    }

    /// Each motion once: eta, X'- and its name, in the middle of its longest stretch.
    fn names(&self, isolated: &[&SweepStep]) -> Vec<((f64, f64), String)> {
        let (low, high) = self.part.range;
        let mut names: Vec<(f64, (f64, f64), String)> = Vec::new();
        let ways = self.ways.iter().map(Chain::rising_steps);
        for steps in ways.chain([isolated.to_vec()]) {
            // Neighbouring steps of one regime.
            for run in steps.chunk_by(|a, b| a.motion.regime() == b.motion.regime()) {
                let span = run[run.len() - 1].value - run[0].value;
                let step = run[run.len() / 2];
                let Some(name) = name(step).filter(|_| span >= LEAST * (high - low)) else {
                    continue;
                };
                let entry = (span, (step.value, step.hardest_impact()), name);
                match names.iter_mut().find(|known| known.2 == entry.2) {
                    Some(known) if known.0 < span => *known = entry,
                    Some(_) => {}
                    None => names.push(entry),
                }
            }
        }
        names.into_iter().map(|entry| (entry.1, entry.2)).collect()
    }
}

/// A periodic motion's name.
fn name(step: &SweepStep) -> Option<String> {
    step.motion.regime()?;
    let scene = Ratios::unloaded().scene().ok()?;
    Some(report::name(&diagram::motion(&scene, step)))
}

/// True if a step shows a motion on its way from one periodic motion to another.
fn is_passing(steps: &[&SweepStep], index: usize) -> bool {
    let is_settled = |step: &&&SweepStep| step.is_settled();
    let before = steps[..index].iter().rfind(is_settled);
    let after = steps[index + 1..].iter().find(is_settled);
    let repeats =
        |step: Option<&&SweepStep>| step.is_none_or(|step| step.motion.regime().is_some());
    !steps[index].is_settled() && repeats(before) && repeats(after)
}
