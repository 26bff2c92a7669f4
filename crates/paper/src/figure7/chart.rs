//! The picture of figure 7: a z = 1 motion with its phases shaded (Peterka 2003).
//! Position over time, the phase trajectory, the force of contact.

use softstop::PhaseKind;

use super::cycle::{Cycle, Point};
use crate::figure::ends;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{self, Align, Area, Pen, Stroke};
use softstop_draw::style;
use softstop_explore::simulate::chart::color;

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
/// The axis in a panel.
const ZERO: Stroke = Stroke::solid("#cccccc", 1.0);
/// The colour of the figures of the motion.
const FIGURE: (&str, bool) = (style::OPTIMUM, true);
/// Periods of the time series.
const SHOWN: f64 = 2.5;
/// What each phase is called, in the order in which the mass goes through them.
const PHASES: [(PhaseKind, &str); 4] = [
    (PhaseKind::Free, "free"),
    (PhaseKind::Pierce, "I piercing"),
    (PhaseKind::Cut, "II cut"),
    (PhaseKind::Stop, "III stop"),
];

/// What a panel shows of a point.
type Show = fn(&Point) -> (f64, f64);
const SERIES: Show = |point| (point.time, point.position);
const STATE: Show = |point| (point.position, point.velocity);
const FORCE: Show = |point| (point.position, point.force);

impl Cycle {
    /// The picture as an SVG document.
    pub(super) fn svg(&self, name: &str) -> String {
        let (orbit, mut pen) = (&self.orbit, Pen::new(PAGE.0, PAGE.1));
        let (eta, rho) = (orbit.scene.excitation.frequency, self.clearance());
        let title = format!("Fig. 7{name}, η = {eta}, ρ = {rho}, z = 1");
        let subtitle = format!(
            "X_m = {:.5},  X′₋ = {:.6},  Floquet multipliers of modulus {:.4}",
            orbit.max_position,
            orbit.before_impact_velocity(),
            orbit.multipliers()[0].norm(),
        );
        heading(&mut pen, (36.0, 38.0), &title, &subtitle);
        self.legend(&mut pen);
        self.series(&mut pen);
        self.impact(&mut pen);
        self.trajectory(&mut pen);
        self.contact(&mut pen);
        self.force(&mut pen);
        pen.svg()
    }

    fn clearance(&self) -> f64 {
        self.orbit.scene.clearance
    }

    /// The phases that occur and what they are called.
    fn legend(&self, pen: &mut Pen) {
        let mut right = PAGE.0 - 24.0;
        let occurs = |(kind, _): &(PhaseKind, _)| self.first(*kind).is_some();
        for (kind, name) in PHASES.into_iter().rev().filter(occurs) {
            right -= pen::width(LETTERS, name);
            pen.text((right, 60.0), LETTERS, Align::Left, name);
            right -= 28.0;
            let area = (right, 48.0, 22.0, 14.0);
            pen.tint(area, color(kind).unwrap_or("#ffffff"), 1.0);
            pen.frame(area);
            right -= 18.0;
        }
    }

    /// Some periods.
    fn series(&self, pen: &mut Pen) {
        let (highest, period) = (self.orbit.max_position, self.orbit.scene.period());
        let y = (1.12 * self.range(SERIES).0, 1.32 * highest);
        let panel = Panel::new(AREAS[0], (0.0, SHOWN * period), y);
        let shifts = (0..=SHOWN as u32).map(|cycle| f64::from(cycle) * period);
        for shift in shifts.clone() {
            self.shade(pen, &panel, shift);
        }
        for (face, _) in self.faces() {
            panel.curve(pen, &[(panel.x.0, face), (panel.x.1, face)], FACE);
        }
        for shift in shifts {
            let place = |point: &Point| (point.time + shift, point.position);
            let points: Vec<(f64, f64)> = self.points.iter().map(place).collect();
            panel.curve(pen, &points, CURVE);
        }
        let (begin, end) = self.touching();
        // X_m after the first impact.
        let top = f64::midpoint(begin, end);
        let line = [(top, highest), (top + 0.5 * period, highest)];
        panel.curve(pen, &line, GUIDE);
        let x = panel.across(top + 0.38 * period);
        let line = Stroke::solid(style::OPTIMUM, 1.3);
        pen.arrow((x, panel.height(0.0)), (x, panel.height(highest)), line);
        let place = (x + 7.0, panel.height(0.45 * highest));
        pen.words(place, LETTERS + 1, Align::Left, FIGURE, "X_m");
        // The period between the first two impacts.
        let y = panel.height(1.2 * highest);
        let (left, right) = (panel.across(begin), panel.across(begin + period));
        let middle = f64::midpoint(left, right);
        let line = Stroke::solid(style::INK, 1.2);
        pen.arrow((middle, y), (left, y), line);
        pen.arrow((middle, y), (right, y), line);
        let ink = (style::INK, true);
        pen.words((middle, y + 5.0), LETTERS + 1, Align::Middle, ink, "T");
        let axes = Axes::new(LETTERS, Some("time τ"), "position X", (7, 6));
        panel.axes(pen, &axes);
    }

