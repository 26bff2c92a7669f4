//! The loop in which all lanes advance in lock-step, and the jobs that it deals to them.
//!
//! What limits it: on Zen 4 a 512-bit operation takes both halves of a pipe pair, and the multiplying pair is busy for some
//! 1,400 of 2,040 cycles a period; latency takes the rest. A decision about a window is one chain of some 400 cycles, which
//! two registers do not fill; three spill more. On Zen 5 three registers leave AVX-512 at 35 million periods a second and
//! lift AVX2 from 20.2 to 21.5, but lower both with a strip, from 17.1 to 13.2 and from 10.3 to 9.6.
//!
//! Tried and dropped, best of six to eight alternating runs on 1,000 frequencies, million periods a second before and after:
//!
//! - a second-order step on the cubic, fewer decisions and more crossings out of reach: 26.7, 25.7;
//! - lanes that wait stay in the scanned state, each window then waits for its mask: 25.9, 21.2 (disturbed);
//! - period ends counted without a loop, one test for windows in doubt: 26.7, 26.7;
//! - the window behind blended instead of computed anew: 25.1, 22.9;
//! - a decision without rounds, by the quintic and four derivatives, half as many instructions again in chaos: 23.5, 22.9;
//! - coefficients at the crossing from tables, 26 multiplications fewer, 180 loads and stores more: 28.6, 28.0;
//! - maxima within the cubic's error of the stop wait for the next decision, lanes no longer go in step: 56, 53.
//!
//! Kept, the largest gains: extrapolation of settled motions (35 to 64), windows that do not wait for the verdict on the one
//! before (64 to 66), windows judged only in the lanes that need it (26.8 to 28.6), series at multiples of 64 bytes (power
//! laws in a third of the time).
//!
//! Not tried: in 7 % of the decisions a maximum lies within the cubic's error of the guard, and a second round follows; a bound
//! on the change of the fourth derivative would leave few. The free part's two series of 15 terms are a third of a
//! decision; a table of 2x2 matrices and 6 terms could replace them, at the price of gathers.

use pulp::Simd;

use super::contact_series::ContactSeries;
use super::job::{Job, Outcome, Task};
use super::lane_laws::Laws;
use super::lane_states::LaneStates;
use super::lanes::{Lanes, Mask};
use super::lowered_machine::LoweredMachine;
use super::phase_order::phase_order;
use super::return_history::ReturnHistory;
use super::safe_engine::{Resumed, SafeStart, start_phase};

/// Number of rounds over all phases after which their work is counted and overdue trial cycles are ended.
const ROUNDS_PER_COUNT: usize = 16;
/// Work of [`ROUNDS_PER_COUNT`] rounds, in scan windows.
const WORK_PER_COUNT: u64 = 1 << 10;
/// Index of the phase without contact; where it has several ends, it lies between two stops.
const FREE_PHASE: usize = 0;

/// The lock-step loop over all lanes: their states, the laws of their machines, and the jobs and outcomes.
pub(super) struct Engine<'a, S: Simd, const N: usize> {
    pub task: Task<'a>,
    pub laws: Vec<Laws<S, N>>,
    /// Phases that several things end in some machine.
    guarded: Vec<bool>,
    /// Phases that have a power law in some machine.
    presses: Vec<bool>,
    /// The phases in the order in which a round visits them.
    order: Vec<usize>,
    pub state: LaneStates<S, N>,
    /// The series of contacts under a power law, where there are any.
    pub power: Option<Box<ContactSeries<S, N>>>,
    /// The returns of each lane to its impacts.
    pub returns: Vec<ReturnHistory>,
    /// Number of lanes that follow a trial cycle.
    pub trials: usize,
    /// Rounds that lanes in contact have waited.
    pub waited: usize,
    /// The job of each lane.
    lanes: Vec<Option<usize>>,
    /// The machine whose laws each lane has.
    installed: Vec<Option<usize>>,
    /// The next job to begin.
    next: usize,
    pub outcomes: Vec<Outcome>,
}

