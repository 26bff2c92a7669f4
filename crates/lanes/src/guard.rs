//! The guard that ends a phase, and where it rises through zero.

use pulp::Simd;

use super::judge::Stretch;
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
    pub grain: Lanes<S, N>,
    pub slow: Lanes<S, N>,
    pub slack: Lanes<S, N>,
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
        slack: Lanes<S, N>,
    ) -> Self {
        let slack = slack * ahead.scale;
        if GUARDED {
            Self::of_several(law, ahead, slack)
        } else {
            Self::of_one(law, slack)
        }
    }

    /// The one that ends the phase.
    #[inline(always)]
    fn of_one(law: &Law<S, N>, slack: Lanes<S, N>) -> Self {
        let zero = slack.like(0.0);
        let never = zero.below(zero);
        Self {
            position: slack.like(1.0),
            velocity: zero,
            level: zero,
            grain: law.grain,
            slow: law.slow,
            slack,
            is_low: law.side.below(zero),
            is_further: never,
            none: never,
            several: never,
        }
    }

    /// The one that may be met.
    #[inline(always)]
    fn of_several(law: &Law<S, N>, ahead: &Ahead<S, N>, slack: Lanes<S, N>) -> Self {
        let one = slack.like(1.0);
        let third = ahead.span * one.like(1.0 / 3.0);
        let [x0, v0, a0] = ahead.state(law, &ahead.here);
        let [x1, v1, a1] = ahead.state(law, &ahead.there);
        let hull = Hull::of((x0, v0), (x1, v1), third, slack);
        let is_low = law.low.below(hull.low).not();
        let is_high = hull.high.below(law.high).not();
        let mut guard = Self {
            position: is_low.choose(-one, one),
            level: is_low.choose(-law.low, law.high),
            is_low,
            none: (is_low | is_high).not(),
            several: is_low & is_high,
            ..Self::of_one(law, slack)
        };
        let rate_slack = law.rate_slack(&ahead.here) * ahead.scale;
        let ends = [[x0, v0, a0], [x1, v1, a1]];
        let stretch = Stretch::of_further(law, ends, ahead.span, (slack, rate_slack));
        let further = stretch.stays_below().not();
        guard.turn_to_further(law, further, rate_slack);
        guard
    }

    /// Looks at the further guard in the lanes `at` instead.
    #[inline(always)]
    fn turn_to_further(&mut self, law: &Law<S, N>, at: Mask<S, N>, rate_slack: Lanes<S, N>) {
        let (a, b) = (law.by_position, law.by_velocity);
        self.several = self.several | at.and_not(self.none);
        self.none = self.none.and_not(at);
        self.is_low = self.is_low.and_not(at);
        self.is_further = at;
        self.position = at.choose(a, self.position);
        self.velocity = at.choose(b, self.velocity);
        self.level = at.choose(law.level, self.level);
        self.slack = at.choose(a.abs() * self.slack + b.abs() * rate_slack, self.slack);
        self.grain = at.choose(self.grain * law.guard_scale, self.grain);
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
