//! Bounds on the next return of all motions in a ball about a cycle, which prove that they cross the same guards and
//! how far from linear their returns are.
//!
//! A motion is compared with the cycle at equal times since their last crossings, so that it deviates by a state and by the
//! delay of that crossing. Laws are linear: along an arc the linear map leaves out only tau^2 / 2 times the second
//! derivative of the steady motion, tau being the delay. At the end the motion crosses by sigma earlier or later than
//! the cycle; left out are sigma^2 / 2 times the second derivative of the cycle and sigma times the rate of the deviation.
//! The linear part of a deviation is known for the whole ball; [`CrossingRemainder`] bounds all that is left out up to a crossing.

use nalgebra::{Matrix2, Vector2};

use super::arc_bounds::CrossingRemainder;
use super::cycle::Cycle;

/// Bounds on velocity and drive angle of the next return of any motion in a ball about a cycle: on what the linear map and what
/// rounding leave out.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Remainder {
    /// What the linear map leaves out.
    pub curvature: Vector2<f64>,
    /// What rounding may change.
    pub rounding: Vector2<f64>,
}

impl Cycle {
    /// Bounds on what the linear map leaves out of the next return of all motions whose return deviates from that of the cycle by
    /// a vector of `ball`, the image of the unit disc; none if the remainder is too large on some arc.
    pub fn remainder(&self, ball: &Matrix2<f64>) -> Option<Remainder> {
        let mut rest = CrossingRemainder::default();
        let mut remainder = Remainder::default();
        for arc in &self.arcs {
            let passed = arc.bounds(ball, &rest, self.frequency)?;
            rest = arc.remainder_at_exit(&rest, &passed.left_out);
            let to_return = arc.to_return.abs();
            remainder.curvature += to_return * passed.left_out;
            remainder.rounding += to_return * arc.rounding;
        }
        Some(remainder)
    }

    /// True if no motion of the ball, the image of the unit disc, meets another guard than the cycle does.
    pub fn ball_is_clear(&self, ball: &Matrix2<f64>) -> bool {
        let mut rest = CrossingRemainder::default();
        self.arcs.iter().all(|arc| {
            let passed = arc.bounds(ball, &rest, self.frequency);
            passed.is_some_and(|passed| {
                let is_clear = self.arc_is_clear(arc, ball, &rest, &passed);
                rest = arc.remainder_at_exit(&rest, &passed.left_out);
                is_clear
            })
        })
    }
}
