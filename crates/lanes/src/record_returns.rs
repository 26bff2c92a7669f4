//! Records the returns of the lanes to their impacts and does what [`ReturnHistory`](super::return_history::ReturnHistory) decides:
//! follow a trial cycle, go back, or skip periods that repeat.

use nalgebra::Complex;
use pulp::Simd;

use super::cycle_state::{Forcing, GuardCrossing};
use super::engine::Engine;
use super::lanes::{Lanes, Mask};
use super::return_history::ReturnDecision;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Begins to record the returns of a lane to an impact for a new job, unless an observer watches what would be skipped.
    pub fn begin_recording(&mut self, lane: usize) {
        let (per_period, left) = (
            self.state.drive.per_period.get(lane),
            self.state.left.get(lane),
        );
        let record_from = self.returns[lane].begin_job(per_period, left);
        if !self.task.watch.impacts && !self.task.watch.periods {
            self.state.record_from.set(lane, record_from);
        }
    }

    /// Records crossings of any surface by lanes that follow a trial cycle; `before`: their velocities before.
    #[cold]
    #[inline(never)]
    pub fn record_trial_crossings(&mut self, crossed: Mask<S, N>, before: Lanes<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if crossed.get(lane) && self.returns[lane].is_trial() {
                self.returns[lane].crossings.push(GuardCrossing {
                    position: self.state.x.get(lane),
                    velocity: before.get(lane),
                    velocity_after: self.state.v.get(lane),
                    phase: self.state.phase.get(lane) as usize,
                    left: self.state.left.get(lane),
                    offset: self.state.offset.get(lane),
                });
            }
        }
    }

    /// Records the returns of lanes that have just made an impact, and does what is decided after them.
    #[cold]
    #[inline(never)]
    pub fn record_returns(&mut self, lanes: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if lanes.get(lane)
                && let Some(machine) = self.machine_of(lane)
            {
                let now = self.state.post_impact_state(lane);
                let drive = Forcing {
                    frequency: machine.scene().excitation.frequency,
                    period: machine.scene().period(),
                    begin: Complex::new(machine.angle.0, machine.angle.1),
                };
                let laws = machine.laws.as_deref().unwrap_or_default();
                if let Some(decision) = self.returns[lane].record(now, laws, &drive) {
                    self.apply_decision(lane, decision);
                }
            }
        }
    }

    /// Takes lanes back from trial cycles that do not come back to their impact.
    pub fn end_overdue_trials(&mut self) {
        for lane in 0..Lanes::<S, N>::COUNT {
            if self.returns[lane].is_trial_overdue(self.state.left.get(lane)) {
                self.end_trial(lane);
            }
        }
    }

    /// Takes a lane back from its trial cycle to the last recorded return of its own motion; false if it follows none.
    pub fn end_trial(&mut self, lane: usize) -> bool {
        let back = self.returns[lane].end_trial();
        back.map(|decision| self.apply_decision(lane, decision))
            .is_some()
    }

    /// Does what was decided after a return: sets where the lane goes on, and when its returns are recorded again.
    fn apply_decision(&mut self, lane: usize, decision: ReturnDecision) {
        self.state.record_from.set(lane, decision.record_again_at);
        self.count_skipped(lane, decision.extrapolated_periods);
        if let Some(to) = decision.resume_at {
            self.state.set_post_impact_state(lane, to);
        }
        self.trials = self
            .returns
            .iter()
            .filter(|returns| returns.is_trial())
            .count();
    }
}
