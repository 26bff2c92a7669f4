//! Moves lanes to where a step has brought them, counts what they meet there and tells the observer.

use pulp::Simd;

use super::engine::Engine;
use super::lane_states::LaneStates;
use super::lanes::{Lanes, Mask, Pair};
use softstop::Start;

/// Where a step brings each lane: its state then and, at a crossing, the phase beyond and the number of impacts, 0 or 1.
pub(super) struct LaneEnd<S: Simd, const N: usize> {
    pub x: Lanes<S, N>,
    pub v: Lanes<S, N>,
    pub beyond: Lanes<S, N>,
    pub impact: Lanes<S, N>,
    /// The velocity before the crossing.
    pub before: Lanes<S, N>,
}

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Puts the lanes `moved` into the state at the end of a step that takes `time`, and the lanes `hits` into the phase beyond
    /// the crossing there; counts impacts, crossings and ends of periods. (cos, sin): the drive angle then.
    #[inline(always)]
    pub fn move_lanes(
        &mut self,
        (moved, hits): (Mask<S, N>, Mask<S, N>),
        end: &LaneEnd<S, N>,
        (cos, sin): Pair<S, N>,
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
            state.count_periods();
        }
        if self.trials > 0 {
            self.record_trial_crossings(hits, end.before);
        }
        let impacts = hits & time.like(0.0).below(end.impact);
        if self.task.watch.impacts {
            if impacts.any() {
                self.tell_impacts(impacts, end.before);
            }
        } else {
            let recorded = impacts & self.state.left.at_most(self.state.record_from);
            if recorded.any() {
                self.record_returns(recorded);
            }
        }
    }

    /// Ends the drive period (the job, if periods are not observed) of lanes that `arrived`; returns those with complete jobs.
    #[inline(always)]
    pub fn end_periods(&mut self, arrived: Mask<S, N>) -> Mask<S, N> {
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
            let LaneStates { left, x, v, .. } = self.state;
            self.tell_states(arrived, left, (x, v));
        }
        arrived & self.state.left.at_most(zero)
    }

    /// Tells the observer of impacts that the lanes make at their present times, with their velocities.
    fn tell_impacts(&mut self, lanes: Mask<S, N>, velocity: Lanes<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.job_progress(lane)
            {
                let offset = self.state.offset.get(lane);
                let speed = velocity.get(lane).abs();
                self.task.watch.tell_impact(job, cycle, offset, speed);
            }
        }
    }

    /// Tells the observer that the lanes begin a drive period in the states (x, v), with `left` periods of their jobs left.
    pub fn tell_states(&mut self, lanes: Mask<S, N>, left: Lanes<S, N>, (x, v): Pair<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some((job, cycle)) = self.job_progress_with(lane, left.get(lane))
            {
                let state = Start::new(x.get(lane), v.get(lane));
                self.task.watch.tell_period(job, cycle, state);
            }
        }
    }
}
