//! How certainly z = 1 establishes itself along the hysteresis zone.

use softstop::{Dimension, Machine, Parameter};
use softstop_draw::{Axis, Chart, Corner, Layer, Legend, Mark, Panel, Stroke, style};
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

/// The paper's claim, which names the ends only.
const CLAIM: [(f64, f64); 2] = [(0.0, 1.0), (1.0, 0.0)];
/// Values upwards: a share, with room for the line at one.
const SHARES: (f64, f64) = (0.0, 1.02);

impl CertaintyCurve {
    /// The band of its intervals, and the line.
    fn layers(&self) -> [Layer; 2] {
        let line = Stroke::solid(self.color, 2.2);
        let dashes = self.is_dashed.then_some((8.0, 5.0));
        let points = self.points.iter();
        let sure = points.filter_map(|point| Some((point.place, point.interval?)));
        let points = self.points.iter().map(|point| (point.place, point.value));
        let line = Layer::line(points, Stroke { dashes, ..line });
        [Layer::band(sure, self.color, 0.25), line.named(&self.label)]
    }
}

impl CertaintyPanel {
    fn panel(&self, across: Axis) -> Panel {
        let curves = self.curves.iter().flat_map(CertaintyCurve::layers);
        let claim = self.has_claim.then(|| {
            let claim = Layer::marks(CLAIM, Mark::Circle, style::ASIDE);
            claim.named("the paper: one at g₀, zero at s_SN")
        });
        Panel {
            title: self.title.clone(),
            size: (540.0, 350.0),
            x: across,
            y: Axis::new(self.up).range(SHARES),
            layers: curves.chain(claim).collect(),
            legend: self.has_legend.then_some(Legend::Inside(Corner::TopRight)),
            ..Panel::default()
        }
    }
}

impl CertaintyPage {
    /// The page as an SVG document.
    pub fn svg(&self) -> String {
        let across = Axis::new("place in the hysteresis zone: 0 at g₀, 1 at s_SN");
        let across = across.range((-0.02, 1.02));
        let panels = self.panels.iter().map(|it| it.panel(across.clone()));
        let title = "How certainly z = 1 establishes itself in its hysteresis zone";
        let chart = Chart {
            subtitle: "bands: 95 % intervals".to_owned(),
            ..Chart::new(title, panels)
        };
        chart.in_columns(2).svg()
    }
}

/// The certainty of z = 1 along the hysteresis zone of one machine, as an SVG document.
pub fn chart(machine: &Machine, places: &[Establishing], title: &str) -> String {
    let points = places.iter().map(|place| CertaintyPoint {
        place: machine.to_own(Dimension::Frequency, place.frequency),
        value: place.certainty,
        interval: Some(place.interval),
    });
    let curve = CertaintyCurve {
        label: String::new(),
        color: style::DESIGN,
        is_dashed: false,
        points: points.collect(),
    };
    let frequency = machine.label_of(Parameter::Frequency);
    let panel = Panel {
        size: (780.0, 400.0),
        x: Axis::new(format!("{frequency}, from g₀ to s_SN")),
        y: Axis::new("establishing certainty of z = 1").range(SHARES),
        layers: curve.layers().into(),
        ..Panel::default()
    };
    let what = "share of initial states that lead to z = 1, with 95 % interval";
    let chart = Chart {
        subtitle: what.to_owned(),
        ..Chart::new(title, [panel])
    };
    chart.svg()
}
