//! The chart of a motion: position, velocity and contact force over time with its phases shaded,
//! and the phase plane.

use softstop::{Dimension, Machine, PhaseKind};

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Area, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::Sign;
use softstop_draw::style;

/// A motion as it is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Drawing {
    /// Time in s, position in m, velocity in m/s, contact force in N.
    pub(crate) points: Vec<[f64; 4]>,
    /// Phase, begin and end in s, in order of time.
    pub(crate) phases: Vec<(PhaseKind, f64, f64)>,
}

/// The line of the motion, and that of positions at which laws change.
const LINE: Stroke = Stroke::solid(style::POINT, 1.3);
const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.0, (5.0, 4.0));
/// Left and top of the first panel, size of a time series, from one to the next, and the phase plane.
const FIRST: (f64, f64) = (96.0, 64.0);
const SERIES: (f64, f64) = (620.0, 180.0);
const NEXT: f64 = 256.0;
const PLANE: Area = (830.0, 64.0, 560.0, 692.0);
/// The page.
const PAGE: (f64, f64) = (1420.0, 880.0);
/// Letters.
const LETTERS: u32 = 14;
/// Room around what is drawn, as a share of it.
const ROOM: f64 = 0.06;

/// Points drawn at most.
const MOST_POINTS: usize = 200_000;

impl Drawing {
    /// Whether no more is taken in.
    pub(crate) fn is_full(&self) -> bool {
        self.points.len() >= MOST_POINTS
    }

    /// The chart as an SVG document; `faces` are the positions in m at which laws change.
    pub(super) fn svg(&self, machine: &Machine, title: &str, faces: &[f64]) -> String {
        let names = labels(machine);
        let mut pen = Pen::page(PAGE.0, PAGE.1);
        heading(&mut pen, (FIRST.0, 36.0), title, "");
        for row in 1..4 {
            let top = FIRST.1 + NEXT * (row - 1) as f64;
            let area = (FIRST.0, top, SERIES.0, SERIES.1);
            let panel = Panel::new(area, self.range(0, 0.0), self.range(row, ROOM));
            for (kind, begin, end) in &self.phases {
                if let Some(color) = color(*kind) {
                    let [left, right] =
                        [begin, end].map(|at| panel.across(at.clamp(panel.x.0, panel.x.1)));
                    pen.tint((left, top, right - left, SERIES.1), color, 1.0);
                }
            }
            if row == 1 {
                for face in faces {
                    panel.curve(&mut pen, &[(panel.x.0, *face), (panel.x.1, *face)], FACE);
                }
            }
            self.line(&mut pen, &panel, (0, row));
            let axes = Axes::new(LETTERS, Some(&names[0]), &names[row], (6, 4));
            panel.axes(&mut pen, &axes);
        }
        let panel = Panel::new(PLANE, self.range(1, ROOM), self.range(2, ROOM));
        let axes = Axes::new(LETTERS, Some(&names[1]), &names[2], (6, 8));
        panel.ground(&mut pen, &axes);
        for face in faces {
            panel.curve(&mut pen, &[(*face, panel.y.0), (*face, panel.y.1)], FACE);
        }
        self.line(&mut pen, &panel, (1, 2));
        panel.axes(&mut pen, &axes);
        for (index, (sign, name)) in self.legend().into_iter().enumerate() {
            let place = (FIRST.0 + 150.0 * index as f64, PAGE.1 - 18.0);
            pen.legend(place, LETTERS, &[(sign, name)]);
        }
        pen.svg()
    }

    fn line(&self, pen: &mut Pen, panel: &Panel, (across, up): (usize, usize)) {
        let points = self.points.iter().map(|point| (point[across], point[up]));
        panel.curve(pen, &points.collect::<Vec<_>>(), LINE);
    }

    fn range(&self, quantity: usize, room: f64) -> (f64, f64) {
        around(self.points.iter().map(|point| point[quantity]), room)
    }

    /// The phases that are shaded.
    fn legend(&self) -> Vec<(Sign, String)> {
        let mut kinds: Vec<PhaseKind> = Vec::new();
        for (kind, ..) in &self.phases {
            if !kinds.contains(kind) {
                kinds.push(*kind);
            }
        }
        let entry = |kind| Some((Sign::Patch(color(kind)?), super::name(kind).to_owned()));
        kinds.into_iter().filter_map(entry).collect()
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

/// Tints of Okabe and Ito's colours for the phases, grey for a mass at rest; free flight stays
/// white.
pub const fn color(kind: PhaseKind) -> Option<&'static str> {
    match kind {
        PhaseKind::Free => None,
        PhaseKind::Pierce => Some("#F4D48C"),
        PhaseKind::Cut => Some("#F8F3AA"),
        PhaseKind::Gap => Some("#E0E0E0"),
        PhaseKind::Stop => Some("#B3DDF5"),
        PhaseKind::Released => Some("#8CD3C0"),
        PhaseKind::Chatter => Some("#E8C3D7"),
        PhaseKind::Stuck => Some("#E28E4D"),
        PhaseKind::Resting => Some("#A9A9A9"),
    }
}
