//! The guard that ends a phase, lane by lane: a linear function of position and velocity that rises through zero.

use pulp::Simd;

use super::free_and_steady_parts::Parts;
use super::guard_interval::GuardInterval;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};
use super::window_ahead::WindowAhead;

/// The guard function that each lane may meet in its window, g = position x + velocity v - level, with error bounds.
pub(super) struct WindowGuard<S: Simd, const N: usize> {
    pub position: Lanes<S, N>,
    pub velocity: Lanes<S, N>,
    pub level: Lanes<S, N>,
    pub ambiguity: Lanes<S, N>,
    pub slow: Lanes<S, N>,
    pub error_bound: Lanes<S, N>,
    /// Lanes whose guard is the lower end of the phase, or the further guard; else it is the upper end.
    pub is_low: Mask<S, N>,
    pub is_further: Mask<S, N>,
    /// Lanes that meet no guard in the window, and lanes that may meet more than one.
    pub none: Mask<S, N>,
    pub several: Mask<S, N>,
}

impl<S: Simd, const N: usize> WindowGuard<S, N> {
    /// The guard that each lane may meet in the window ahead; `error_bound`: of the position's cubic over a whole window.
    #[inline(always)]
    pub fn of_window<const HAS_OTHER_ENDS: bool>(
        law: &Laws<S, N>,
        ahead: &WindowAhead<S, N>,
        error_bound: Lanes<S, N>,
    ) -> Self {
        let error_bound = error_bound * ahead.scale;
        if HAS_OTHER_ENDS {
            Self::nearest_guard(law, ahead, error_bound)
        } else {
            Self::single_guard(law, error_bound)
        }
    }

    /// The guard in lanes whose phase one position alone ends.
    #[inline(always)]
    fn single_guard(law: &Laws<S, N>, error_bound: Lanes<S, N>) -> Self {
        let zero = error_bound.like(0.0);
        let never = zero.below(zero);
        Self {
            position: error_bound.like(1.0),
            velocity: zero,
            level: zero,
            ambiguity: law.ambiguity,
            slow: law.slow,
            error_bound,
            is_low: law.side.below(zero),
            is_further: never,
            none: never,
            several: never,
        }
    }

    /// The guard in lanes whose phase has several ends: the one that the motion may meet, by the hull of its cubic.
    #[inline(always)]
    fn nearest_guard(
        law: &Laws<S, N>,
        ahead: &WindowAhead<S, N>,
        error_bound: Lanes<S, N>,
    ) -> Self {
        let one = error_bound.like(1.0);
        let third = ahead.span * one.like(1.0 / 3.0);
        let [x0, v0, a0] = ahead.state_from_edge(law, &ahead.here);
        let [x1, v1, a1] = ahead.state_from_edge(law, &ahead.there);
        let (lowest, highest) = cubic_hull((x0, v0), (x1, v1), third, error_bound);
        let is_low = law.low.below(lowest).not();
        let is_high = highest.below(law.high).not();
        let mut guard = Self {
            position: is_low.choose(-one, one),
            level: is_low.choose(-law.low, law.high),
            is_low,
            none: (is_low | is_high).not(),
            several: is_low & is_high,
            ..Self::single_guard(law, error_bound)
        };
        let rate_error_bound = ahead.here.velocity_error(law) * ahead.scale;
        let ends = [[x0, v0, a0], [x1, v1, a1]];
        let interval =
            GuardInterval::of_further_guard(law, ends, ahead.span, (error_bound, rate_error_bound));
        let further = interval.stays_below().not();
        guard.use_further_guard(law, further, rate_error_bound);
        guard
    }

    /// Replaces the guard by the further one of the phase (friction, release of contact) in the lanes `at`.
    #[inline(always)]
    fn use_further_guard(&mut self, law: &Laws<S, N>, at: Mask<S, N>, rate_error: Lanes<S, N>) {
        let (a, b) = (law.by_position, law.by_velocity);
        self.several = self.several | at.and_not(self.none);
        self.none = self.none.and_not(at);
        self.is_low = self.is_low.and_not(at);
        self.is_further = at;
        self.position = at.choose(a, self.position);
        self.velocity = at.choose(b, self.velocity);
        self.level = at.choose(law.level, self.level);
        self.error_bound = at.choose(
            a.abs() * self.error_bound + b.abs() * rate_error,
            self.error_bound,
        );
        self.ambiguity = at.choose(self.ambiguity * law.guard_scale, self.ambiguity);
        self.slow = at.choose(self.slow * law.guard_scale, self.slow);
    }

    /// Value and rate of the guard at an instant of the window, given by the parts of the motion.
    #[inline(always)]
    pub fn value_and_rate<const HAS_OTHER_ENDS: bool>(
        &self,
        law: &Laws<S, N>,
        ahead: &WindowAhead<S, N>,
        parts: &Parts<S, N>,
    ) -> Pair<S, N> {
        if !HAS_OTHER_ENDS {
            return (parts.y + (parts.p - law.edge), parts.u + parts.q);
        }
        let [x, v, a] = ahead.state_from_edge(law, parts);
        let by_position = self.position.mul_add(x, -self.level);
        (
            self.velocity.mul_add(v, by_position),
            self.velocity.mul_add(a, self.position * v),
        )
    }
}

/// Bounds (low, high) on the position of a motion between two instants with known positions and velocities, by the Bernstein
/// coefficients of its cubic; `third` is a third of the time between, |x''''| span^4 / 384 <= `error_bound`.
#[inline(always)]
fn cubic_hull<S: Simd, const N: usize>(
    left: Pair<S, N>,
    right: Pair<S, N>,
    third: Lanes<S, N>,
    error_bound: Lanes<S, N>,
) -> Pair<S, N> {
    let (b1, b2) = (third.mul_add(left.1, left.0), right.0 - third * right.1);
    (
        left.0.min(right.0).min(b1.min(b2)) - error_bound,
        left.0.max(right.0).max(b1.max(b2)) + error_bound,
    )
}
