//! A close look at what lies ahead of a lane: nothing, a crossing, or a matter for the safe engine.

use pulp::Simd;

use super::engine::Engine;
use super::guard::{Ahead, Found, Guard};
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::Parts;
use super::scan::Reached;

/// Shortest stretch, in windows, that is looked at.
const LEAST: f64 = 1e-12;
/// Share of a window that is looked at last before the safe engine decides.
const SHORTEST: f64 = 1.0 / 256.0;

impl<S: Simd, const GUARDED: bool, const N: usize> Engine<'_, S, GUARDED, N> {
    /// Looks at what lies ahead of the lanes that the scan has stopped, and moves all on; those that came to
    /// the end of their job, and those that the safe engine has to take. `due`: time to where each has to
    /// stop.
    #[inline(always)]
    pub fn look(
        &mut self,
        law: &Law<S, N>,
        reached: &Reached<S, N>,
        due: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let pending = self.state.busy().and_not(reached.go);
        let scanned = reached.count * law.window;
        let remaining = due - scanned;
        let least = law.window * due.like(LEAST);
        let span = (self.state.share * law.window).min(remaining).max(least);
        let ahead = Ahead::of::<GUARDED>(law, &self.state, &reached.parts, span);
        let guard = Guard::of::<GUARDED>(law, &reached.parts, &ahead);
        let found = guard.search::<GUARDED>(&ahead, pending);
        self.place(law, reached);
        let (hits, doubtful) = self.move_on(law, &ahead, &guard, &found, scanned);
        let arrived = found.clear & remaining.at_most(span);
        self.state.share = self.shares(pending, hits | found.clear);
        let doubtful = doubtful | self.state.share.below(due.like(SHORTEST));
        (self.arrive(arrived), doubtful)
    }

    /// Puts the lanes that have moved where the scan has brought them.
    #[inline(always)]
    fn place(&mut self, law: &Law<S, N>, reached: &Reached<S, N>) {
        let Parts { y, u, p, q } = reached.parts;
        let state = &mut self.state;
        let moved = y.like(0.0).below(reached.count);
        state.x = moved.choose(law.side.mul_add(y + p, law.offset), state.x);
        state.v = moved.choose(law.side * (u + q), state.v);
    }

    /// Moves the lanes that meet nothing to the end of their stretch, and those that cross to the crossing; the
    /// latter, and those that the safe engine has to take.
    #[inline(always)]
    fn move_on(
        &mut self,
        law: &Law<S, N>,
        ahead: &Ahead<S, N>,
        guard: &Guard<S, N>,
        found: &Found<S, N>,
        scanned: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let zero = scanned.like(0.0);
        let (x, v, rate) = guard.crossing::<GUARDED>(law, ahead, found);
        let hits = found.hits & guard.slow.below(rate);
        let moves = hits | found.clear;
        let is_high = guard.is_low.not().and_not(guard.is_further);
        let at_high = hits & is_high;
        let at_low = hits & guard.is_low;
        let at_further = hits & guard.is_further;
        let state = &mut self.state;
        let x = at_high.choose(law.high, at_low.choose(law.low, x));
        let turned = if GUARDED {
            let turns = at_further & law.by_position.equals(zero);
            turns.choose(zero, v)
        } else {
            v
        };
        state.x = moves.choose(x, state.x);
        state.v = moves.choose(at_high.choose(v * law.bounce, turned), state.v);
        let time = hits.choose(found.time, ahead.span);
        state.pass(scanned + moves.choose(time, zero), !self.task.watch.periods);
        state.impacts = at_high.choose(state.impacts + law.impact, state.impacts);
        let beyond = at_high.choose(law.beyond_high, law.beyond_low);
        let beyond = at_further.choose(law.beyond_guard, beyond);
        state.phase = hits.choose(beyond, state.phase);
        if self.task.watch.impacts {
            self.tell_impacts(at_high & zero.below(law.impact), v);
        }
        (hits, found.doubtful | found.hits.and_not(hits))
    }

    /// Shares of a window that are looked at next: half of that which could not be decided.
    #[inline(always)]
    fn shares(&self, pending: Mask<S, N>, moves: Mask<S, N>) -> Lanes<S, N> {
        let share = self.state.share;
        let one = share.like(1.0);
        let halved = share * share.like(0.5);
        pending.and_not(moves).choose(halved, one)
    }

    /// Lets the lanes that have come to the end of a period or their job begin the next one; those that have
    /// none left.
    #[inline(always)]
    fn arrive(&mut self, arrived: Mask<S, N>) -> Mask<S, N> {
        if !arrived.any() {
            return arrived;
        }
        let periods = self.task.watch.periods;
        let state = &mut self.state;
        let zero = state.left.like(0.0);
        let left = if periods {
            state.left - zero.like(1.0)
        } else {
            zero
        };
        state.left = arrived.choose(left, state.left);
        state.offset = arrived.choose(zero, state.offset);
        if periods {
            self.tell_periods(arrived);
        }
        arrived & self.state.left.at_most(zero)
    }

    /// Tells the watcher of impacts, now.
    fn tell_impacts(&mut self, lanes: Mask<S, N>, velocity: Lanes<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.progress(lane)
            {
                let offset = self.state.offset.get(lane);
                self.task
                    .watch
                    .impact(job, cycle, offset, velocity.get(lane));
            }
        }
    }

    /// Tells the watcher of lanes that have begun a period.
    fn tell_periods(&mut self, lanes: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.progress(lane)
            {
                let state = self.state.state(lane);
                self.task.watch.period(job, cycle, state);
            }
        }
    }
}
