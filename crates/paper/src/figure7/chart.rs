//! The picture of figure 7: a z = 1 motion with its phases shaded (Peterka 2003).
//! Position over time, the phase plane, the force of contact.

use anyhow::Result;
use softstop::PhaseKind;

use super::{Cycle, faces};
use crate::figure::Figure;
use crate::path::PathPoint;
use softstop_draw::{Align, Chart, Layer, Mark, Sign, Stroke, around, style};
use softstop_explore::palette::phase_color;

const CURVE: Stroke = Stroke::solid(style::DESIGN, 2.0);
pub(super) const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.2, (6.0, 4.0));
const GUIDE: Stroke = Stroke::dashed(style::OPTIMUM, 1.2, (3.0, 3.0));
const LENGTH: Stroke = Stroke::solid(style::OPTIMUM, 1.3);
/// Periods of the time series.
const SHOWN: f64 = 2.5;
/// What each phase is called, in the order in which the mass goes through them.
const PHASES: [(PhaseKind, &str); 4] = [
    (PhaseKind::Free, "free"),
    (PhaseKind::Pierce, "I piercing"),
    (PhaseKind::Cut, "II cut"),
    (PhaseKind::Stop, "III stop"),
];
/// All of an axis.
const ALL: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// What a panel shows of a point.
pub(super) type Show = fn(&PathPoint) -> (f64, f64);
const SERIES: Show = |point| (point.time, point.position);
pub(super) const STATE: Show = |point| (point.position, point.velocity);
const FORCE: Show = |point| (point.position, point.force);

impl Cycle {
    pub(super) fn chart(&self, figure: &Figure) -> Result<Chart> {
        let orbit = &self.orbit;
        let period = orbit.scene.period();
        let (slow, fast) = self.range(STATE, 0.0);
        let lowest = 1.12 * self.range(SERIES, 0.0).0;
        let contact: Show = |point| match point.phase {
            PhaseKind::Free => (point.position, 0.0),
            _ => STATE(point),
        };
        let (begin, end) = self.touching();
        let room = 0.45 * (end - begin);
        let [time, all] = [
            (begin - room, end + room),
            (lowest, 1.3 * orbit.max_position),
        ];
        let close = [self.positions(0.6, 0.25), self.range(contact, 0.22)];
        let force = [self.positions(0.3, 0.2), self.range(FORCE, 0.12)];
        let ranges = [
            [(0.0, SHOWN * period), (lowest, 1.32 * orbit.max_position)],
            [time, self.positions(0.9, 0.35)],
            [all, (1.18 * slow, 1.18 * fast)],
            close,
            force,
        ];
        let mut chart = figure.picture([
            self.series(),
            self.impact(time.0),
            self.plane(0, ranges[2]),
            self.plane(1, close),
            self.plane(2, force),
        ])?;
        chart.subtitle = format!(
            "X_m = {:.5},  X′₋ = {:.6},  Floquet multipliers of modulus {:.4}",
            orbit.max_position,
            orbit.before_impact_velocity(),
            orbit.monodromy.multipliers()[0].norm(),
        );
        for (panel, [x, y]) in chart.panels.iter_mut().zip(ranges) {
            (panel.x.ends, panel.y.ends) = ([x.0, x.1].map(Some), [y.0, y.1].map(Some));
        }
        Ok(chart)
    }

    /// Some periods, with X_m and the period T between the first two impacts, and what the tints mean.
    fn series(&self) -> Vec<Layer> {
        let (highest, period) = (self.orbit.max_position, self.orbit.scene.period());
        let (begin, end) = self.touching();
        let shifts = || (0..=SHOWN as u32).map(|cycle| f64::from(cycle) * period);
        let mut layers: Vec<Layer> = shifts().flat_map(|shift| self.shades(shift)).collect();
        let faces = faces(&self.orbit.scene).into_iter();
        layers.extend(faces.map(|(face, ..)| Layer::horizontal(face, FACE, "")));
        layers.extend(shifts().map(|shift| {
            let points = self.path.points.iter();
            let points = points.map(|point| (point.time + shift, point.position));
            Layer::line(points, CURVE)
        }));
        let top = f64::midpoint(begin, end);
        let (x, y) = (top + 0.38 * period, 1.2 * highest);
        let middle = begin + 0.5 * period;
        let line = Stroke::solid(style::INK, 1.2);
        layers.extend([
            Layer::line([(top, highest), (top + 0.5 * period, highest)], GUIDE),
            Layer::arrow((x, 0.0), (x, highest), LENGTH),
            Layer::text((x, 0.45 * highest), Align::Left, "X_m")
                .moved(7.0, 0.0)
                .colored(style::OPTIMUM)
                .plated(),
            Layer::arrow((middle, y), (begin, y), line),
            Layer::arrow((middle, y), (begin + period, y), line),
            Layer::text((middle, y), Align::Middle, "T")
                .moved(0.0, 5.0)
                .plated(),
        ]);
        let occur = PHASES.into_iter();
        let occur = occur.filter(|it| self.path.first(it.0).is_some());
        let patch = |kind| Sign::Patch(phase_color(kind).unwrap_or(style::PAPER));
        layers.extend(occur.map(|(kind, name)| Layer::key(patch(kind), name)));
        layers
    }

