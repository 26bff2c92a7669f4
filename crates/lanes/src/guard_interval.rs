//! What is proven of a guard function over a stretch of time, lane by lane.
//!
//! The certificates are those of the safe engine: the cubic Hermite interpolant with the bound on
//! the fourth derivative encloses the function, its slope and its curvature.

use pulp::Simd;

use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};

/// A guard function g over [0, span]: values and rates at both ends, and the error bound |g''''| span^4 / 384 of their cubic.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardInterval<S: Simd, const N: usize> {
    pub left: Pair<S, N>,
    pub right: Pair<S, N>,
    pub span: Lanes<S, N>,
    pub error_bound: Lanes<S, N>,
}

/// What is proven of a guard function over an interval; a lane in which nothing is true has to divide the interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct IntervalVerdict<S: Simd, const N: usize> {
    /// g rises through zero nowhere.
    pub clear: Mask<S, N>,
    /// g rises through zero once, and is above it at the end.
    pub rises: Mask<S, N>,
    /// g has one maximum inside and is not above zero at the ends.
    pub hump: Mask<S, N>,
}

impl<S: Simd, const N: usize> GuardInterval<S, N> {
    /// The interval of the phase's further guard (friction, release of contact) between two ends with their positions, velocities
    /// and accelerations; `error_bounds`: of the cubics of position and velocity.
    #[inline(always)]
    pub fn of_further_guard(
        law: &Laws<S, N>,
        [left, right]: [[Lanes<S, N>; 3]; 2],
        span: Lanes<S, N>,
        (error_bound, rate_error_bound): Pair<S, N>,
    ) -> Self {
        let (a, b) = (law.by_position.abs(), law.by_velocity.abs());
        Self {
            left: law.further_guard(left),
            right: law.further_guard(right),
            span,
            error_bound: a.mul_add(error_bound, b * rate_error_bound),
        }
    }

    /// The two inner Bernstein coefficients of the cubic through the values and rates.
    #[inline(always)]
    fn inner_bernstein(&self) -> Pair<S, N> {
        let ((g0, d0), (g1, d1)) = (self.left, self.right);
        let third = self.span * g0.like(1.0 / 3.0);
        (third.mul_add(d0, g0), g1 - third * d1)
    }

    /// True where the guard function is proven negative by the hull of its cubic.
    #[inline(always)]
    pub fn stays_below(&self) -> Mask<S, N> {
        let (b1, b2) = self.inner_bernstein();
        let high = self.left.0.max(self.right.0).max(b1.max(b2));
        (high + self.error_bound).below(high.like(0.0))
    }

    /// True where the phase's further guard, of which this is the interval, provably does not rise through zero, nor comes within
    /// rounding of zero at the end.
    #[inline(always)]
    pub fn is_clear_of_further(&self, law: &Laws<S, N>) -> Mask<S, N> {
        let ((g0, d0), (g1, d1)) = (self.left, self.right);
        let (zero, scale) = (g0.like(0.0), law.guard_scale);
        let (ambiguity, slow) = (law.ambiguity * scale, law.slow * scale);
        let touches = (-ambiguity).below(g0);
        let leaves = touches & d0.below(-slow) & g0.at_most(ambiguity);
        let ends_there = (-ambiguity).below(g1) & zero.below(d1);
        let error_bound = touches.choose(self.error_bound, self.error_bound + ambiguity);
        let interval = Self {
            error_bound,
            ..*self
        };
        interval.judge(touches, leaves).clear.and_not(ends_there)
    }

    /// Proves what it can of the guard function. `touches`: it begins within rounding of zero; `leaves`: and falls there.
    #[inline(always)]
    pub fn judge(&self, touches: Mask<S, N>, leaves: Mask<S, N>) -> IntervalVerdict<S, N> {
        let ((g0, d0), (g1, d1)) = (self.left, self.right);
        let zero = g0.like(0.0);
        let (b1, b2) = self.inner_bernstein();
        let inverse = g0.like(1.0) / self.span;
        let slopes = [d0, (b2 - b1) * inverse * g0.like(3.0), d1];
        // sqrt(3)/216 |g''''| span^3 (Birkhoff and Priver 1967), and |g''''| span^2 / 12.
        let slope_error_bound = self.error_bound * inverse * g0.like(384.0 * 0.00802);
        let falls = (slopes[0].max(slopes[1]).max(slopes[2]) + slope_error_bound).below(zero);
        let climbs = zero.below(slopes[0].min(slopes[1]).min(slopes[2]) - slope_error_bound);
        let curvatures = [slopes[1] - slopes[0], slopes[2] - slopes[1]];
        let error_bound = self.error_bound * inverse * g0.like(16.0);
        let convex = zero.below(curvatures[0].min(curvatures[1]) - error_bound);
        let concave = (curvatures[0].max(curvatures[1]) + error_bound).below(zero);

        let apart = touches.not();
        let sound = apart | leaves;
        let above = zero.below(g1);
        let turns = zero.below(d0) & d1.below(zero);
        let rises = above & ((apart & (climbs | convex | concave)) | (leaves & convex));
        let quiet = falls | convex | (apart & climbs) | concave.and_not(turns);
        let clear = self.stays_below() | (sound & quiet).and_not(above);
        let hump = (concave & turns & apart).and_not(above);
        IntervalVerdict {
            clear,
            rises,
            hump: hump.and_not(clear),
        }
    }
}
