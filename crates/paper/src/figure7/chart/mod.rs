//! The picture of figure 7: a z = 1 motion with its phases shaded (Peterka 2003).
//! Position over time, the phase trajectory, the force of contact.

mod plane;
mod series;

use softstop::PhaseKind;

use softstop_draw::panel::{Panel, heading};
use softstop_draw::pen::{self, Align, Area, Pen, Stroke};
use softstop_draw::style;
use softstop_explore::simulate::chart::color;

/// A point of the motion in the paper's ratios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokePoint {
    /// Time τ.
    pub time: f64,
    /// Position X.
    pub position: f64,
    /// Velocity X'.
    pub velocity: f64,
    /// Contact force F.
    pub force: f64,
    /// What the mass does.
    pub phase: PhaseKind,
}

/// The chart.
#[derive(Debug, Clone)]
pub struct StrokeChart {
    /// What it shows.
    pub title: String,
    /// Its main figures.
    pub subtitle: String,
    /// One period.
    pub points: Vec<StrokePoint>,
    /// The period T.
    pub period: f64,
    /// The clearance ρ.
    pub clearance: f64,
    /// Thickness σ of the strip and travel ν behind it, if there is one.
    pub strip: Option<(f64, f64)>,
    /// X'₋ at X = ρ.
    pub before_impact_velocity: f64,
    /// X_m.
    pub max_position: f64,
}

const PAGE: (f64, f64) = (1240.0, 880.0);
/// Where the panels are: time series, impact, phase trajectory, the part of it in contact, force.
const AREAS: [Area; 5] = [
    (86.0, 92.0, 640.0, 320.0),
    (826.0, 92.0, 390.0, 320.0),
    (86.0, 490.0, 330.0, 320.0),
    (502.0, 490.0, 330.0, 320.0),
    (918.0, 490.0, 298.0, 320.0),
];
const LETTERS: u32 = 14;
const CURVE: Stroke = Stroke::solid(style::DESIGN, 2.0);
const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.2, (6.0, 4.0));
const GUIDE: Stroke = Stroke::dashed(style::OPTIMUM, 1.2, (3.0, 3.0));
/// What each phase is called, in the order in which the mass goes through them.
const PHASES: [(PhaseKind, &str); 4] = [
    (PhaseKind::Free, "free"),
    (PhaseKind::Pierce, "I piercing"),
    (PhaseKind::Cut, "II cut"),
    (PhaseKind::Stop, "III stop"),
];

/// What a panel shows of a point.
type Show = fn(&StrokePoint) -> (f64, f64);

impl StrokeChart {
    /// The picture as an SVG document.
    pub fn svg(&self) -> String {
        let mut pen = Pen::new(PAGE.0, PAGE.1);
        heading(&mut pen, (36.0, 38.0), &self.title, &self.subtitle);
        self.legend(&mut pen);
        self.series(&mut pen, AREAS[0]);
        self.impact(&mut pen, AREAS[1]);
        self.trajectory(&mut pen, AREAS[2]);
        self.contact(&mut pen, AREAS[3]);
        self.force(&mut pen, AREAS[4]);
        pen.svg()
    }

    /// The phases that occur and what they are called.
    fn legend(&self, pen: &mut Pen) {
        let occurs = |kind: PhaseKind| self.points.iter().any(|point| point.phase == kind);
        let mut right = PAGE.0 - 24.0;
        for (kind, name) in PHASES.into_iter().rev().filter(|(kind, _)| occurs(*kind)) {
            right -= pen::width(LETTERS, name);
            pen.text((right, 60.0), LETTERS, Align::Left, name);
            right -= 28.0;
            let area = (right, 48.0, 22.0, 14.0);
            pen.tint(area, color(kind).unwrap_or("#ffffff"), 1.0);
            pen.frame(area);
            right -= 18.0;
        }
    }

    /// The positions at which laws change and their names.
    fn faces(&self) -> Vec<(f64, &'static str)> {
        match self.strip {
            None => vec![(self.clearance, "ρ = X_III")],
            Some((thickness, travel)) => vec![
                (self.clearance, "ρ"),
                (self.clearance + thickness, "ρ + σ"),
                (self.clearance + thickness + travel, "X_III"),
            ],
        }
    }

    /// How far the mass goes beyond the clearance.
    fn depth(&self) -> f64 {
        self.max_position - self.clearance
    }

    /// What a panel shows of all points.
    fn curve(&self, show: Show) -> Vec<(f64, f64)> {
        self.points.iter().map(show).collect()
    }

    /// Least and largest value of a panel's axis upwards.
    fn range(&self, show: Show) -> (f64, f64) {
        let values = self.points.iter().map(|point| show(point).1);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    }

    /// Beginning and end of contact.
    fn touching(&self) -> (f64, f64) {
        let touches = |point: &&StrokePoint| point.phase != PhaseKind::Free;
        let mut touching = self.points.iter().filter(touches);
        let begin = touching.next().map_or(0.0, |point| point.time);
        let end = touching.next_back().map_or(self.period, |point| point.time);
        (begin, end)
    }

    /// The paper's letters: C the end of piercing, D and E the first and the last touch of the preloaded
    /// stop; each with its name as far beside it as is said for it.
    fn letters(&self, pen: &mut Pen, panel: &Panel, show: Show, beside: [(f64, f64); 3]) {
        let first = |kind: PhaseKind| self.points.iter().find(|point| point.phase == kind);
        let last = |kind: PhaseKind| self.points.iter().rfind(|point| point.phase == kind);
        let marks = [
            ("C", first(PhaseKind::Cut)),
            ("D", first(PhaseKind::Stop)),
            ("E", last(PhaseKind::Stop)),
        ];
        for ((name, point), (right, down)) in marks.into_iter().zip(beside) {
            if let Some(point) = point {
                let place = panel.place(show(point));
                pen.spot(place, 4.0);
                let place = (place.0 + right, place.1 + down);
                let ink = (style::INK, false);
                pen.words(place, LETTERS + 1, Align::Middle, ink, name);
            }
        }
    }
}
