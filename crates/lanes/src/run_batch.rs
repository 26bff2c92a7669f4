//! A batch on this thread, or on all.

use std::ops::Range;

use rayon::prelude::*;

use super::batch_observer::{BatchObserver, ObserverHandle};
use super::instruction_set::{self, InstructionLimit};
use super::job::{Job, Outcome, Task};
use super::lowered_machine::LoweredMachine;

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
    watch: &mut dyn BatchObserver,
) -> Vec<Outcome> {
    run_with(InstructionLimit::Widest, machines, jobs, watch)
}

/// Follows the motions of all jobs on this thread with the instruction set chosen.
pub fn run_with(
    instructions: InstructionLimit,
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: &mut dyn BatchObserver,
) -> Vec<Outcome> {
    run_batch(instructions, machines, jobs, ObserverHandle::new(watch, 0))
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
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: impl Fn(Range<usize>) -> W + Sync,
) -> (Vec<Outcome>, Vec<W>) {
    let parts: Vec<(Vec<Outcome>, W)> = jobs
        .par_chunks(JOBS_PER_BATCH)
        .enumerate()
        .map(|(part, jobs)| {
            let first = part * JOBS_PER_BATCH;
            let mut watch = watch(first..first + jobs.len());
            let handle = ObserverHandle::new(&mut watch, first);
            let outcomes = run_batch(InstructionLimit::Widest, machines, jobs, handle);
            (outcomes, watch)
        })
        .collect();
    let (outcomes, watches): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
    (outcomes.concat(), watches)
}

fn run_batch<'a>(
    instructions: InstructionLimit,
    machines: &'a [LoweredMachine],
    jobs: &'a [Job],
    watch: ObserverHandle<'a>,
) -> Vec<Outcome> {
    let task = Task {
        machines,
        jobs,
        watch,
        at_once: usize::MAX,
    };
    instruction_set::run_task(task, instructions)
}
