//! A close look at what lies ahead of a lane: nothing, a crossing, or a matter for the safe engine.

use pulp::Simd;

use super::engine::Engine;
use super::guard::{Ahead, Guard};
use super::lanes::{Lanes, Mask};
use super::law::Law;
use super::parts::Parts;
use super::scan::Reached;
use super::search::Found;
use super::state::State;
use softstop::Start;

/// Shortest stretch, in windows, that is looked at.
const LEAST: f64 = 1e-12;
/// Share of a window that is looked at last before the safe engine decides.
const SHORTEST: f64 = 1.0 / 512.0;

/// Where a lane comes to, and if it crosses there, the phase beyond and the impacts that it makes.
pub(super) struct WindowEnd<S: Simd, const N: usize> {
    pub x: Lanes<S, N>,
    pub v: Lanes<S, N>,
    pub beyond: Lanes<S, N>,
    pub impact: Lanes<S, N>,
    /// The velocity before an impact.
    pub before: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Looks at what lies ahead of the lanes that the scan has stopped, and moves all `active` ones on; those that
    /// came to the end of their job, and those that the safe engine has to take. `due`: time to where each has to
    /// stop.
    #[inline(always)]
    pub fn decide_window<const GUARDED: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        reached: &Reached<S, N>,
        due: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let law = &self.laws[phase];
        let pending = active.and_not(reached.go);
        let scanned = reached.count * law.window;
        let remaining = due - scanned;
        let least = law.window * due.like(LEAST);
        let span = (self.state.share * law.window).min(remaining).max(least);
        let ahead = self.ahead(law, reached, pending, span);
        let guard = Guard::of::<GUARDED>(law, &ahead, reached.error_bound);
        let found = guard.search::<GUARDED>(law, &ahead, pending);
        let (hits, doubtful) = self.move_on::<GUARDED>(phase, active, &guard, &found, scanned);
        let arrived = found.clear & remaining.at_most(span);
        self.state.share = self.shares(active, pending.and_not(hits | found.clear));
        let doubtful = doubtful | self.state.share.below(due.like(SHORTEST));
        (self.arrive(arrived), doubtful)
    }

    /// The next window of all lanes, looked at for a time `span` in the lanes `pending`.
    #[inline(always)]
    fn ahead(
        &self,
        law: &Law<S, N>,
        reached: &Reached<S, N>,
        pending: Mask<S, N>,
        span: Lanes<S, N>,
    ) -> Ahead<S, N> {
        let frequency = self.state.drive.frequency;
        let here = reached.parts;
        let next = reached.next;
        let (mut there, mut scale) = (next, span.like(1.0));
        let part = pending & span.below(law.window);
        if part.any() {
            let at = here.at(law, frequency, &next, part.choose(span, law.window));
            there = Parts::choose(part, &at, &next);
            let share = span * law.per_window;
            let square = share * share;
            scale = part.choose(square * square, scale);
        }
        Ahead {
            frequency,
            here,
            there,
            next,
            span,
            scale,
        }
    }

    /// Moves the active lanes to where they may go or to their crossing; those that cross, and those that the
    /// safe engine has to take.
    #[inline(always)]
    fn move_on<const GUARDED: bool>(
        &mut self,
        phase: usize,
        active: Mask<S, N>,
        guard: &Guard<S, N>,
        found: &Found<S, N>,
        scanned: Lanes<S, N>,
    ) -> (Mask<S, N>, Mask<S, N>) {
        let law = &self.laws[phase];
        let zero = scanned.like(0.0);
        let hits = found.hits & guard.slow.below(found.rate);
        let doubtful = found.doubtful | found.hits.and_not(hits);
        let time = scanned + found.time;
        let moved = active.and_not(doubtful) & zero.below(time);
        let parts = &found.parts;
        let (x, v) = (
            law.side.mul_add(parts.y + parts.p, law.offset),
            law.side * hits.choose(found.velocity, parts.u + parts.q),
        );
        let end = if GUARDED {
            let (is_low, is_further) = (guard.is_low, guard.is_further);
            let (at_face, at_further) = (hits.and_not(is_further), hits & is_further);
            let turns = at_further & law.reverses();
            let turned = turns.choose(zero, v);
            let x = at_further.choose(found.position, x);
            let beyond = is_low.choose(law.beyond_low, law.beyond_high);
            let bounced = v * is_low.choose(law.bounce_low, law.bounce);
            let impact = is_low.choose(law.impact_low, law.impact);
            WindowEnd {
                x: at_face.choose(is_low.choose(law.low, law.high), x),
                v: at_face.choose(bounced, turned),
                beyond: is_further.choose(law.beyond_guard, beyond),
                impact: is_further.choose(zero, impact),
                before: v,
            }
        } else {
            WindowEnd {
                x: hits.choose(law.end, x),
                v: hits.choose(v * law.end_bounce, v),
                beyond: law.beyond_end,
                impact: law.end_impact,
                before: v,
            }
        };
        let (cos, sin) = law.angle(parts);
        self.settle((moved, hits), &end, (cos, sin), time);
        (hits, doubtful)
    }

    /// Puts the lanes `moved` where they have come to after `time`, the lanes `hits` into the phase beyond.
    #[inline(always)]
    pub fn settle(
        &mut self,
        (moved, hits): (Mask<S, N>, Mask<S, N>),
        end: &WindowEnd<S, N>,
        (cos, sin): (Lanes<S, N>, Lanes<S, N>),
        time: Lanes<S, N>,
    ) {
        let state = &mut self.state;
        state.x = moved.choose(end.x, state.x);
        state.v = moved.choose(end.v, state.v);
        state.phase = hits.choose(end.beyond, state.phase);
        state.impacts = hits.choose(state.impacts + end.impact, state.impacts);
        let crossings = state.crossings + time.like(1.0);
        state.crossings = hits.choose(crossings, state.crossings);
        state.angle.0 = moved.choose(cos, state.angle.0);
        state.angle.1 = moved.choose(sin, state.angle.1);
        state.offset = moved.choose(state.offset + time, state.offset);
        if !self.task.watch.periods {
            state.wrap();
        }
        if self.trials > 0 {
            self.note_crossings(hits, end.before);
        }
        let impacts = hits & time.like(0.0).below(end.impact);
        if self.task.watch.impacts {
            if impacts.any() {
                self.tell_impacts(impacts, end.before);
            }
        } else {
            let noted = impacts & self.state.left.at_most(self.state.noted);
            if noted.any() {
                self.note(noted);
            }
        }
    }

    /// Shares of a window that the active lanes look at next: half of that which could not be decided.
    #[inline(always)]
    fn shares(&self, active: Mask<S, N>, undecided: Mask<S, N>) -> Lanes<S, N> {
        let share = self.state.share;
        let halved = share * share.like(0.5);
        undecided.choose(halved, active.choose(share.like(1.0), share))
    }

    /// Lets the lanes that have come to the end of a period or their job begin the next one; those that have
    /// none left.
    #[inline(always)]
    pub fn arrive(&mut self, arrived: Mask<S, N>) -> Mask<S, N> {
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
        state.angle.0 = arrived.choose(state.drive.begin.0, state.angle.0);
        state.angle.1 = arrived.choose(state.drive.begin.1, state.angle.1);
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
                let speed = velocity.get(lane).abs();
                self.task.watch.impact(job, cycle, offset, speed);
            }
        }
    }

    /// Tells the watcher of lanes that have begun a period.
    fn tell_periods(&mut self, lanes: Mask<S, N>) {
        let State { left, x, v, .. } = self.state;
        self.tell_states(lanes, left, (x, v));
    }

    /// Tells the watcher of lanes that are, with so many periods left, at a beginning of one with this state.
    pub fn tell_states(
        &mut self,
        lanes: Mask<S, N>,
        left: Lanes<S, N>,
        (x, v): (Lanes<S, N>, Lanes<S, N>),
    ) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.progress_with(lane, left.get(lane))
            {
                let state = Start::new(x.get(lane), v.get(lane));
                self.task.watch.period(job, cycle, state);
            }
        }
    }
}
