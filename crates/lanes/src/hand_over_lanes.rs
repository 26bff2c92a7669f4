//! Hands the jobs of lanes over to the safe engine, and lets lanes go on with them where it has left them.

use pulp::Simd;

use super::engine::Engine;
use super::job::Job;
use super::safe_engine::{Resumed, SafeStart, follow_safely};
use softstop::Start;

impl<S: Simd, const N: usize> Engine<'_, S, N> {
    /// Lets a lane go on with a job in the state in which the safe engine has left it, at the beginning of a drive period.
    pub fn resume_job(&mut self, lane: usize, job: usize, resumed: &Resumed) {
        let periods = self.task.jobs[job].periods;
        self.state.periods.set(lane, periods as f64);
        let left = periods - resumed.cycle;
        self.state
            .begin_period(lane, resumed.state, resumed.phase, left);
        self.begin_recording(lane);
    }

    /// Lets the safe engine follow a job to where it can go on in a lane; none if the job ends before.
    pub fn follow_job_safely(&mut self, place: SafeStart) -> Option<Resumed> {
        let Job {
            machine, periods, ..
        } = self.task.jobs[place.job];
        let outcome = &mut self.outcomes[place.job];
        let machine = &self.task.machines[machine];
        match follow_safely(machine, place, periods, &mut self.task.watch, outcome) {
            Ok(resumed) => resumed,
            Err(error) => {
                outcome.error = Some(error);
                None
            }
        }
    }

    /// Hands the motion of a lane to the safe engine for the rest of the drive period, or until lanes can follow it.
    pub fn hand_over(&mut self, lane: usize) {
        let Some((job, cycle)) = self.job_progress(lane) else {
            return;
        };
        let offset = self.state.offset.get(lane);
        let begun = cycle > 0 || offset > 0.0;
        let place = SafeStart {
            job,
            cycle,
            offset,
            state: if begun {
                self.state_within_phase(lane)
            } else {
                self.state.position_and_velocity(lane)
            },
            phase: begun.then(|| self.state.phase.get(lane) as usize),
        };
        self.state.take_counts(lane, &mut self.outcomes[job]);
        match self.follow_job_safely(place) {
            Some(resumed) => self.resume_job(lane, job, &resumed),
            None => self.take_next(lane),
        }
    }

    /// The state of a lane with the position moved back inside its phase where rounding has put it onto an end of it: there the
    /// safe engine would take the crossing for done.
    fn state_within_phase(&self, lane: usize) -> Start {
        let Start { position, velocity } = self.state.position_and_velocity(lane);
        let law = &self.laws[self.state.phase.get(lane) as usize];
        let position = if velocity > 0.0 {
            position.min(law.high.get(lane).next_down())
        } else if velocity < 0.0 {
            position.max(law.low.get(lane).next_up())
        } else {
            position
        };
        Start { position, velocity }
    }
}
