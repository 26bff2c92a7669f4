//! A motion in its free and its steady part, and what encloses it.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::taylor::{HALF_WINDOW, cos_sinc};

/// A motion as the sum of a free one (y, u) and the steady one (p, q): positions and velocities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts<S: Simd, const N: usize> {
    pub y: Lanes<S, N>,
    pub u: Lanes<S, N>,
    pub p: Lanes<S, N>,
    pub q: Lanes<S, N>,
}

/// The enclosure of a motion over a stretch of time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull<S: Simd, const N: usize> {
    /// Positions that it stays between.
    pub low: Lanes<S, N>,
    pub high: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Hull<S, N> {
    /// Of a motion with these positions and velocities at both ends, |x''''| span^4 / 384 <= error bound.
    #[inline(always)]
    pub fn of(
        left: (Lanes<S, N>, Lanes<S, N>),
        right: (Lanes<S, N>, Lanes<S, N>),
        third: Lanes<S, N>,
        error_bound: Lanes<S, N>,
    ) -> Self {
        let (b1, b2) = (third.mul_add(left.1, left.0), right.0 - third * right.1);
        Self {
            low: left.0.min(right.0).min(b1.min(b2)) - error_bound,
            high: left.0.max(right.0).max(b1.max(b2)) + error_bound,
        }
    }
}

impl<S: Simd, const N: usize> Parts<S, N> {
    /// The parts one window later.
    #[inline(always)]
    pub fn next(&self, law: &Law<S, N>) -> Self {
        let Self { y, u, p, q } = *self;
        Self {
            y: law.xx.mul_add(y, law.xv * u),
            u: law.vx.mul_add(y, law.vv * u),
            p: law.turn.mul_add(p, law.turn_by_velocity * q),
            q: law.turn.mul_add(q, law.turn_by_position * p),
        }
    }

    /// The parts after `time` of at most a window, `next` being those at its end.
    #[inline(always)]
    pub fn at(
        &self,
        law: &Law<S, N>,
        frequency: Lanes<S, N>,
        next: &Self,
        time: Lanes<S, N>,
    ) -> Self {
        let late = (law.window * time.like(0.5)).below(time);
        let base = Self::choose(late, next, self);
        base.after(law, frequency, late.choose(time - law.window, time))
    }

    /// The parts after `time` of at most half a window either way.
    #[inline(always)]
    pub fn after(&self, law: &Law<S, N>, frequency: Lanes<S, N>, time: Lanes<S, N>) -> Self {
        let Self { y, u, p, q } = *self;
        let share = time * law.per_window;
        let mut position = law.response[law.response.len() - 1];
        let mut vv = position.like(0.0);
        for term in law.response[..law.response.len() - 1].iter().rev() {
            vv = vv.mul_add(share, position);
            position = position.mul_add(share, *term);
        }
        vv = vv.mul_add(share, position);
        let xv = position * time;
        let xx = vv - law.damping * xv;
        let vx = law.stiffness * xv;
        Self {
            y: xx.mul_add(y, xv * u),
            u: vx.mul_add(y, vv * u),
            p,
            q,
        }
        .turned::<HALF_WINDOW>(frequency, time)
    }

    /// These parts with the drive turned on for a `time` that this many terms are enough for.
    #[inline(always)]
    pub fn turned<const TERMS: usize>(&self, frequency: Lanes<S, N>, time: Lanes<S, N>) -> Self {
        let angle = frequency * time;
        let (cos, sinc) = cos_sinc::<S, N, TERMS>(angle * angle);
        let by_velocity = sinc * time;
        let by_position = -(sinc * angle * frequency);
        Self {
            p: cos.mul_add(self.p, by_velocity * self.q),
            q: cos.mul_add(self.q, by_position * self.p),
            ..*self
        }
    }

    #[inline(always)]
    pub fn choose(mask: Mask<S, N>, yes: &Self, no: &Self) -> Self {
        Self {
            y: mask.choose(yes.y, no.y),
            u: mask.choose(yes.u, no.u),
            p: mask.choose(yes.p, no.p),
            q: mask.choose(yes.q, no.q),
        }
    }
}

impl<S: Simd, const N: usize> Law<S, N> {
    /// |x''''| window^4 / 384 over the next window, of a motion whose free part is (y, u). In phases that only
    /// a position ends, over all windows of a scan.
    #[inline(always)]
    pub fn error_bound(&self, parts: &Parts<S, N>) -> Lanes<S, N> {
        let Parts { y, u, .. } = *parts;
        let fourth = self.fourth_x.mul_add(y, self.fourth_v * u).abs();
        let fifth = self.fifth_x.mul_add(y, self.fifth_v * u).abs();
        self.steady + fourth + fifth
    }

    /// Bound on the error of the interpolated velocity, by |v''''|.
    #[inline(always)]
    pub fn rate_error_bound(&self, parts: &Parts<S, N>) -> Lanes<S, N> {
        let Parts { y, u, .. } = *parts;
        let fifth = self.rate_fifth_x.mul_add(y, self.rate_fifth_v * u).abs();
        let sixth = self.rate_sixth_x.mul_add(y, self.rate_sixth_v * u).abs();
        self.rate_steady + fifth + sixth
    }

    /// cos and sin of the drive angle.
    #[inline(always)]
    pub fn angle(&self, parts: &Parts<S, N>) -> (Lanes<S, N>, Lanes<S, N>) {
        let Parts { p, q, .. } = *parts;
        (
            self.cosine_of_position
                .mul_add(p, self.cosine_of_velocity * q),
            self.sine_of_position.mul_add(p, self.sine_of_velocity * q),
        )
    }

    /// The next two derivatives of a free motion.
    #[inline(always)]
    pub fn next_derivative(
        &self,
        (free, rate): (Lanes<S, N>, Lanes<S, N>),
    ) -> (Lanes<S, N>, Lanes<S, N>) {
        (rate, self.stiffness.mul_add(free, self.damping * rate))
    }

    /// x'' of the two parts together.
    #[inline(always)]
    pub fn acceleration(&self, frequency: Lanes<S, N>, parts: &Parts<S, N>) -> Lanes<S, N> {
        let steady = -(frequency * frequency * parts.p);
        self.stiffness
            .mul_add(parts.y, self.damping.mul_add(parts.u, steady))
    }

    /// x''' and x'''' of the two parts together.
    #[inline(always)]
    pub fn jerk_and_snap(
        &self,
        frequency: Lanes<S, N>,
        parts: &Parts<S, N>,
    ) -> (Lanes<S, N>, Lanes<S, N>) {
        let turn = -(frequency * frequency);
        let second = self.next_derivative((parts.y, parts.u));
        let third = self.next_derivative(second);
        let (third, fourth) = self.next_derivative(third);
        let steady = turn * parts.p;
        (turn.mul_add(parts.q, third), turn.mul_add(steady, fourth))
    }

    /// True where the further guard is the end of the velocity, under dry friction.
    #[inline(always)]
    pub fn reverses(&self) -> Mask<S, N> {
        let zero = self.level.like(0.0);
        self.by_position.equals(zero) & self.level.equals(zero)
    }

    /// Value and rate of the further guard at a position, velocity and acceleration.
    #[inline(always)]
    pub fn further(&self, [x, v, a]: [Lanes<S, N>; 3]) -> (Lanes<S, N>, Lanes<S, N>) {
        let by_position = self.by_position.mul_add(x, -self.level);
        (
            self.by_velocity.mul_add(v, by_position),
            self.by_velocity.mul_add(a, self.by_position * v),
        )
    }
}
