//! Derivatives at a scan node and the bounds that follow from them over the next window.

use super::first_rise::GuardPoint;
use super::guard::Guard;
use crate::flow::{ArcSolution, LinearLaw, ScanNode, ScanWindow};

/// Derivatives of position (of order 0 to 6) and forcing (0 to 4) at a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeDerivatives {
    pub node: ScanNode,
    position: [f64; 7],
    forcing: [f64; 5],
    /// Amplitude of the drive on the mass, in m/s^2: none while it is held.
    drive: f64,
}

/// 1/n!.
const INVERSE_FACTORIALS: [f64; 6] = [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0];

/// Value and first derivative of a guard function at both ends of a window.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardEnds {
    pub left: (f64, f64),
    pub right: (f64, f64),
}

impl NodeDerivatives {
    #[inline(always)]
    pub fn new(course: &ArcSolution, node: ScanNode) -> Self {
        let flow = &course.flow;
        let (constant, ramp) = course.linear_forcing_at(node.elapsed);
        let (w, a) = (flow.frequency, flow.amplitude);
        let (cos, sin) = (a * node.drive.cos, a * w * node.drive.sin);
        let square = w * w;
        let forcing = [
            constant + cos,
            ramp - sin,
            -square * cos,
            square * sin,
            square * square * cos,
        ];
        let mut position = [node.position, node.velocity, 0.0, 0.0, 0.0, 0.0, 0.0];
        let held = course.is_held();
        if !held {
            let (twice_decay, b) = (2.0 * flow.modes.decay, flow.modes.stiffness);
            for n in 0..5 {
                let pull = b * position[n];
                position[n + 2] = (forcing[n] - pull) - twice_decay * position[n + 1];
                // From rest the arc starts with the acceleration that its phase was chosen by.
                if n == 0
                    && let Some(chosen) = course.departure.acceleration
                    && node.elapsed == 0.0
                {
                    position[2] = chosen;
                }
            }
        }
        Self {
            node,
            position,
            forcing,
            drive: if held { 0.0 } else { a },
        }
    }

    /// Taylor coefficients of the position in m/s^n.
    pub fn position_series(&self) -> [f64; 6] {
        std::array::from_fn(|n| self.position[n] * INVERSE_FACTORIALS[n])
    }

    /// Taylor coefficients of g, for a guard that does not ask for the forcing.
    pub fn guard_series(&self, guard: &Guard) -> [f64; 6] {
        let x = &self.position;
        let mut series: [f64; 6] = std::array::from_fn(|n| {
            (guard.position * x[n] + guard.velocity * x[n + 1]) * INVERSE_FACTORIALS[n]
        });
        series[0] -= guard.level;
        series
    }

    /// The rounding that g may carry at this node.
    pub fn guard_rounding(&self, guard: &Guard) -> f64 {
        guard.rounding_at(self.position[0], self.position[1], self.forcing[0])
    }

    /// g and g' at this node.
    #[inline(always)]
    pub fn guard_value_and_rate(&self, guard: &Guard) -> (f64, f64) {
        let (x, q) = (&self.position, &self.forcing);
        (
            guard.position * x[0] + guard.velocity * x[1] + guard.forcing * q[0] - guard.level,
            guard.position * x[1] + guard.velocity * x[2] + guard.forcing * q[1],
        )
    }

    /// Bound on |g''| over `span` seconds from this node, as [`NodeDerivatives::bound_g4`] is one on |g''''|.
    /// Under heavy damping it is the sharper one: high derivatives drown in the rounding of the damper's force.
    pub fn bound_g2(&self, flow: &LinearLaw, guard: &Guard, span: f64, (c, s): (f64, f64)) -> f64 {
        let x = &self.position;
        let square = flow.frequency * flow.frequency;
        let drive = self.drive * square;
        let second = x[2].abs() * c + x[3].abs() * s + drive * span * s;
        let third = x[3].abs() * c + x[4].abs() * s + drive * flow.frequency * span * s;
        guard.position.abs() * second
            + guard.velocity.abs() * third
            + guard.forcing.abs() * flow.amplitude * square
    }

