//! The picture of figure 8: one diagram with its zooms and numbered bifurcations (Peterka 2003).

use softstop_dynamics::sweep::{Chain, Step};

use super::band::{Bifurcation, band, both_ways, spread};
use crate::diagram::{dots, same};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::style;

/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1240.0;
/// Sizes of letters.
const LETTERS: u32 = 14;
const SMALL: u32 = 11;
/// Size of a dot.
const DOT: f64 = 0.65;
/// Height of the band of numbers above a panel.
const BAND: f64 = 86.0;
/// Left and right ends of the columns of zooms, and the height of the panels.
const COLUMNS: [(f64, f64); 2] = [(76.0, 612.0), (676.0, 1212.0)];
const HEIGHTS: (f64, f64) = (300.0, 330.0);
/// Room below a panel.
const BELOW: f64 = 62.0;
/// Colours of motions met both ways, up only, down only, and on no sweep from rest.
const BOTH: &str = "#444444";
const UP: &str = style::DESIGN;
const DOWN: &str = style::OPTIMUM;
const ISOLATED: &str = "#009E73";

/// A diagram over a range of eta.
#[derive(Debug, Clone)]
pub struct Diagram {
    /// Its letter, if it has one.
    pub name: &'static str,
    /// Range of eta.
    pub range: (f64, f64),
    /// The sweep up and the sweep down, over the same values.
    pub ways: [Chain; 2],
    /// Faster sweeps down that show chaos which does not last.
    pub fleeting: Vec<Chain>,
    /// What motions are called: eta, X'- and the name.
    pub names: Vec<(f64, f64, String)>,
}

/// The picture.
#[derive(Debug, Clone)]
pub struct NumberedChart<'a> {
    /// All frequencies.
    pub overview: &'a Diagram,
    /// Its zooms.
    pub zooms: &'a [Diagram],
    /// Steps of motions that no sweep from rest reaches.
    pub isolated: &'a [Step],
    /// The bifurcations.
    pub bifurcations: &'a [Bifurcation],
    /// Letters of Fig. 9 and their frequencies.
    pub letters: &'a [(String, f64)],
    /// How it was made.
    pub explanation: String,
}

