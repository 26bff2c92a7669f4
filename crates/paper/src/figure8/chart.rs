//! The picture of figure 8: one diagram with its zooms and numbered bifurcations (Peterka 2003).

use softstop_dynamics::Step;

use super::Diagram;
use super::band::{Bifurcation, LINE, SMALL, band, both_ways, spread};
use crate::diagram::{dots, same, steps};
use crate::figure9;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke, width};
use softstop_draw::style;

/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1240.0;
/// Size of letters, and of a dot.
const LETTERS: u32 = 14;
const DOT: f64 = 0.65;
/// Top of the overview, and height of the band of numbers above a panel.
const TOP: f64 = 122.0 + BAND;
const BAND: f64 = 86.0;
/// Left and right ends of the columns of zooms, and the height of the panels.
const COLUMNS: [(f64, f64); 2] = [(76.0, 612.0), (676.0, 1212.0)];
const HEIGHTS: (f64, f64) = (300.0, 330.0);
/// Room below a panel.
const BELOW: f64 = 62.0;
/// Above this frequency bifurcations are numbered in the overview.
const BEYOND: f64 = 1.03;
/// Colours of motions met both ways, up only, down only, and on no sweep from rest.
const BOTH: &str = "#444444";
const UP: &str = style::DESIGN;
const DOWN: &str = style::OPTIMUM;
const ISOLATED: &str = "#009E73";

/// The picture as PNG: the overview first, then the zooms, with steps of motions that no sweep from rest reaches.
pub(super) fn png(
    diagrams: &[Diagram],
    isolated: &[Step],
    bifurcations: &[Bifurcation],
    explanation: &str,
) -> Result<Vec<u8>, String> {
    let [overview, zooms @ ..] = diagrams else {
        return Err("nothing was swept".to_owned());
    };
    let first = TOP + HEIGHTS.0 + BELOW;
    let row = BAND + HEIGHTS.1 + BELOW;
    let rows = zooms.len().div_ceil(2) as f64;
    let mut pen = Pen::new(WIDTH, first + row * rows + 4.0);
    let title = "Bifurcation diagram for ρ = 10 (unloaded machine) and its zooms (a) to (d)";
    heading(&mut pen, (COLUMNS[0].0, 30.0), title, explanation);
    legend(&mut pen, 76.0);
    let area = (COLUMNS[0].0, TOP, COLUMNS[1].1 - COLUMNS[0].0, HEIGHTS.0);
    let beyond: Vec<_> = bifurcations.iter().filter(|it| it.eta > BEYOND).collect();
    let panel = overview.panel(area, isolated);
    let axes = Axes::new(LETTERS, Some("drive frequency η"), "X′₋", (10, 5));
    panel.ground(&mut pen, &axes);
    overview.content(&mut pen, &panel, isolated);
    parts(&mut pen, &panel, zooms);
    band(&mut pen, &panel, &beyond);
    panel.axes(&mut pen, &axes);
    overview.names(&mut pen, &panel);
    for (index, zoom) in zooms.iter().enumerate() {
        let (left, right) = COLUMNS[index % 2];
        let top = first + BAND + row * (index / 2) as f64;
        let panel = zoom.panel((left, top, right - left, HEIGHTS.1), isolated);
        let axes = Axes::new(LETTERS, Some("η"), "X′₋", (5, 5));
        panel.ground(&mut pen, &axes);
        zoom.content(&mut pen, &panel, isolated);
        let own = bifurcations.iter().filter(|it| zoom.shows(it.eta));
        band(&mut pen, &panel, &own.collect::<Vec<_>>());
        panel.axes(&mut pen, &axes);
        zoom.names(&mut pen, &panel);
        zoom.letters(&mut pen, &panel);
        let place = (left, top - BAND + 12.0);
        pen.heading(place, LETTERS + 1, Align::Left, zoom.part.name);
    }
    pen.png_at(SCALE)
}

/// Where the zooms are in the overview.
fn parts(pen: &mut Pen, panel: &Panel, zooms: &[Diagram]) {
    let (top, bottom) = (panel.area.1, panel.bottom());
    let mut wanted = Vec::new();
    for zoom in zooms {
        let (low, high) = zoom.part.range;
        let (from, to) = (panel.across(low), panel.across(high));
        let area = (from, top, (to - from).max(1.0), bottom - top);
        pen.tint(area, style::ALLOWED, 0.22);
        wanted.push((panel.across(f64::midpoint(low, high)), 30.0));
    }
    let places = spread(&wanted, (panel.area.0, panel.right()));
    for ((zoom, (x, _)), place) in zooms.iter().zip(wanted).zip(places) {
        let line = Stroke::solid(style::ALLOWED, 1.0);
        pen.line(&[(place, top - 16.0), (x, top)], line);
        let at = (place, top - 20.0);
        pen.text(at, LETTERS, Align::Middle, zoom.part.name);
    }
}