    /// The time around the impact.
    fn impact(&self, pen: &mut Pen) {
        let (begin, end) = self.touching();
        let room = 0.45 * (end - begin);
        let x = (begin - room, end + room);
        let panel = Panel::new(AREAS[1], x, self.positions(0.9, 0.35));
        self.shade(pen, &panel, 0.0);
        for (face, name) in self.faces() {
            panel.curve(pen, &[(panel.x.0, face), (panel.x.1, face)], FACE);
            let place = (panel.area.0 + 8.0, panel.height(face) - 5.0);
            pen.text(place, LETTERS, Align::Left, name);
        }
        panel.curve(pen, &self.curve(SERIES), CURVE);
        let beside = [(-11.0, -7.0), (-11.0, -7.0), (-12.0, 18.0)];
        self.letters(pen, &panel, SERIES, beside);
        let name = "position X around the impact";
        panel.axes(pen, &Axes::new(LETTERS, Some("time τ"), name, (4, 6)));
    }

    /// The phase trajectory.
    fn trajectory(&self, pen: &mut Pen) {
        let (slow, fast) = self.range(STATE);
        let x = (1.12 * self.range(SERIES).0, 1.3 * self.orbit.max_position);
        let panel = Panel::new(AREAS[2], x, (1.18 * slow, 1.18 * fast));
        self.plane(pen, &panel, ["position X", "velocity X′"], STATE);
        self.strike(pen, &panel);
    }

    /// The part of it beyond the clearance.
    fn contact(&self, pen: &mut Pen) {
        let (low, high) = self.range(|point| match point.phase {
            PhaseKind::Free => (point.position, 0.0),
            _ => STATE(point),
        });
        let room = 0.22 * (high - low);
        let y = (low - room, high + room);
        let panel = Panel::new(AREAS[3], self.positions(0.6, 0.25), y);
        self.tint(pen, &panel);
        let names = ["position X beyond the clearance", "velocity X′"];
        self.plane(pen, &panel, names, STATE);
        self.strike(pen, &panel);
        let beside = [(11.0, -9.0), (12.0, -7.0), (12.0, 18.0)];
        self.letters(pen, &panel, STATE, beside);
        for (face, name) in self.faces() {
            let place = (panel.across(face) + 4.0, panel.bottom() - 8.0);
            pen.text(place, LETTERS - 1, Align::Left, name);
        }
    }

    /// The force of contact.
    fn force(&self, pen: &mut Pen) {
        let (low, high) = self.range(FORCE);
        let room = 0.12 * (high - low);
        let y = (low - room, high + room);
        let panel = Panel::new(AREAS[4], self.positions(0.3, 0.2), y);
        self.tint(pen, &panel);
        self.plane(pen, &panel, ["position X", "contact force F/F₀"], FORCE);
    }

    /// What a panel over position shows, with the faces and the axis.
    fn plane(&self, pen: &mut Pen, panel: &Panel, [across, up]: [&str; 2], show: Show) {
        for (face, _) in self.faces() {
            panel.curve(pen, &[(face, panel.y.0), (face, panel.y.1)], FACE);
        }
        panel.curve(pen, &[(panel.x.0, 0.0), (panel.x.1, 0.0)], ZERO);
        panel.curve(pen, &self.curve(show), CURVE);
        panel.axes(pen, &Axes::new(LETTERS, Some(across), up, (4, 6)));
    }

