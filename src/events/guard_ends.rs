//! A guard at both ends of a scan window, and what its values there prove of all the window.

use super::guard::Guard;
use super::node_derivatives::NodeDerivatives;
use super::rise_verdict::GuardPoint;
use crate::flow::{ScanNode, ScanWindow};

/// Value and first time derivative of a guard at both ends of a scan window.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardEnds {
    pub left: (f64, f64),
    pub right: (f64, f64),
}

impl GuardEnds {
    /// The ends of a window for a guard of the position alone.
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

    /// Both ends as points of an interval from 0 to the length `span` of the window.
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

    /// True if g < 0 throughout a window of length `span` with |g''''| <= `bound`, but for its left end if g = 0 there.
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
