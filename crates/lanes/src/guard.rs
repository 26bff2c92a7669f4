//! The guard that ends a phase, and where it rises through zero.

use pulp::Simd;

use super::guard_interval::GuardInterval;
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::{Hull, Parts};

/// A window, or the part of it that is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ahead<S: Simd, const N: usize> {
    pub frequency: Lanes<S, N>,
    /// The motion now, at the end of what is looked at, and a window from now.
    pub here: Parts<S, N>,
    pub there: Parts<S, N>,
    pub next: Parts<S, N>,
    pub span: Lanes<S, N>,
    /// (span / window)^4.
    pub scale: Lanes<S, N>,
}

/// The guard that each lane has to look at: g = position x + velocity v - level.
pub(super) struct Guard<S: Simd, const N: usize> {
    pub position: Lanes<S, N>,
    pub velocity: Lanes<S, N>,
    pub level: Lanes<S, N>,
    pub ambiguity: Lanes<S, N>,
    pub slow: Lanes<S, N>,
    pub error_bound: Lanes<S, N>,
    /// The lower end of the phase, or the further guard; else the upper end.
    pub is_low: Mask<S, N>,
    pub is_further: Mask<S, N>,
    /// Lanes that meet none, and lanes that may meet more than one.
    pub none: Mask<S, N>,
    pub several: Mask<S, N>,
}

impl<S: Simd, const N: usize> Ahead<S, N> {
    /// The motion at a time within the window.
    #[inline(always)]
    pub fn at(&self, law: &Law<S, N>, time: Lanes<S, N>) -> Parts<S, N> {
        self.here.at(law, self.frequency, &self.next, time)
    }

    /// Position from the edge, velocity and acceleration.
    #[inline(always)]
    fn state(&self, law: &Law<S, N>, parts: &Parts<S, N>) -> [Lanes<S, N>; 3] {
        [
            parts.y + (parts.p - law.edge),
            parts.u + parts.q,
            law.acceleration(self.frequency, parts),
        ]
    }
}

impl<S: Simd, const N: usize> Guard<S, N> {
    #[inline(always)]
    pub fn of<const GUARDED: bool>(
        law: &Law<S, N>,
        ahead: &Ahead<S, N>,
        error_bound: Lanes<S, N>,
    ) -> Self {
        let error_bound = error_bound * ahead.scale;
        if GUARDED {
            Self::of_several(law, ahead, error_bound)
        } else {
            Self::of_one(law, error_bound)
        }
    }

    /// The one that ends the phase.
    #[inline(always)]
    fn of_one(law: &Law<S, N>, error_bound: Lanes<S, N>) -> Self {
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

    /// The one that may be met.
    #[inline(always)]
    fn of_several(law: &Law<S, N>, ahead: &Ahead<S, N>, error_bound: Lanes<S, N>) -> Self {
        let one = error_bound.like(1.0);
        let third = ahead.span * one.like(1.0 / 3.0);
        let [x0, v0, a0] = ahead.state(law, &ahead.here);
        let [x1, v1, a1] = ahead.state(law, &ahead.there);
        let hull = Hull::of((x0, v0), (x1, v1), third, error_bound);
        let is_low = law.low.below(hull.low).not();
        let is_high = hull.high.below(law.high).not();
        let mut guard = Self {
            position: is_low.choose(-one, one),
            level: is_low.choose(-law.low, law.high),
            is_low,
            none: (is_low | is_high).not(),
            several: is_low & is_high,
            ..Self::of_one(law, error_bound)
        };
        let rate_error_bound = law.rate_error_bound(&ahead.here) * ahead.scale;
        let ends = [[x0, v0, a0], [x1, v1, a1]];
        let interval =
            GuardInterval::of_further(law, ends, ahead.span, (error_bound, rate_error_bound));
        let further = interval.stays_below().not();
        guard.turn_to_further(law, further, rate_error_bound);
        guard
    }

    /// Looks at the further guard in the lanes `at` instead.
    #[inline(always)]
    fn turn_to_further(&mut self, law: &Law<S, N>, at: Mask<S, N>, rate_error_bound: Lanes<S, N>) {
        let (a, b) = (law.by_position, law.by_velocity);
        self.several = self.several | at.and_not(self.none);
        self.none = self.none.and_not(at);
        self.is_low = self.is_low.and_not(at);
        self.is_further = at;
        self.position = at.choose(a, self.position);
        self.velocity = at.choose(b, self.velocity);
        self.level = at.choose(law.level, self.level);
        self.error_bound = at.choose(
            a.abs() * self.error_bound + b.abs() * rate_error_bound,
            self.error_bound,
        );
        self.ambiguity = at.choose(self.ambiguity * law.guard_scale, self.ambiguity);
        self.slow = at.choose(self.slow * law.guard_scale, self.slow);
    }

    /// Value and rate.
    #[inline(always)]
    pub fn of_parts<const GUARDED: bool>(
        &self,
        law: &Law<S, N>,
        ahead: &Ahead<S, N>,
        parts: &Parts<S, N>,
    ) -> (Lanes<S, N>, Lanes<S, N>) {
        if !GUARDED {
            return (parts.y + (parts.p - law.edge), parts.u + parts.q);
        }
        let [x, v, a] = ahead.state(law, parts);
        let by_position = self.position.mul_add(x, -self.level);
        (
            self.velocity.mul_add(v, by_position),
            self.velocity.mul_add(a, self.position * v),
        )
    }
}