    /// Bound on |g''''| over `span` seconds from this node.
    ///
    /// The fourth derivative of the position obeys the phase's own equation under the fourth
    /// derivative of the forcing, which is at most A w^4: variation of constants with the bounds on
    /// the fundamental solutions gives |x''''| <= |x4| C + |x5| S + A w^4 span S.
    #[inline(always)]
    pub fn bound_g4(&self, flow: &LinearLaw, guard: &Guard, span: f64, (c, s): (f64, f64)) -> f64 {
        let x = &self.position;
        let square = flow.frequency * flow.frequency;
        let drive = self.drive * square * square;
        let fourth = x[4].abs() * c + x[5].abs() * s + drive * span * s;
        let mut bound =
            guard.position.abs() * fourth + guard.forcing.abs() * flow.amplitude * square * square;
        if guard.velocity != 0.0 {
            let fifth = x[5].abs() * c + x[6].abs() * s + drive * flow.frequency * span * s;
            bound += guard.velocity.abs() * fifth;
        }
        bound
    }

    /// True if g < 0 for `span` seconds, at most a scan window, from this node on, or from right after it on if g = 0
    /// there, for a guard that does not ask for the forcing.
    pub fn stays_below(&self, flow: &LinearLaw, guard: &Guard, span: f64) -> bool {
        let [value, rate, second, third, ..] = self.guard_series(guard);
        let fourth = self.bound_g4(flow, guard, span, flow.window_bounds) / 24.0;
        let bend = span * (second.max(0.0) + span * (third.max(0.0) + span * fourth));
        let steepest = rate + bend;
        if value == 0.0 {
            steepest < 0.0
        } else {
            value + span * steepest.max(0.0) < 0.0
        }
    }
}

impl GuardEnds {
    /// Ends of a window for a guard that depends on nothing but the position.
    #[inline(always)]
    pub fn of_window(guard: &Guard, window: &ScanWindow<'_>) -> Self {
        let end = |node: &ScanNode| {
            let value = guard.position * node.position - guard.level;
            (value, guard.position * node.velocity)
        };
        Self {
            left: end(window.left),
            right: end(window.right),
        }
    }

    #[inline(always)]
    pub fn new(guard: &Guard, left: &NodeDerivatives, right: &NodeDerivatives) -> Self {
        Self {
            left: left.guard_value_and_rate(guard),
            right: right.guard_value_and_rate(guard),
        }
    }

    /// The ends of a window of length `span`.
    pub fn points(&self, span: f64) -> (GuardPoint, GuardPoint) {
        let at = |at, (value, rate)| GuardPoint { at, value, rate };
        (at(0.0, self.left), at(span, self.right))
    }

    /// True if g < 0 throughout a window of length `span` with |g''| <= `bound`: the chord is off by
    /// at most bound span^2 / 8.
    pub fn stay_below_chord(&self, span: f64, bound: f64) -> bool {
        self.left.0.max(self.right.0) + bound * span * span * 0.125 < 0.0
    }

    /// True if g is indistinguishable from zero throughout a window of length `span` with |g''| <=
    /// `bound`, and at neither end above it: nothing rises there.
    pub fn stay_at_zero(&self, span: f64, bound: f64, rounding: f64) -> bool {
        let (g0, g1) = (self.left.0, self.right.0);
        g0 <= 0.0 && g1 <= 0.0 && bound * span * span * 0.125 - g0.min(g1) <= rounding
    }

    /// True if g < 0 throughout a window of length `span` with |g''''| <= `bound`, or everywhere but at its left end
    /// if g = 0 there.
    ///
    /// The cubic Hermite interpolant is off by at most bound s^2 (span - s)^2 / 24, that is bound span^4 / 384, and
    /// lies below its largest Bernstein coefficient. From zero on it is u = s / span times a parabola, and off by at
    /// most u bound span^4 / 162.
    #[inline(always)]
    pub fn stay_below(&self, span: f64, bound: f64) -> bool {
        let (g0, d0) = self.left;
        let (g1, d1) = self.right;
        let third = span * (1.0 / 3.0);
        let (after, before) = (g0 + third * d0, g1 - third * d1);
        let square = span * span;
        let room = bound * square * square;
        if g0 == 0.0 {
            let limit = room * (-1.0 / 162.0);
            3.0 * after < limit && 1.5 * before < limit && g1 < limit
        } else {
            let limit = room * (-1.0 / 384.0);
            g0 < limit && after < limit && before < limit && g1 < limit
        }
    }
}

/// True if no guard rises up to `until`, a scan window from the departure at most, by the departure's derivatives alone.
pub(crate) fn is_clear_near_start(course: &ArcSolution, guards: &[Guard], until: f64) -> bool {
    if !course.is_bounded() {
        return false;
    }
    let jets = NodeDerivatives::new(course, course.start_node());
    let stays =
        |guard: &Guard| guard.forcing == 0.0 && jets.stays_below(&course.flow, guard, until);
    guards.iter().all(stays)
}
