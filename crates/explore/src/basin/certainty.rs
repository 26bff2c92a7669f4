//! How certainly z = 1 establishes itself along the hysteresis zone.

use softstop::{Dimension, Machine, Parameter};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;
use softstop_dynamics::basin::Establishing;

/// A value at a place of the zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CertaintyPoint {
    /// Where.
    pub place: f64,
    /// What.
    pub value: f64,
    /// How sure it is.
    pub interval: Option<[f64; 2]>,
}

/// A curve over the places of the zone.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyCurve {
    /// What it is called in the legend.
    pub label: String,
    /// Its colour.
    pub color: &'static str,
    /// Dashed instead of solid.
    pub is_dashed: bool,
    /// Its points.
    pub points: Vec<CertaintyPoint>,
}

/// A panel of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyPanel {
    /// What it shows.
    pub title: String,
    /// What goes upwards.
    pub up: &'static str,
    /// The curves.
    pub curves: Vec<CertaintyCurve>,
    /// With the paper's claim: one at g0, zero at s_SN.
    pub has_claim: bool,
    /// With a legend of its own; the first panel's stands for all others.
    pub has_legend: bool,
}

/// Panels of curves over the hysteresis zone.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyPage {
    /// The panels, two in a row.
    pub panels: Vec<CertaintyPanel>,
}

/// Size of a panel; from one to the next across and down; left and top of the first.
const AREA: (f64, f64) = (540.0, 350.0);
const NEXT: (f64, f64) = (660.0, 480.0);
const FIRST: (f64, f64) = (84.0, 108.0);
/// Width of the legend at the right of a page.
const LEGEND: f64 = 320.0;
/// Letters.
const LETTERS: u32 = 14;
/// The paper's claim, which names the ends only.
const CLAIM: [(f64, f64); 2] = [(0.0, 1.0), (1.0, 0.0)];
const CLAIMED: Sign = Sign::Mark(Mark::Circle, style::ASIDE);
/// Values upwards: a share, with room for the line at one.
const SHARES: (f64, f64) = (0.0, 1.02);

impl CertaintyCurve {
    fn stroke(&self) -> Stroke {
        let line = Stroke::solid(self.color, 2.2);
        let dashes = self.is_dashed.then_some((8.0, 5.0));
        Stroke { dashes, ..line }
    }

    fn draw(&self, pen: &mut Pen, panel: &Panel) {
        let points = self.points.iter();
        let sure = points.filter_map(|point| Some((point.place, point.interval?)));
        let sure: Vec<(f64, [f64; 2])> = sure.collect();
        if !sure.is_empty() {
            panel.band(pen, &sure, self.stroke().color, 0.25);
        }
        let places = self.points.iter().map(|point| (point.place, point.value));
        panel.curve(pen, &places.collect::<Vec<_>>(), self.stroke());
    }
}

impl CertaintyPanel {
    fn draw(&self, pen: &mut Pen, panel: &Panel, across: &str) {
        let axes = Axes::new(LETTERS, Some(across), self.up, (6, 6));
        panel.ground(pen, &axes);
        for curve in &self.curves {
            curve.draw(pen, panel);
        }
        if self.has_claim {
            for end in CLAIM {
                pen.mark(panel.place(end), Mark::Circle, 6.0, style::ASIDE);
            }
        }
        panel.axes(pen, &axes);
        let (left, top, ..) = panel.area;
        pen.heading((left, top - 12.0), LETTERS + 2, Align::Left, &self.title);
        if self.has_legend {
            let place = (panel.right() - 214.0, top + 26.0);
            pen.legend(place, LETTERS, &self.entries(false));
        }
    }

    fn entries(&self, has_claim: bool) -> Vec<(Sign, String)> {
        let named = self.curves.iter().filter(|curve| !curve.label.is_empty());
        let mut entries: Vec<(Sign, String)> = named
            .map(|curve| (Sign::Line(curve.stroke()), curve.label.clone()))
            .collect();
        if has_claim {
            let claim = "the paper: one at g₀, zero at s_SN".to_owned();
            entries.push((CLAIMED, claim));
        }
        entries
    }
}

impl CertaintyPage {
    /// The page as an SVG document.
    pub fn svg(&self) -> String {
        let rows = self.panels.len().div_ceil(2) as f64;
        let right = FIRST.0 + NEXT.0 + AREA.0 + 24.0;
        let mut pen = Pen::page(right + LEGEND, FIRST.1 + rows * NEXT.1 - 60.0);
        let title = "How certainly z = 1 establishes itself in its hysteresis zone";
        heading(&mut pen, (FIRST.0, 36.0), title, "bands: 95 % intervals");
        for (index, shown) in self.panels.iter().enumerate() {
            let (column, row) = ((index % 2) as f64, (index / 2) as f64);
            let corner = (FIRST.0 + column * NEXT.0, FIRST.1 + row * NEXT.1);
            let panel = Panel::new((corner.0, corner.1, AREA.0, AREA.1), (-0.02, 1.02), SHARES);
            let across = "place in the hysteresis zone: 0 at g₀, 1 at s_SN";
            shown.draw(&mut pen, &panel, across);
        }
        if let Some(first) = self.panels.first() {
            let place = (right, FIRST.1 + 14.0);
            pen.legend(place, LETTERS, &first.entries(first.has_claim));
        }
        pen.svg()
    }
}

/// The certainty of z = 1 along the hysteresis zone of one machine, as an SVG document.
pub fn chart(machine: &Machine, places: &[Establishing], title: &str) -> String {
    let own = |place: &Establishing| machine.to_own(Dimension::Frequency, place.frequency);
    let [low, high] = [places.first(), places.last()].map(|end| end.map_or(0.0, own));
    let room = 0.03 * (high - low).max(1e-3 * high);
    let points = places.iter().map(|place| CertaintyPoint {
        place: own(place),
        value: place.certainty,
        interval: Some(place.interval),
    });
    let shown = CertaintyPanel {
        title: String::new(),
        up: "establishing certainty of z = 1",
        curves: vec![CertaintyCurve {
            label: String::new(),
            color: style::DESIGN,
            is_dashed: false,
            points: points.collect(),
        }],
        has_claim: false,
        has_legend: false,
    };
    let area = (FIRST.0, 84.0, 780.0, 400.0);
    let panel = Panel::new(area, (low - room, high + room), SHARES);
    let mut pen = Pen::page(900.0, 560.0);
    let what = "share of initial states that lead to z = 1, with 95 % interval";
    heading(&mut pen, (FIRST.0, 36.0), title, what);
    let frequency = machine.label_of(Parameter::Frequency);
    shown.draw(&mut pen, &panel, &format!("{frequency}, from g₀ to s_SN"));
    pen.svg()
}