    /// The time around the impact, from the left end of the panel on.
    fn impact(&self, left: f64) -> Vec<Layer> {
        let mut layers = self.shades(0.0);
        for (face, name, _) in faces(&self.orbit.scene) {
            let name = Layer::text((left, face), Align::Left, name).moved(8.0, -5.0);
            layers.extend([Layer::horizontal(face, FACE, ""), name]);
        }
        layers.push(Layer::line(self.curve(SERIES), CURVE));
        layers.extend(self.letters(SERIES, [(-11.0, -7.0), (-11.0, -7.0), (-12.0, 18.0)]));
        layers
    }

    /// A panel over position: the phase plane, the part of it beyond the clearance, or the force of contact.
    fn plane(&self, column: usize, [x, y]: [(f64, f64); 2]) -> Vec<Layer> {
        let faces = faces(&self.orbit.scene);
        let mut layers = if column > 0 { self.tints() } else { Vec::new() };
        let lines = faces.iter();
        layers.extend(lines.map(|face| Layer::vertical(face.0, FACE, "")));
        let zero = Layer::horizontal(0.0, Stroke::solid(style::FAINT, 1.0), "");
        let show = if column == 2 { FORCE } else { STATE };
        layers.extend([zero, Layer::line(self.curve(show), CURVE)]);
        if column < 2 {
            layers.extend(self.strike(x.0));
        }
        if column == 1 {
            layers.extend(self.letters(STATE, [(11.0, -9.0), (12.0, -7.0), (12.0, 18.0)]));
            let name = |(face, name, _)| Layer::text((face, y.0), Align::Left, name);
            layers.extend(faces.into_iter().map(|face| name(face).moved(4.0, -8.0)));
        }
        layers
    }

    /// Marks X'₋ where the mass comes to the clearance.
    fn strike(&self, left: f64) -> [Layer; 3] {
        let orbit = &self.orbit;
        let at = (orbit.scene.clearance, orbit.before_impact_velocity());
        let text = Layer::text((left, at.1), Align::Left, "X′₋").moved(8.0, 17.0);
        [
            Layer::line([(left, at.1), at], GUIDE),
            Layer::marks([at], Mark::Hollow, style::INK).sized(4.0),
            text.colored(style::OPTIMUM).plated(),
        ]
    }

    /// Shades the layers beyond the clearance.
    fn tints(&self) -> Vec<Layer> {
        let faces = faces(&self.orbit.scene);
        let ends = faces.iter().skip(1).map(|face| face.0);
        let layers = faces.iter().zip(ends.chain([f64::INFINITY]));
        let layers = layers.filter_map(|((from, _, kind), to)| fill((*from, to), *kind, 0.55));
        layers.collect()
    }

    /// Shades the phases of a period that begins so much later.
    fn shades(&self, later: f64) -> Vec<Layer> {
        let shades = self.path.phases().filter_map(|arc| {
            let ends = (arc[0].time + later, arc[arc.len() - 1].time + later);
            fill(ends, arc[0].phase, 1.0)
        });
        shades.collect()
    }

    /// From so many depths of the impact before the clearance to so many beyond the highest position.
    fn positions(&self, before: f64, beyond: f64) -> (f64, f64) {
        let (face, highest) = (self.orbit.scene.clearance, self.orbit.max_position);
        let depth = highest - face;
        (face - before * depth, highest + beyond * depth)
    }

    /// What a panel shows of all points.
    fn curve(&self, show: Show) -> impl Iterator<Item = (f64, f64)> {
        self.path.points.iter().map(show)
    }

    /// Least and largest value of a panel's axis upwards, with this share of room on both sides.
    fn range(&self, show: Show, room: f64) -> (f64, f64) {
        around(self.curve(show).map(|point| point.1), room)
    }

    /// Beginning and end of contact.
    fn touching(&self) -> (f64, f64) {
        let touches = |point: &&PathPoint| point.phase != PhaseKind::Free;
        let mut touching = self.path.points.iter().filter(touches);
        let begin = touching.next().map_or(0.0, |point| point.time);
        let end = touching.next_back().map(|point| point.time);
        (begin, end.unwrap_or(self.orbit.scene.period()))
    }

    /// The paper's letters: C the end of piercing, D and E the first and the last touch of the preloaded
    /// stop; each with its name as far beside it as is said for it.
    fn letters(&self, show: Show, beside: [(f64, f64); 3]) -> Vec<Layer> {
        let marks = [
            ("C", self.path.first(PhaseKind::Cut)),
            ("D", self.path.first(PhaseKind::Stop)),
            ("E", self.path.last(PhaseKind::Stop)),
        ];
        let marks = marks.into_iter().zip(beside);
        let marks = marks.filter_map(|((name, point), (right, down))| {
            let at = show(point?);
            let spot = Layer::marks([at], Mark::Hollow, style::INK).sized(4.0);
            let name = Layer::text(at, Align::Middle, name).moved(right, down);
            Some([spot, name])
        });
        marks.flatten().collect()
    }
}

/// Shades a range of the axis across in the colour of a phase, if it has one.
fn fill(ends: (f64, f64), kind: PhaseKind, opacity: f64) -> Option<Layer> {
    phase_color(kind).map(|color| Layer::boxes([[ends, ALL]], color, opacity))
}