impl<'a, S: Simd, const N: usize> Engine<'a, S, N> {
    #[inline(always)]
    pub fn new(simd: S, task: Task<'a>) -> Self {
        // Of the machines that have jobs: there may be many more.
        let alike = task.jobs.chunk_by(|one, next| one.machine == next.machine);
        let machines = alike.filter_map(|jobs| task.machines[jobs[0].machine].laws.as_deref());
        let most = machines.clone().map(<[_]>::len).max().unwrap_or(1);
        let (mut guarded, mut presses) = (vec![false; most], vec![false; most]);
        for (phase, law) in machines.clone().flat_map(|laws| laws.iter().enumerate()) {
            guarded[phase] |= !law.has_one_end();
            presses[phase] |= law.has_power_law();
        }
        let is_any = presses.contains(&true);
        let outcomes = task.jobs.iter().map(|job| Outcome {
            end: job.start,
            impacts: 0,
            crossings: 0,
            handed_over: 0,
            leapt: 0,
            error: None,
        });
        let returns = (0..Lanes::<S, N>::COUNT).map(|_| ReturnHistory::default());
        Self {
            laws: vec![Laws::new(simd); most],
            guarded,
            presses,
            order: phase_order(machines, most),
            state: LaneStates::idle(simd),
            power: is_any.then(|| Box::new(ContactSeries::new(simd))),
            returns: returns.collect(),
            trials: 0,
            waited: 0,
            lanes: vec![None; Lanes::<S, N>::COUNT],
            installed: vec![None; Lanes::<S, N>::COUNT],
            next: 0,
            outcomes: outcomes.collect(),
            task,
        }
    }

    #[inline(always)]
    pub fn run_jobs(mut self) -> Vec<Outcome> {
        for lane in 0..Lanes::<S, N>::COUNT.min(self.task.at_once) {
            self.take_next(lane);
        }
        let mut steps = 0;
        while self.lanes.iter().any(Option::is_some) {
            for at in 0..self.order.len() {
                let phase = self.order[at];
                let here = self.state.phase.equals(self.state.phase.like(phase as f64));
                let mut active = self.state.busy_lanes() & here;
                if self.presses[phase] {
                    active = self.advance_contacts(phase, active);
                }
                if self.guarded[phase] {
                    let guarded = active
                        & self.laws[phase]
                            .guarded
                            .like(0.0)
                            .below(self.laws[phase].guarded);
                    if guarded.any() {
                        self.step_phase::<true>(phase, guarded);
                    }
                    active = active.and_not(guarded);
                }
                if active.any() {
                    self.step_phase::<false>(phase, active);
                }
            }
            steps += 1;
            if steps % ROUNDS_PER_COUNT == 0 {
                self.end_overdue_trials();
                if self.task.watch.count_work(WORK_PER_COUNT).is_break() {
                    break;
                }
            }
        }
        self.outcomes
    }

    /// Gives lanes whose job has `ended` the next job, and hands `doubtful` ones to the safe engine.
    pub fn serve_lanes(&mut self, ended: Mask<S, N>, doubtful: Mask<S, N>) {
        for lane in 0..Lanes::<S, N>::COUNT {
            let (ended, doubtful) = (ended.get(lane), doubtful.get(lane));
            if !(ended || doubtful) || self.end_trial(lane) {
                continue;
            }
            if doubtful {
                self.hand_over(lane);
            } else {
                self.finish_job(lane);
            }
        }
    }

    /// Time in s for which each lane may move on: to the end of its job or, if periods are observed, of the drive period.
    #[inline(always)]
    pub fn time_to_stop(&self) -> Lanes<S, N> {
        let LaneStates {
            left,
            offset,
            drive,
            ..
        } = self.state;
        let periods = if self.task.watch.periods {
            left.like(1.0)
        } else {
            left
        };
        periods.mul_add(drive.period, -offset)
    }

