//! Window by window, as long as nothing can happen.

use pulp::Simd;

use super::Watch;
use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::law::Law;

/// Windows that are scanned before the lanes that wait are looked at: about a drive period.
const MOST_WINDOWS: usize = 12;

/// The enclosure of a motion over a stretch of time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull<S: Simd> {
    /// Positions that it stays between.
    pub low: Lanes<S>,
    pub high: Lanes<S>,
}

impl<S: Simd> Hull<S> {
    /// Of a motion with these positions and velocities at both ends, |x''''| span^4 / 384 <= slack.
    #[inline(always)]
    pub fn of(
        left: (Lanes<S>, Lanes<S>),
        right: (Lanes<S>, Lanes<S>),
        third: Lanes<S>,
        slack: Lanes<S>,
    ) -> Self {
        let (b1, b2) = (third.mul_add(left.1, left.0), right.0 - third * right.1);
        Self {
            low: left.0.min(right.0).min(b1.min(b2)) - slack,
            high: left.0.max(right.0).max(b1.max(b2)) + slack,
        }
    }
}

impl<S: Simd> Law<S> {
    /// Position and velocity of the particular solution.
    #[inline(always)]
    pub fn particular(&self, cos: Lanes<S>, sin: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        let x = self
            .cosine
            .mul_add(cos, self.sine.mul_add(sin, self.offset));
        let v = self.cosine_rate.mul_add(cos, self.sine_rate * sin);
        (x, v)
    }

    /// |x''''| window^4 / 384 over the next window, of a motion whose free part is (y, u).
    #[inline(always)]
    pub fn slack(&self, y: Lanes<S>, u: Lanes<S>) -> Lanes<S> {
        let fourth = self.fourth_x.mul_add(y, self.fourth_v * u).abs();
        let fifth = self.fifth_x.mul_add(y, self.fifth_v * u).abs();
        self.steady + fourth + fifth
    }

    /// The same of |v''''|.
    #[inline(always)]
    pub fn rate_slack(&self, y: Lanes<S>, u: Lanes<S>) -> Lanes<S> {
        let fifth = self.rate_fifth_x.mul_add(y, self.rate_fifth_v * u).abs();
        let sixth = self.rate_sixth_x.mul_add(y, self.rate_sixth_v * u).abs();
        self.rate_steady + fifth + sixth
    }

    /// x'' of a state under the drive A cos(angle).
    #[inline(always)]
    pub fn acceleration(&self, x: Lanes<S>, v: Lanes<S>, drive: Lanes<S>) -> Lanes<S> {
        let damped = self.damping.mul_add(v, drive + self.force);
        self.stiffness.mul_add(x, damped)
    }
}

impl<S: Simd, W: Watch, const GUARDED: bool> Engine<'_, S, W, GUARDED> {
    /// Moves the scanning lanes on, for a while or until each stands before a window in which something
    /// may happen or at the end of its job; the latter ones.
    #[inline(always)]
    pub fn scan(&mut self, law: &Law<S>) -> Mask<S> {
        let mut state = self.state;
        let zero = state.x.like(0.0);
        let (px, pv) = law.particular(state.drive.cos, state.drive.sin);
        let (mut y, mut u) = (state.x - px, state.v - pv);
        let mut go = state.scanning;
        for _ in 0..MOST_WINDOWS {
            if !go.any() {
                break;
            }
            let (cos, sin) = (state.drive.cos, state.drive.sin);
            let next_cos = cos * law.turn_cos - sin * law.turn_sin;
            let next_sin = sin * law.turn_cos + cos * law.turn_sin;
            let next_y = law.xx.mul_add(y, law.xv * u);
            let next_u = law.vx.mul_add(y, law.vv * u);
            let (px, pv) = law.particular(next_cos, next_sin);
            let (x, v) = (px + next_y, pv + next_u);
            let slack = law.slack(y, u);
            let hull = Hull::of((state.x, state.v), (x, v), law.third, slack);
            let mut clear = hull.high.below(law.high) & law.low.below(hull.low);
            if GUARDED {
                let amplitude = state.drive.amplitude;
                let here = law.acceleration(state.x, state.v, amplitude * cos);
                let there = law.acceleration(x, v, amplitude * next_cos);
                let rates = Hull::of((state.v, here), (v, there), law.third, law.rate_slack(y, u));
                clear = clear & law.guard_top(&hull, &rates).below(law.level);
            }
            let step = go & clear;
            state.x = step.choose(x, state.x);
            state.v = step.choose(v, state.v);
            state.drive.cos = step.choose(next_cos, cos);
            state.drive.sin = step.choose(next_sin, sin);
            y = step.choose(next_y, y);
            u = step.choose(next_u, u);
            state.node = step.choose(state.node + zero.like(1.0), state.node);
            let ends = state.arrive(step, law);
            if W::PERIODS && ends.any() {
                self.state = state;
                self.tell_periods(ends);
            }
            go = step & zero.below(state.left);
        }
        let ended = state.scanning & state.left.at_most(zero);
        let stopped = state.scanning.and_not(ended | go);
        state.node = stopped.choose(state.node + zero.like(1.0), state.node);
        state.toward = stopped.choose(law.window, state.toward);
        state.span = stopped.choose(law.window, state.span);
        state.pending = state.pending | stopped;
        state.scanning = go;
        self.state = state;
        ended
    }

    /// Tells the watcher of lanes that have begun a period.
    pub fn tell_periods(&mut self, lanes: Mask<S>) {
        for lane in 0..Lanes::<S>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.progress(lane)
            {
                let state = self.state.state(lane);
                self.task.watch.period(job, cycle, state);
            }
        }
    }
}

impl<S: Simd> Law<S> {
    /// Largest value of the further guard's weighted sum within the hulls of position and velocity.
    #[inline(always)]
    pub fn guard_top(&self, positions: &Hull<S>, velocities: &Hull<S>) -> Lanes<S> {
        let (a, b) = (self.by_position, self.by_velocity);
        let x = (a * positions.low).max(a * positions.high);
        x + (b * velocities.low).max(b * velocities.high)
    }
}
