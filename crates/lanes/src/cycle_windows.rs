//! The windows of a cycle: how far another motion may deviate in each and provably meet no other guard.

use std::ops::Range;

use nalgebra::Vector4;

use super::cycle_state::{CycleState, Derivatives};
use super::lane_laws::{PhaseConstants, WINDOW_ANGLE};
use softstop::internals::Guard;

/// Error sqrt(3)/216 M h^3 of the first derivative of a cubic Hermite interpolant over a step h, times h, in units of the error M
/// h^4 / 384 of its value; M: largest fourth derivative (Birkhoff and Priver 1967).
const RATE_ERROR: f64 = 384.0 * 0.008_018_753_738_744_818;

/// The windows into which a trial cycle is divided, one after another, with the margins of the guards in each.
#[derive(Debug, Default)]
pub(super) struct CycleWindows {
    pub all: Vec<CycleWindow>,
    /// The margins of the guards of their phases, window by window.
    margins: Vec<WindowMargin>,
}

/// A window of an arc of a trial cycle.
#[derive(Debug)]
pub(super) struct CycleWindow {
    /// Derivatives of the state at its start.
    pub at_start: Derivatives,
    /// Length in s, and the factor by which a free motion may grow in it.
    pub step: f64,
    pub growth: f64,
    margins: Range<usize>,
}

/// The margin of a guard in a window of a trial cycle: how far value, rate and second derivative of the guard may
/// deviate for it to be provably not met, or at the end of an arc not before that end.
#[derive(Debug, Clone, Copy)]
struct WindowMargin {
    /// Weights of position and velocity.
    position: f64,
    velocity: f64,
    /// Largest deviation of the value where the whole window is far from the guard.
    clear: f64,
    /// Largest deviation of the value where only both ends are far from it: then the rate must keep its sign, or the value be
    /// convex, which holds up to these deviations of the rate and of the second derivative.
    ends: f64,
    rate: f64,
    second: f64,
}

impl CycleWindows {
    pub fn clear(&mut self) {
        self.all.clear();
        self.margins.clear();
    }

    /// Adds the window between two states of an arc, with the guards at which the arc begins or ends in it; false if the cycle
    /// itself is not proven to stay clear of the other guards.
    pub fn add_window(
        &mut self,
        law: &PhaseConstants,
        (from, to): (&CycleState, &CycleState),
        step: f64,
        (entry, exit): (Option<Guard>, Option<Guard>),
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
        let margin = |guard: Guard| {
            let error_bound =
                guard.position.abs() * error_bound + guard.velocity.abs() * rate_error_bound;
            let ambiguity = match guard.velocity {
                0.0 => law.ambiguity,
                _ => law.ambiguity * law.guard_scale,
            };
            // Levels of the same function of position and velocity.
            let gradient = (guard.position, guard.velocity);
            let [is_entry, is_exit] =
                [entry, exit].map(|it| it.is_some_and(|it| (it.position, it.velocity) == gradient));
            WindowMargin::of_guard(
                &guard,
                (from, to),
                step,
                (error_bound, ambiguity),
                (is_entry, is_exit),
            )
        };
        let guards = law.guards().into_iter();
        let within_reach = guards.filter(|guard| guard.level < f64::INFINITY);
        let first = self.margins.len();
        self.margins.extend(within_reach.map(margin));
        let window = CycleWindow {
            at_start,
            step,
            growth: if law.stiffness < 0.0 {
                1.0
            } else {
                WINDOW_ANGLE.exp()
            },
            margins: first..self.margins.len(),
        };
        let is_clear = self.is_clear(&window, &Vector4::zeros());
        if is_clear {
            self.all.push(window);
        } else {
            self.margins.truncate(first);
        }
        is_clear
    }

    /// True if no motion meets another guard in a window whose position and derivatives deviate from the cycle by at most `most`.
    pub fn is_clear(&self, window: &CycleWindow, most: &Vector4<f64>) -> bool {
        let mut margins = self.margins[window.margins.clone()].iter();
        margins.all(|margin| margin.tolerates_deviation(most))
    }
}

impl WindowMargin {
    fn of_guard(
        guard: &Guard,
        (from, to): (&CycleState, &CycleState),
        step: f64,
        (error_bound, ambiguity): (f64, f64),
        (is_entry, is_exit): (bool, bool),
    ) -> Self {
        let Guard {
            position, velocity, ..
        } = *guard;
        let mut margin = Self {
            position,
            velocity,
            clear: f64::INFINITY,
            ends: f64::INFINITY,
            rate: f64::NEG_INFINITY,
            second: f64::NEG_INFINITY,
        };
        let value = |[x, v, ..]: [f64; 4]| guard.value_at(x, v);
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
            margin.rate = -d0.max(d1).max(d2) - RATE_ERROR * error_bound / step;
        } else if is_exit {
            margin.rate = d0.min(d1).min(d2) - RATE_ERROR * error_bound / step;
        }
        let second = (d1 - d0).min(d2 - d1) * 2.0 / step;
        // The second derivative of the cubic is off by M h^2 / 12 at most.
        margin.second = second - 384.0 / 12.0 * error_bound / (step * step);
        margin
    }

    fn tolerates_deviation(&self, most: &Vector4<f64>) -> bool {
        let [position, velocity] = [self.position.abs(), self.velocity.abs()];
        let of = |order: usize| position * most[order] + velocity * most[order + 1];
        let (value, rate, second) = (of(0), of(1), of(2));
        value < self.clear || (value < self.ends && (rate < self.rate || second < self.second))
    }
}
