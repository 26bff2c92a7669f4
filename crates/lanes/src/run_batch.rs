//! A batch on this thread, or on all.

use std::ops::{ControlFlow, Range};

use rayon::prelude::*;

use super::batch_observer::{BatchObserver, ObserverHandle};
use super::instruction_set::{self, InstructionLimit};
use super::job::{Job, Outcome};
use super::lowered_machine::LoweredMachine;
use softstop::Start;

/// Number of jobs that one thread follows as a batch: enough for all lanes to be busy nearly to its end. The lanes of a batch
/// share their rounding, so its size does not depend on the number of threads.
const JOBS_PER_BATCH: usize = 128;

/// Follows the motions of all jobs on this thread with the widest instruction set.
///
/// # Panics
/// If a job names a machine that is not there.
pub fn run(
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: &mut impl BatchObserver,
) -> Vec<Outcome> {
    run_with(InstructionLimit::Widest, machines, jobs, watch)
}

/// Follows the motions of all jobs on this thread with the instruction set chosen.
pub fn run_with(
    instructions: InstructionLimit,
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: &mut impl BatchObserver,
) -> Vec<Outcome> {
    instruction_set::run_jobs(machines, jobs, ObserverHandle::new(watch), instructions)
}

/// Follows the motions of all jobs on this thread, one after another, each alone in one register of at most 256 bits: what a
/// motion costs without others beside it.
///
/// # Panics
/// If a job names a machine that is not there.
pub fn run_one_by_one(
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: &mut impl BatchObserver,
) -> Vec<Outcome> {
    instruction_set::run_one_by_one(machines, jobs, watch)
}

/// Follows the motions of all jobs in batches on the threads of rayon's pool, with the same result for any number of threads.
/// Each batch has an observer of its own, which `watch` makes for the range of its jobs; outcomes and observers come back in
/// order. Observers are told of jobs by their index in `jobs`.
///
/// # Panics
/// If a job names a machine that is not there.
pub fn run_parallel<W: BatchObserver + Send>(
    instructions: InstructionLimit,
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: impl Fn(Range<usize>) -> W + Sync,
) -> (Vec<Outcome>, Vec<W>) {
    let parts: Vec<(Vec<Outcome>, W)> = jobs
        .par_chunks(JOBS_PER_BATCH)
        .enumerate()
        .map(|(part, jobs)| {
            let first = part * JOBS_PER_BATCH;
            let mut numbered = RenumberedObserver {
                first,
                watch: watch(first..first + jobs.len()),
            };
            let outcomes = run_with(instructions, machines, jobs, &mut numbered);
            (outcomes, numbered.watch)
        })
        .collect();
    let (outcomes, watches): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    (outcomes.concat(), watches)
}

/// Passes what happens to a batch on to its observer, with the index of a job among all jobs for that in the batch.
struct RenumberedObserver<W> {
    first: usize,
    watch: W,
}

impl<W: BatchObserver> BatchObserver for RenumberedObserver<W> {
    const IMPACTS: bool = W::IMPACTS;
    const PERIODS: bool = W::PERIODS;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, velocity: f64) {
        self.watch.impact(self.first + job, cycle, offset, velocity);
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        self.watch.period(self.first + job, cycle, state);
    }

    fn goes_on(&mut self) -> ControlFlow<()> {
        self.watch.goes_on()
    }
}