    /// Marks X'₋ where the mass comes to the clearance.
    fn strike(&self, pen: &mut Pen, panel: &Panel) {
        let at = (self.clearance(), self.orbit.before_impact_velocity());
        panel.curve(pen, &[(panel.x.0, at.1), at], GUIDE);
        pen.spot(panel.place(at), 4.0);
        let place = (panel.area.0 + 8.0, panel.height(at.1) + 17.0);
        pen.words(place, LETTERS + 1, Align::Left, FIGURE, "X′₋");
    }

    /// Shades the layers beyond the clearance.
    fn tint(&self, pen: &mut Pen, panel: &Panel) {
        let faces = self.faces();
        let kinds = match faces.len() {
            1 => &[PhaseKind::Stop][..],
            _ => &[PhaseKind::Pierce, PhaseKind::Cut, PhaseKind::Stop],
        };
        let ends = faces.iter().skip(1).map(|face| face.0);
        let layers = faces.iter().zip(ends.chain([panel.x.1])).zip(kinds);
        for (((from, _), to), kind) in layers {
            fill(pen, panel, (*from, to), *kind, 0.55);
        }
    }

    /// Shades the phases of a period that begins so much later.
    fn shade(&self, pen: &mut Pen, panel: &Panel, later: f64) {
        for arc in self.points.chunk_by(|a, b| a.phase == b.phase) {
            let begin = (arc[0].time + later).max(panel.x.0);
            let end = (arc[arc.len() - 1].time + later).min(panel.x.1);
            if begin < end {
                fill(pen, panel, (begin, end), arc[0].phase, 1.0);
            }
        }
    }

    /// The positions at which laws change and their names.
    fn faces(&self) -> Vec<(f64, &'static str)> {
        let face = self.clearance();
        let Some(strip) = self.orbit.scene.piercing else {
            return vec![(face, "ρ = X_III")];
        };
        let cut = face + strip.thickness;
        vec![(face, "ρ"), (cut, "ρ + σ"), (cut + strip.travel, "X_III")]
    }

    /// From so many depths of the impact before the clearance to so many beyond the highest position.
    fn positions(&self, before: f64, beyond: f64) -> (f64, f64) {
        let (face, highest) = (self.clearance(), self.orbit.max_position);
        let depth = highest - face;
        (face - before * depth, highest + beyond * depth)
    }

    /// What a panel shows of all points.
    fn curve(&self, show: Show) -> Vec<(f64, f64)> {
        self.points.iter().map(show).collect()
    }

    /// Least and largest value of a panel's axis upwards.
    fn range(&self, show: Show) -> (f64, f64) {
        ends(self.points.iter().map(|point| show(point).1))
    }

    /// Beginning and end of contact.
    fn touching(&self) -> (f64, f64) {
        let touches = |point: &&Point| point.phase != PhaseKind::Free;
        let mut touching = self.points.iter().filter(touches);
        let begin = touching.next().map_or(0.0, |point| point.time);
        let end = touching.next_back().map(|point| point.time);
        (begin, end.unwrap_or(self.orbit.scene.period()))
    }

    /// The paper's letters: C the end of piercing, D and E the first and the last touch of the preloaded
    /// stop; each with its name as far beside it as is said for it.
    fn letters(&self, pen: &mut Pen, panel: &Panel, show: Show, beside: [(f64, f64); 3]) {
        let marks = [
            ("C", self.first(PhaseKind::Cut)),
            ("D", self.first(PhaseKind::Stop)),
            ("E", self.last(PhaseKind::Stop)),
        ];
        for ((name, point), (right, down)) in marks.into_iter().zip(beside) {
            if let Some(point) = point {
                let (x, y) = panel.place(show(point));
                pen.spot((x, y), 4.0);
                let (place, ink) = ((x + right, y + down), (style::INK, false));
                pen.words(place, LETTERS + 1, Align::Middle, ink, name);
            }
        }
    }
}

/// Shades a range of the axis across in the colour of a phase, if it has one.
fn fill(pen: &mut Pen, panel: &Panel, (from, to): (f64, f64), kind: PhaseKind, opacity: f64) {
    if let Some(color) = color(kind) {
        let (left, right) = (panel.across(from), panel.across(to));
        let area = (left, panel.area.1, right - left, panel.area.3);
        pen.tint(area, color, opacity);
    }
}