    /// Moves the lanes that are in a phase to its end, or as far as they come in a few windows. `HAS_OTHER_ENDS`: the phase may
    /// end at something else than one position.
    #[inline(always)]
    fn step_phase<const HAS_OTHER_ENDS: bool>(&mut self, phase: usize, active: Mask<S, N>) {
        let due = self.time_to_stop();
        let between = HAS_OTHER_ENDS && phase == FREE_PHASE;
        let active = if HAS_OTHER_ENDS && !between {
            self.direct_step(phase, active, due)
        } else {
            active
        };
        if !active.any() {
            return;
        }
        let law = &self.laws[phase];
        let mut reached = if HAS_OTHER_ENDS && !between {
            self.stand_before_window(law, active)
        } else {
            self.scan_windows::<HAS_OTHER_ENDS>(law, active, due * law.per_window)
        };
        if !HAS_OTHER_ENDS || between {
            self.skip_contactless_periods::<HAS_OTHER_ENDS>(phase, active, &mut reached);
        }
        let (ended, doubtful) = self.decide_window::<HAS_OTHER_ENDS>(phase, active, &reached, due);
        if (ended | doubtful).any() {
            self.serve_lanes(ended, doubtful);
        }
    }

    /// The index of a lane's job, and how many of its drive periods are complete.
    pub fn job_progress(&self, lane: usize) -> Option<(usize, u64)> {
        self.job_progress_with(lane, self.state.left.get(lane))
    }

    /// The index of a lane's job, and how many of its drive periods are complete when `left` of them are left.
    pub fn job_progress_with(&self, lane: usize, left: f64) -> Option<(usize, u64)> {
        let job = self.lanes[lane]?;
        Some((job, self.task.jobs[job].periods - left as u64))
    }

    /// Puts the next job that can be followed into a lane, or leaves the lane idle.
    pub fn take_next(&mut self, lane: usize) {
        self.lanes[lane] = None;
        self.state.left.set(lane, 0.0);
        while self.next < self.task.jobs.len() && self.task.watch.count_work(0).is_continue() {
            let job = self.next;
            self.next += 1;
            let Job { machine, start, .. } = self.task.jobs[job];
            let place = SafeStart {
                job,
                cycle: 0,
                offset: 0.0,
                state: start,
                phase: None,
            };
            if self.task.jobs[job].periods == 0 {
                continue;
            }
            let begun = start_phase(&self.task.machines[machine], start);
            let resumed = match begun {
                Ok(Some(phase)) => Some(Resumed {
                    cycle: 0,
                    state: start,
                    phase,
                }),
                Ok(None) => self.follow_job_safely(place),
                Err(error) => {
                    self.outcomes[job].error = Some(error);
                    None
                }
            };
            if let Some(resumed) = resumed {
                self.install_laws(lane, job);
                self.resume_job(lane, job, &resumed);
                return;
            }
        }
    }

    /// The machine of a lane's job.
    pub fn machine_of(&self, lane: usize) -> Option<&'a LoweredMachine> {
        self.installed[lane].map(|index| &self.task.machines[index])
    }

    /// Gives a lane the laws and the drive of a job's machine.
    fn install_laws(&mut self, lane: usize, job: usize) {
        let index = self.task.jobs[job].machine;
        self.lanes[lane] = Some(job);
        if self.installed[lane].replace(index) == Some(index) {
            return;
        }
        let machine = &self.task.machines[index];
        for (law, constants) in self.laws.iter_mut().zip(machine.laws.iter().flatten()) {
            if constants.has_one_end() {
                law.set(lane, constants);
            } else {
                law.set(lane, &constants.in_absolute_position());
            }
        }
        self.state.set_drive(lane, machine);
    }

    /// Adds drive periods that a lane skips to the outcome of its job.
    pub fn count_skipped(&mut self, lane: usize, periods: f64) {
        if let Some(job) = self.lanes[lane] {
            self.outcomes[job].leapt += periods as u64;
        }
    }

    fn finish_job(&mut self, lane: usize) {
        if let Some(job) = self.lanes[lane] {
            self.outcomes[job].end = self.state.position_and_velocity(lane);
            self.state.take_counts(lane, &mut self.outcomes[job]);
        }
        self.take_next(lane);
    }
}
