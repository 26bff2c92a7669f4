//! The chart of a motion: position, velocity and contact force over time with its phases shaded,
//! and the phase plane.

use softstop::{Dimension, Machine, PhaseKind};
use softstop_draw::{Axis, Chart, Layer, Legend, Panel, Stroke, around, style};

use crate::palette::phase_color;

/// A motion as it is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct DrawnMotion {
    /// Time in s, position in m, velocity in m/s, contact force in N.
    pub(crate) points: Vec<[f64; 4]>,
    /// Phase, begin and end in s, in order of time.
    pub(crate) phases: Vec<(PhaseKind, f64, f64)>,
}

/// The line of the motion.
const LINE: Stroke = Stroke::solid(style::POINT, 1.3);
/// The line of a position at which the law of force changes.
pub(crate) const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.0, (5.0, 4.0));

/// From the bottom of a panel to its top.
const ENDLESS: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Points drawn at most.
const MOST_POINTS: usize = 200_000;

impl DrawnMotion {
    /// Whether no more is taken in.
    pub(crate) fn is_full(&self) -> bool {
        self.points.len() >= MOST_POINTS
    }

    /// The chart as an SVG document; `faces` are the positions in m at which laws change.
    pub(super) fn svg(&self, machine: &Machine, title: &str, faces: &[f64]) -> String {
        let names = labels(machine).map(Axis::new);
        let end = around(self.points.iter().map(|point| point[0]), 0.0);
        let series = (1..4).map(|row| {
            let mut layers = self.shades();
            if row == 1 {
                layers.extend(faces.iter().map(|face| Layer::horizontal(*face, FACE, "")));
            }
            layers.push(self.line((0, row)));
            let time = if row == 3 { &names[0].name } else { "" };
            Panel::new(Axis::new(time).range(end), names[row].clone(), layers).sized((560.0, 160.0))
        });
        let faces = faces.iter().map(|face| Layer::vertical(*face, FACE, ""));
        let layers = faces.chain([self.line((1, 2))]);
        let plane = Panel::new(names[1].clone(), names[2].clone(), layers);
        let chart = Chart {
            legend: Legend::Above,
            ..Chart::new(title, series.chain([plane.sized((560.0, 400.0))]))
        };
        chart.in_columns(1).svg()
    }

    fn line(&self, (across, up): (usize, usize)) -> Layer {
        let points = self.points.iter().map(|point| (point[across], point[up]));
        Layer::line(points, LINE)
    }

    /// The times of each phase that is shaded.
    fn shades(&self) -> Vec<Layer> {
        let mut kinds: Vec<PhaseKind> = Vec::new();
        for (kind, ..) in &self.phases {
            if !kinds.contains(kind) {
                kinds.push(*kind);
            }
        }
        let shade = |kind: PhaseKind| {
            let own = self.phases.iter().filter(|phase| phase.0 == kind);
            let times = own.map(|(_, begin, end)| [(*begin, *end), ENDLESS]);
            Some(Layer::boxes(times, phase_color(kind)?, 1.0).named(super::name(kind)))
        };
        kinds.into_iter().filter_map(shade).collect()
    }
}

/// What time, position, velocity and contact force are called.
pub(crate) fn labels(machine: &Machine) -> [String; 4] {
    let names = [
        ("time t", Dimension::Time),
        ("position x", Dimension::Length),
        ("velocity v", Dimension::Velocity),
        ("contact force F", Dimension::Force),
    ];
    names.map(|(what, dimension)| machine.label(what, "", dimension))
}