impl Diagram {
    fn shows(&self, eta: f64) -> bool {
        (self.part.range.0..=self.part.range.1).contains(&eta)
    }

    /// A panel as high as the velocities.
    fn panel(&self, area: Area, isolated: &[Step]) -> Panel {
        let isolated = isolated.iter().filter(|step| self.shows(step.value));
        let all = steps(&self.ways).chain(isolated).map(Step::hardest);
        let top = all.fold(0.0, f64::max);
        let top = if top > 0.0 { top } else { 1.0 };
        Panel::new(area, self.part.range, (-0.16 * top, 1.12 * top))
    }

    /// The dots.
    fn content(&self, pen: &mut Pen, panel: &Panel, isolated: &[Step]) {
        let fleeting = steps(&self.fleeting).filter(|step| step.hardest() > 0.0);
        panel.dots(pen, fleeting.flat_map(dots), 0.8 * DOT, DOWN);
        let [up, down] = [0, 1].map(|way: usize| self.ways[way].rising());
        let alike: Vec<bool> = up.iter().zip(&down).map(|(a, b)| same(a, b)).collect();
        let of = |steps: &[&Step], wanted: bool| -> Vec<(f64, f64)> {
            let own = (0..alike.len()).filter(|index| alike[*index] == wanted);
            let stays = own.filter(|index| !is_passing(steps, *index));
            stays.flat_map(|index| dots(steps[index])).collect()
        };
        let both = [of(&up, true), of(&down, true)].concat();
        let isolated = isolated.iter().filter(|step| step.is_settled());
        for (points, color) in [
            (both, BOTH),
            (of(&up, false), UP),
            (of(&down, false), DOWN),
            (isolated.flat_map(dots).collect(), ISOLATED),
        ] {
            panel.dots(pen, points.into_iter(), DOT, color);
        }
    }

    /// The names of motions beside them.
    fn names(&self, pen: &mut Pen, panel: &Panel) {
        for (eta, velocity, name) in &self.names {
            let (x, y) = panel.place((*eta, *velocity));
            let half = 0.5 * width(LETTERS - 1, name);
            let x = x.clamp(panel.area.0 + half + 4.0, panel.right() - half - 4.0);
            let (place, ink) = ((x, y - 7.0), (style::INK, true));
            pen.words(place, LETTERS - 1, Align::Middle, ink, name);
        }
    }

    /// The letters of Fig. 9 at their frequencies.
    fn letters(&self, pen: &mut Pen, panel: &Panel) {
        for (letters, eta) in figure9::letters() {
            if self.shows(eta) {
                let (x, y) = (panel.across(eta), panel.bottom());
                let line = Stroke::solid(style::INK, 1.0);
                pen.arrow((x, y - 13.0), (x, y - 1.0), line);
                let (place, ink) = ((x, y - 16.0), (style::INK, true));
                pen.words(place, SMALL + 1, Align::Middle, ink, &letters);
            }
        }
    }
}

fn legend(pen: &mut Pen, y: f64) {
    let entries = [
        (BOTH, "up and down"),
        (UP, "up only"),
        (DOWN, "down only"),
        (ISOLATED, "on none of these sweeps"),
    ];
    let mut x = COLUMNS[0].0;
    for (color, text) in entries {
        pen.tint((x, y - 11.0, 12.0, 12.0), color, 1.0);
        pen.text((x + 18.0, y), LETTERS, Align::Left, text);
        x += 18.0 + 0.92 * width(LETTERS, text) + 26.0;
    }
    pen.arrow((x, y - 5.0), (x + 30.0, y - 5.0), LINE);
    pen.text((x + 38.0, y), LETTERS, Align::Left, "with hysteresis");
    x += 38.0 + 0.92 * width(LETTERS, "with hysteresis") + 20.0;
    both_ways(pen, (x + 15.0, y - 5.0));
    pen.text((x + 38.0, y), LETTERS, Align::Left, "reversible");
    let text = "G grazing   SN fold   PD period doubling   ISN, IPD fold or doublings interrupted by chaos   \
                OCH out of chaos   A, B, …: motions of Fig. 9";
    let (place, ink) = ((COLUMNS[0].0, y + 24.0), (style::INK, false));
    pen.words(place, LETTERS - 1, Align::Left, ink, text);
}

/// True if a step shows a motion on its way from one periodic motion to another.
fn is_passing(steps: &[&Step], index: usize) -> bool {
    let is_settled = |step: &&&Step| step.is_settled();
    let before = steps[..index].iter().rfind(is_settled);
    let after = steps[index + 1..].iter().find(is_settled);
    let repeats = |step: Option<&&Step>| step.is_none_or(|step| step.motion.regime().is_some());
    !steps[index].is_settled() && repeats(before) && repeats(after)
}
