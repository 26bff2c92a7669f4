//! A motion split into its free and its steady part.

use pulp::Simd;

use super::engine::Engine;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};
use super::sine_cosine::{HALF_WINDOW_DEGREE, cos_sinc};

/// A motion in every lane as the sum of a free part, position y and velocity u, and the steady part under the drive, p and q.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts<S: Simd, const N: usize> {
    pub y: Lanes<S, N>,
    pub u: Lanes<S, N>,
    pub p: Lanes<S, N>,
    pub q: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Parts<S, N> {
    /// Free and steady part one window later.
    #[inline(always)]
    pub fn after_window(&self, law: &Laws<S, N>) -> Self {
        let Self { y, u, p, q } = *self;
        Self {
            y: law.xx.mul_add(y, law.xv * u),
            u: law.vx.mul_add(y, law.vv * u),
            p: law.turn.mul_add(p, law.turn_by_velocity * q),
            q: law.turn.mul_add(q, law.turn_by_position * p),
        }
    }

    /// Free and steady part after `time` of at most a window, from its nearer end; `next`: the parts at its later end.
    #[inline(always)]
    pub fn within_window(
        &self,
        law: &Laws<S, N>,
        frequency: Lanes<S, N>,
        next: &Self,
        time: Lanes<S, N>,
    ) -> Self {
        let late = (law.window * time.like(0.5)).below(time);
        let base = Self::choose(late, next, self);
        base.after_time(law, frequency, late.choose(time - law.window, time))
    }

    /// Free and steady part after `time` of at most half a window, forwards or backwards.
    #[inline(always)]
    pub fn after_time(&self, law: &Laws<S, N>, frequency: Lanes<S, N>, time: Lanes<S, N>) -> Self {
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
        .turn_drive::<HALF_WINDOW_DEGREE>(frequency, time)
    }

    /// These parts with the steady one moved on by `time`, by cosine and sine series of degree `DEGREE`; the free part stays.
    #[inline(always)]
    pub fn turn_drive<const DEGREE: usize>(
        &self,
        frequency: Lanes<S, N>,
        time: Lanes<S, N>,
    ) -> Self {
        let angle = frequency * time;
        let (cos, sinc) = cos_sinc::<S, N, DEGREE>(angle * angle);
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

    /// Bound |x''''| window^4 / 384 on the error of the cubic through positions and velocities over the next window; in phases
    /// that one position alone ends, over all windows of a scan.
    #[inline(always)]
    pub fn position_error(&self, law: &Laws<S, N>) -> Lanes<S, N> {
        let Self { y, u, .. } = *self;
        let fourth = law.fourth_x.mul_add(y, law.fourth_v * u).abs();
        let fifth = law.fifth_x.mul_add(y, law.fifth_v * u).abs();
        law.steady + fourth + fifth
    }

    /// Bound |v''''| window^4 / 384 on the error of the cubic through velocities and accelerations over the next window.
    #[inline(always)]
    pub fn velocity_error(&self, law: &Laws<S, N>) -> Lanes<S, N> {
        let Self { y, u, .. } = *self;
        let fifth = law.rate_fifth_x.mul_add(y, law.rate_fifth_v * u).abs();
        let sixth = law.rate_sixth_x.mul_add(y, law.rate_sixth_v * u).abs();
        law.rate_steady + fifth + sixth
    }

    /// cos and sin of the drive angle, computed from the steady part.
    #[inline(always)]
    pub fn drive_angle(&self, law: &Laws<S, N>) -> Pair<S, N> {
        let Self { p, q, .. } = *self;
        (
            law.cosine_of_position
                .mul_add(p, law.cosine_of_velocity * q),
            law.sine_of_position.mul_add(p, law.sine_of_velocity * q),
        )
    }

    /// The acceleration x'' of the whole motion, of both parts.
    #[inline(always)]
    pub fn acceleration(&self, law: &Laws<S, N>, frequency: Lanes<S, N>) -> Lanes<S, N> {
        let steady = -(frequency * frequency * self.p);
        law.stiffness
            .mul_add(self.y, law.damping.mul_add(self.u, steady))
    }

    /// The third and fourth derivative x''' and x'''' of the whole motion, of both parts.
    #[inline(always)]
    pub fn jerk_and_snap(&self, law: &Laws<S, N>, frequency: Lanes<S, N>) -> Pair<S, N> {
        let turn = -(frequency * frequency);
        let second = law.differentiate_free((self.y, self.u));
        let third = law.differentiate_free(second);
        let (third, fourth) = law.differentiate_free(third);
        let steady = turn * self.p;
        (turn.mul_add(self.q, third), turn.mul_add(steady, fourth))
    }

    /// Position and velocity of a free motion (y, u) after a time of any length.
    #[inline(always)]
    pub fn free_after(
        law: &Laws<S, N>,
        frequency: Lanes<S, N>,
        time: Lanes<S, N>,
        (y, u): Pair<S, N>,
    ) -> Pair<S, N> {
        let windows = time.mul_add(law.per_window, y.like(0.5)).floor();
        let parts = Self {
            y,
            u,
            p: y.like(0.0),
            q: y.like(0.0),
        };
        let begun = parts.after_time(law, frequency, time.minus_product(windows, law.window));
        law.free_after_whole(windows, (begun.y, begun.u))
    }
}

impl<S: Simd, const N: usize> Laws<S, N> {
    /// Rate and second derivative of a free motion, or of a derivative of it, from its value and rate.
    #[inline(always)]
    pub fn differentiate_free(&self, (free, rate): Pair<S, N>) -> Pair<S, N> {
        (rate, self.stiffness.mul_add(free, self.damping * rate))
    }

    /// Position and velocity of a free motion (y, u) after a number of windows, by powers of the transition matrix of one.
    #[inline(always)]
    pub fn free_after_whole(&self, windows: Lanes<S, N>, (mut y, mut u): Pair<S, N>) -> Pair<S, N> {
        let (zero, one, half) = (y.like(0.0), y.like(1.0), y.like(0.5));
        let (mut xx, mut xv, mut vx, mut vv) = (self.xx, self.xv, self.vx, self.vv);
        let mut left = windows;
        while zero.below(left).any() {
            let halved = (left * half).floor();
            let odd = one.equals(left - (halved + halved));
            let (next_y, next_u) = (xx.mul_add(y, xv * u), vx.mul_add(y, vv * u));
            (y, u) = (odd.choose(next_y, y), odd.choose(next_u, u));
            let (trace, cross) = (xx + vv, xv * vx);
            (xx, vv) = (xx.mul_add(xx, cross), vv.mul_add(vv, cross));
            (xv, vx) = (xv * trace, vx * trace);
            left = halved;
        }
        (y, u)
    }
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Free and steady part of the present motion of all lanes, as signed distances side (x - offset).
    #[inline(always)]
    pub fn motion_parts(&self, law: &Laws<S, N>) -> Parts<S, N> {
        let (cos, sin) = self.state.angle;
        let p = law.cosine.mul_add(cos, law.sine * sin);
        let q = law.cosine_rate.mul_add(cos, law.sine_rate * sin);
        let side = law.side;
        Parts {
            y: side.mul_add(self.state.x - law.offset, -p),
            u: side.mul_add(self.state.v, -q),
            p,
            q,
        }
    }
}
