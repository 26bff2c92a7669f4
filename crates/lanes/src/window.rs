//! How far a motion may be from another one that provably meets no face in a window of time.

use std::ops::Range;

use nalgebra::Vector4;

use super::law::{Constants, SPAN};
use super::place::{CyclePlace, Derivatives, Face};

/// Error of the first and second derivative of a cubic Hermite interpolant over a step h, in units of its own error
/// M h^4 / 384: sqrt(3)/216 M h^3 and M h^2 / 12 (Birkhoff and Priver 1967).
const FIRST: f64 = 384.0 * 0.008_018_753_738_744_818;
const SECOND: f64 = 384.0 / 12.0;

/// The windows of a cycle, one after another.
#[derive(Debug, Default)]
pub(super) struct Windows {
    pub all: Vec<Window>,
    /// What the faces of their phases tolerate, window by window.
    margins: Vec<Margin>,
}

/// A window of an arc.
#[derive(Debug)]
pub(super) struct Window {
    /// Derivatives of the state at its start.
    pub at_start: Derivatives,
    /// Its length in s, and the most that a free motion may grow in it.
    pub step: f64,
    pub growth: f64,
    margins: Range<usize>,
}

/// What a face tolerates: deviations of its value, rate and second derivative with which it is provably not met, or at
/// the end of an arc not before that end.
#[derive(Debug, Clone, Copy)]
struct Margin {
    /// Weights of position and velocity.
    position: f64,
    velocity: f64,
    /// All of the window is that far from the face.
    clear: f64,
    /// Or both ends are, and the value is convex or the rate keeps its sign.
    ends: f64,
    slope: f64,
    convex: f64,
}

impl Windows {
    pub fn clear(&mut self) {
        self.all.clear();
        self.margins.clear();
    }

    /// Adds the window between two places of an arc, with the faces by which the arc begins and ends in it; false if the
    /// cycle itself may meet another face in it, as far as it shows.
    pub fn add(
        &mut self,
        law: &Constants,
        (from, to): (&CyclePlace, &CyclePlace),
        step: f64,
        (entry, exit): (Option<Face>, Option<Face>),
        at_start: Derivatives,
    ) -> bool {
        let share = step * law.per_window;
        let scale = (share * share) * (share * share);
        // The bounds hold over a window of the scan; over a longer one, the motion that a velocity makes is larger.
        let longer = share.max(1.0);
        let (y, u) = (from.free.x, from.free.y);
        let fifth = (law.fifth_x * y + law.fifth_v * u).abs() * longer;
        let error_bound =
            scale * (law.steady + (law.fourth_x * y + law.fourth_v * u).abs() + fifth);
        let rate_fifth = (law.rate_fifth_x * y + law.rate_fifth_v * u).abs();
        let rate_sixth = (law.rate_sixth_x * y + law.rate_sixth_v * u).abs() * longer;
        let rate_error_bound = scale * (law.rate_steady + rate_fifth + rate_sixth);
        let margin = |face: Face| {
            let error_bound =
                face.position.abs() * error_bound + face.velocity.abs() * rate_error_bound;
            let ambiguity = match face.velocity {
                0.0 => law.ambiguity,
                _ => law.ambiguity * law.guard_scale,
            };
            let [is_entry, is_exit] = [entry, exit].map(|it| it.is_some_and(|it| it.is(&face)));
            Margin::new(
                &face,
                (from, to),
                step,
                (error_bound, ambiguity),
                (is_entry, is_exit),
            )
        };
        let faces = law.faces().into_iter();
        let within_reach = faces.filter(|face| face.level < f64::INFINITY);
        let first = self.margins.len();
        self.margins.extend(within_reach.map(margin));
        let margins = first..self.margins.len();
        if !self.tolerate(&margins, &Vector4::zeros()) {
            self.margins.truncate(first);
            return false;
        }
        self.all.push(Window {
            at_start,
            step,
            growth: if law.stiffness < 0.0 { 1.0 } else { SPAN.exp() },
            margins,
        });
        true
    }

    /// True if no motion meets another face in a window whose position and its derivatives deviate by no more than this.
    pub fn is_clear(&self, window: &Window, most: &Vector4<f64>) -> bool {
        self.tolerate(&window.margins, most)
    }

    fn tolerate(&self, margins: &Range<usize>, most: &Vector4<f64>) -> bool {
        let mut margins = self.margins[margins.clone()].iter();
        margins.all(|margin| margin.tolerates(most))
    }
}

impl Face {
    fn is(&self, other: &Self) -> bool {
        (self.position, self.velocity) == (other.position, other.velocity)
    }
}

impl Margin {
    fn new(
        face: &Face,
        (from, to): (&CyclePlace, &CyclePlace),
        step: f64,
        (error_bound, ambiguity): (f64, f64),
        (is_entry, is_exit): (bool, bool),
    ) -> Self {
        let Face {
            position,
            velocity,
            level,
        } = *face;
        let mut margin = Self {
            position,
            velocity,
            clear: f64::INFINITY,
            ends: f64::INFINITY,
            slope: f64::NEG_INFINITY,
            convex: f64::NEG_INFINITY,
        };
        let value = |[x, v, ..]: [f64; 4]| position * x + velocity * v - level;
        let rate = |[_, v, a, _]: [f64; 4]| position * v + velocity * a;
        let (g0, g1) = (value(from.jet), value(to.jet));
        let (r0, r1) = (rate(from.jet), rate(to.jet));
        let is_start = is_entry && g0 >= -ambiguity;
        let third = step / 3.0;
        let (b1, b2) = (g0 + third * r0, g1 - third * r1);
        margin.clear = -(g0.max(g1).max(b1.max(b2)) + error_bound) - ambiguity;
        let start = if is_start {
            f64::INFINITY
        } else {
            -g0 - ambiguity
        };
        let end = if is_exit {
            f64::INFINITY
        } else {
            -g1 - ambiguity
        };
        margin.ends = start.min(end);
        // The rate's Bernstein coefficients are three times the differences of the value's.
        let differences = [b1 - g0, b2 - b1, g1 - b2].map(|difference| difference / third);
        let [d0, d1, d2] = differences;
        if is_start {
            margin.slope = -d0.max(d1).max(d2) - FIRST * error_bound / step;
        } else if is_exit {
            margin.slope = d0.min(d1).min(d2) - FIRST * error_bound / step;
        }
        let second = (d1 - d0).min(d2 - d1) * 2.0 / step;
        margin.convex = second - SECOND * error_bound / (step * step);
        margin
    }

    fn tolerates(&self, most: &Vector4<f64>) -> bool {
        let [position, velocity] = [self.position.abs(), self.velocity.abs()];
        let of = |order: usize| position * most[order] + velocity * most[order + 1];
        let (value, rate, second) = (of(0), of(1), of(2));
        value < self.clear || (value < self.ends && (rate < self.slope || second < self.convex))
    }
}
