//! The chart of stops from soft to rigid: diagrams, a map of the motions, and folds.

use anyhow::Result;

use super::folds::Folds;
use super::stops::{CLEARANCE, grazing};
use super::subharmonics::{NARROW, Subharmonic};
use super::swept::{RANGE, SweptStop, kind};
use super::{DECADES, SUBHARMONIC};
use crate::figure::Figure;
use softstop_draw::{Align, Chart, Layer, Stroke, style};
use softstop_dynamics::motion_kind::MotionClass;
use softstop_explore::palette::{motion_color, motion_keys};

/// Diagrams in a row.
const ACROSS: usize = 2;
const GRAZING: Stroke = Stroke::dashed(style::INK, 1.2, (5.0, 4.0));
const FOLD: Stroke = Stroke::solid(style::INK, 2.0);
/// Radius of a dot of the diagrams.
const DOT: f64 = 1.0;

/// The frequency of a bend of a branch.
type Bend = fn(&Folds) -> Option<f64>;

/// The diagrams of stops `drawn`; those of the map and the folds by rising stiffness.
pub(super) fn chart(
    figure: &Figure,
    (drawn, map): (&[SweptStop], &[SweptStop]),
    folds: &[Folds],
    found: &[Subharmonic],
) -> Result<Chart> {
    // What is linear, the first, grows without regard to the clearance.
    let points = drawn[1..].iter().flat_map(SweptStop::points).flatten();
    let top = 1.05 * points.map(|point| point.1).fold(0.0, f64::max);
    let mut chart = figure.picture([
        Vec::new(),
        map_layers(map, folds),
        widths(folds),
        orders(found),
    ])?;
    let template = chart.panels.remove(0);
    let highest = found.iter().filter(|motion| motion.impacts == 1);
    let highest = highest.map(|motion| motion.periods).max();
    let highest = highest.unwrap_or(2).max(2);
    if let Some(orders) = chart.panels.last_mut() {
        orders.y.ends = [1.4, highest as f64 + 0.6].map(Some);
        let ticks = (2..=highest).map(|order| (order as f64, order.to_string()));
        orders.y.ticks = Some(ticks.collect());
    }
    let diagrams = drawn.iter().enumerate().map(|(index, swept)| {
        let mut panel = template.clone();
        panel.title = swept.law.name();
        panel.at = (index % ACROSS, index / ACROSS);
        panel.y.ends = [0.0, top].map(Some);
        if panel.at.0 > 0 {
            panel.y.name.clear();
        }
        panel.layers = diagram(swept).collect();
        panel
    });
    chart.panels.splice(0..0, diagrams);
    Ok(chart)
}

/// On the way up; a dot where the way down ends in another motion.
fn map_layers(map: &[SweptStop], folds: &[Folds]) -> Vec<Layer> {
    let (columns, rows) = (map[0].up.len(), map.len());
    let cells = map.iter().flat_map(|swept| &swept.up);
    let colors = cells.map(|step| motion_color(kind(step)));
    let place = |(low, high): (f64, f64), index: usize, count: usize| {
        low + (high - low) * (index as f64 + 0.5) / count as f64
    };
    let mut differs = [Vec::new(), Vec::new()];
    for (row, swept) in map.iter().enumerate() {
        let cells = swept.up.iter().zip(&swept.down).enumerate();
        let others = cells.filter(|(_, (up, down))| kind(up) != kind(down));
        let stiffness = 10f64.powf(place(DECADES, row, rows));
        for (column, (up, _)) in others {
            let is_dark = matches!(kind(up), MotionClass::Chaos | MotionClass::Unsettled);
            differs[usize::from(is_dark)].push((place(RANGE, column, columns), stiffness));
        }
    }
    let [on_light, on_dark] = differs;
    let mut layers = vec![
        Layer::cells(columns, colors),
        Layer::dots(on_light, 0.9, style::INK).named("falling η differs"),
        Layer::dots(on_dark, 0.9, style::PAPER),
    ];
    layers.extend(grazes());
    let upper = Layer::text((grazing(CLEARANCE).1, 0.1), Align::Left, "g₀");
    layers.push(upper.moved(6.0, -6.0).plated());
    let strong: Bend = |fold| Some(fold.strong?.0);
    let ends: [(&str, Bend); 2] = [("s_SN", strong), ("s_PD", |fold| fold.flip)];
    for (name, eta) in ends {
        let points = folds.iter();
        let points = points.filter_map(|fold| Some((eta(fold)?, fold.stiffness)));
        layers.push(Layer::line(points, FOLD));
        let last = folds.iter().rfind(|fold| fold.strong.is_some());
        if let Some(eta) = last.and_then(eta) {
            let text = Layer::text((eta, 10f64.powf(DECADES.1)), Align::Left, name);
            layers.push(text.moved(8.0, 24.0).plated());
        }
    }
    layers.extend(motion_keys(|class| {
        let mut steps = map.iter().flat_map(|swept| &swept.up);
        steps.any(|step| kind(step) == class)
    }));
    layers
}