impl NumberedChart<'_> {
    /// As PNG.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let top = 122.0 + BAND;
        let first = top + HEIGHTS.0 + BELOW;
        let row = BAND + HEIGHTS.1 + BELOW;
        let rows = self.zooms.len().div_ceil(2) as f64;
        let mut pen = Pen::new(WIDTH, first + row * rows + 4.0);
        let title = "Bifurcation diagram for ρ = 10 (unloaded machine) and its zooms (a) to (d)";
        heading(&mut pen, (COLUMNS[0].0, 30.0), title, &self.explanation);
        self.legend(&mut pen, 76.0);
        let area = (COLUMNS[0].0, top, COLUMNS[1].1 - COLUMNS[0].0, HEIGHTS.0);
        self.whole(&mut pen, area);
        for (index, zoom) in self.zooms.iter().enumerate() {
            let (left, right) = COLUMNS[index % 2];
            let top = first + BAND + row * (index / 2) as f64;
            let area = (left, top, right - left, HEIGHTS.1);
            self.zoom(&mut pen, area, zoom);
        }
        pen.png_at(SCALE)
    }

    fn whole(&self, pen: &mut Pen, area: softstop_draw::pen::Area) {
        let panel = self.panel(area, self.overview);
        let axes = axes(Some("drive frequency η"), (10, 5));
        panel.ground(pen, &axes);
        let inside = |eta: f64| self.zooms.iter().any(|zoom| within(zoom.range, eta));
        let shown: Vec<Bifurcation> = self
            .bifurcations
            .iter()
            .filter(|it| !inside(it.eta) || it.eta > 1.0)
            .cloned()
            .collect();
        self.content(pen, &panel, self.overview);
        let zooms = self.zooms.iter().map(|zoom| {
            let middle = f64::midpoint(zoom.range.0, zoom.range.1);
            let (from, to) = (panel.across(zoom.range.0), panel.across(zoom.range.1));
            let y = panel.bottom();
            pen.tint(
                (from, area.1, (to - from).max(1.0), y - area.1),
                style::ALLOWED,
                0.22,
            );
            (panel.across(middle), zoom.name)
        });
        let zooms: Vec<(f64, &str)> = zooms.collect();
        let places = spread(
            &zooms.iter().map(|zoom| (zoom.0, 30.0)).collect::<Vec<_>>(),
            (area.0, panel.right()),
        );
        for ((x, name), place) in zooms.iter().zip(places) {
            pen.line(
                &[(place, area.1 - 16.0), (*x, area.1)],
                Stroke::solid(style::ALLOWED, 1.0),
            );
            pen.text((place, area.1 - 20.0), LETTERS, Align::Middle, name);
        }
        let beyond: Vec<Bifurcation> = shown.into_iter().filter(|it| it.eta > 1.03).collect();
        band(pen, &panel, &beyond);
        panel.axes(pen, &axes);
        names(pen, &panel, self.overview);
    }

    fn zoom(&self, pen: &mut Pen, area: softstop_draw::pen::Area, zoom: &Diagram) {
        let panel = self.panel(area, zoom);
        let axes = axes(Some("η"), (5, 5));
        panel.ground(pen, &axes);
        self.content(pen, &panel, zoom);
        let own: Vec<Bifurcation> = self
            .bifurcations
            .iter()
            .filter(|it| within(zoom.range, it.eta))
            .cloned()
            .collect();
        band(pen, &panel, &own);
        panel.axes(pen, &axes);
        names(pen, &panel, zoom);
        for (letters, eta) in self.letters.iter().filter(|it| within(zoom.range, it.1)) {
            let x = panel.across(*eta);
            pen.arrow(
                (x, panel.bottom() - 13.0),
                (x, panel.bottom() - 1.0),
                Stroke::solid(style::INK, 1.0),
            );
            let place = (x, panel.bottom() - 16.0);
            pen.words(place, SMALL + 1, Align::Middle, (style::INK, true), letters);
        }
        pen.heading(
            (area.0, area.1 - BAND + 12.0),
            LETTERS + 1,
            Align::Left,
            zoom.name,
        );
    }

    /// A panel as high as the diagram's velocities.
    fn panel(&self, area: softstop_draw::pen::Area, diagram: &Diagram) -> Panel {
        let steps = diagram.ways.iter().flat_map(|chain| &chain.steps);
        let isolated = self.isolated.iter();
        let all = steps.chain(isolated.filter(|step| within(diagram.range, step.value)));
        let top = all.map(Step::hardest).fold(0.0, f64::max);
        let top = if top > 0.0 { top } else { 1.0 };
        Panel::new(area, diagram.range, (-0.16 * top, 1.12 * top))
    }

    /// The dots.
    fn content(&self, pen: &mut Pen, panel: &Panel, diagram: &Diagram) {
        let fleeting = diagram.fleeting.iter().flat_map(|chain| &chain.steps);
        let fleeting = fleeting.filter(|step| step.hardest() > 0.0);
        panel.dots(pen, fleeting.flat_map(dots), 0.8 * DOT, DOWN);
        let isolated = self.isolated.iter();
        let isolated = isolated.filter(|step| step.is_settled());
        let (up, down) = (diagram.ways[0].rising(), diagram.ways[1].rising());
        let alike: Vec<bool> = up.iter().zip(&down).map(|(a, b)| same(a, b)).collect();
        let of = |steps: &[&Step], wanted: bool| -> Vec<(f64, f64)> {
            let own = (0..alike.len()).filter(|index| alike[*index] == wanted);
            let stays = own.filter(|index| !is_passing(steps, *index));
            stays.flat_map(|index| dots(steps[index])).collect()
        };
        panel.dots(
            pen,
            of(&up, true).into_iter().chain(of(&down, true)),
            DOT,
            BOTH,
        );
        panel.dots(pen, of(&up, false).into_iter(), DOT, UP);
        panel.dots(pen, of(&down, false).into_iter(), DOT, DOWN);
        panel.dots(pen, isolated.flat_map(dots), DOT, ISOLATED);
    }

    fn legend(&self, pen: &mut Pen, y: f64) {
        let entries = [
            (BOTH, "up and down"),
            (UP, "up only"),
            (DOWN, "down only"),
            (ISOLATED, "reached by no sweep from z = 0"),
        ];
        let mut x = COLUMNS[0].0;
        for (color, text) in entries {
            pen.tint((x, y - 11.0, 12.0, 12.0), color, 1.0);
            pen.text((x + 18.0, y), LETTERS, Align::Left, text);
            x += 18.0 + 0.92 * width(LETTERS, text) + 26.0;
        }
        let from = (x, y - 5.0);
        pen.arrow(from, (x + 30.0, y - 5.0), Stroke::solid(style::INK, 1.1));
        pen.text((x + 38.0, y), LETTERS, Align::Left, "with hysteresis");
        x += 38.0 + 0.92 * width(LETTERS, "with hysteresis") + 20.0;
        both_ways(pen, (x + 15.0, y - 5.0));
        pen.text((x + 38.0, y), LETTERS, Align::Left, "reversible");
        let text = "G grazing   SN fold   PD period doubling   ISN, IPD fold or doublings interrupted by chaos   \
                    OCH out of chaos   A, B, …: motions of Fig. 9";
        pen.words(
            (COLUMNS[0].0, y + 24.0),
            LETTERS - 1,
            Align::Left,
            (style::INK, false),
            text,
        );
    }
}

fn axes(across: Option<&str>, ticks: (usize, usize)) -> Axes<'_> {
    Axes::new(LETTERS, across, "X′₋", ticks)
}

fn within((low, high): (f64, f64), value: f64) -> bool {
    (low..=high).contains(&value)
}

/// True if a step shows a motion on its way from one periodic motion to another.
fn is_passing(steps: &[&Step], index: usize) -> bool {
    let is_settled = |step: &&&Step| step.is_settled();
    let before = steps[..index].iter().rfind(is_settled);
    let after = steps[index + 1..].iter().find(is_settled);
    let repeats = |step: Option<&&Step>| step.is_none_or(|step| step.motion.regime().is_some());
    !steps[index].is_settled() && repeats(before) && repeats(after)
}

/// The names of motions beside them.
fn names(pen: &mut Pen, panel: &Panel, diagram: &Diagram) {
    for (eta, velocity, name) in &diagram.names {
        let (x, y) = panel.place((*eta, *velocity));
        let half = 0.5 * width(LETTERS - 1, name);
        let x = x.clamp(panel.area.0 + half + 4.0, panel.right() - half - 4.0);
        pen.words(
            (x, y - 7.0),
            LETTERS - 1,
            Align::Middle,
            (style::INK, true),
            name,
        );
    }
}