/// How wide the regions of weak impacts and of hysteresis are, over the stiffness, logarithmic.
fn widths(folds: &[Folds]) -> Vec<Layer> {
    let widths = folds.iter().filter_map(Folds::widths);
    let widths: Vec<[f64; 3]> = widths.filter(|it| it[1] > 0.0).collect();
    let hysteresis = "hysteresis, from s_SN back to the weak fold";
    let weak = "weak z = 1, from g₀ to its fold";
    let curves = [
        (2, style::DESIGN, 24.0, hysteresis),
        (1, style::OPTIMUM, -6.0, weak),
    ];
    let layers = curves.into_iter().flat_map(|(which, color, shift, name)| {
        let points = widths.iter().map(|it| (it[0], it[which]));
        let points: Vec<(f64, f64)> = points.collect();
        let named = points.get(points.len() / 4).map(|at| {
            let text = Layer::text(*at, Align::Left, name).moved(12.0, shift);
            text.colored(color).plated()
        });
        let line = Layer::line(points.iter().copied(), Stroke::solid(color, 2.0));
        [line, Layer::dots(points, 3.4, color)]
            .into_iter()
            .chain(named)
    });
    layers.collect()
}

/// The frequencies at which there are motions z = 1/n.
fn orders(found: &[Subharmonic]) -> Vec<Layer> {
    let stops = SUBHARMONIC.into_iter().enumerate();
    let stops = stops.map(|(index, stiffness)| {
        let own = found
            .iter()
            .filter(|it| it.impacts == 1 && it.stiffness == stiffness);
        // The dots of each stop are a little lower than those of the one before.
        let shift = 0.17 * (index as f64 - 1.0);
        let points = own.map(|motion| (motion.eta, motion.periods as f64 - shift));
        let color = style::ordered(index, SUBHARMONIC.len());
        Layer::dots(points, 3.2, color).named(format!("k₂/k₁ = {stiffness}"))
    });
    let name = "g₀: beyond it z = 0 coexists";
    let eta = grazing(NARROW).1;
    let edge = Layer::vertical(eta, GRAZING, name);
    stops.chain([edge]).collect()
}

/// The diagram of a stop.
fn diagram(swept: &SweptStop) -> impl Iterator<Item = Layer> {
    let [up, down] = swept.points();
    let down = Layer::dots(down, DOT, style::FALLING).named("η falling only");
    let up = Layer::dots(up, DOT, style::RISING).named("η rising");
    grazes().into_iter().chain([down, up])
}

/// Where the motion without impacts grazes.
fn grazes() -> [Layer; 2] {
    let (lower, upper) = grazing(CLEARANCE);
    [lower, upper].map(|eta| Layer::vertical(eta, GRAZING, ""))
}
