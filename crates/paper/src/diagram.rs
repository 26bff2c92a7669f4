//! Sweeps for the figures, and their tables.

use anyhow::Result;
use rayon::prelude::*;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::sweep::{Chain, Direction, Plan, Step};

use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// Sweeps that go together: a plan and its chains.
pub(super) type Job = (Plan, Vec<Chain>);

/// Carries all chains of all plans to their ends.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub(super) fn sweep(jobs: &mut [Job], what: &str) -> Result<()> {
    let steps = jobs.iter().map(|(plan, chains)| plan.steps * chains.len());
    let progress = Progress::new(steps.sum::<usize>() as u64, what);
    let finished = jobs
        .par_iter_mut()
        .map(|(plan, chains)| plan.run(chains, &progress.watcher()));
    if !finished.collect::<Vec<bool>>().into_iter().all(|it| it) {
        return Err(Failure::Interrupted.into());
    }
    let mut errors = jobs
        .iter()
        .flat_map(|job| &job.1)
        .filter_map(|chain| chain.error.clone());
    match errors.next() {
        Some(error) => Err(error.into()),
        None => Ok(()),
    }
}

/// The plan of one way over a part of a sweep's range, going on from where that is when it comes there.
pub(super) fn part_of(sweep: &Chain, plan: &Plan) -> Plan {
    let rising = sweep.rising();
    let before = match sweep.direction {
        Direction::Up => rising.iter().rfind(|step| step.value <= plan.range.0),
        Direction::Down => rising.iter().find(|step| step.value >= plan.range.1),
    };
    Plan {
        start: before.map_or(plan.start, |step| step.end),
        ..*plan
    }
}

/// A motion in a field: p/n, or in a word.
pub(super) fn name(motion: &MotionKind) -> String {
    motion.to_string().trim_start_matches("z = ").to_owned()
}

/// Before-impact velocities in a field.
pub(super) fn velocities(step: &Step) -> String {
    let written: Vec<String> = step
        .velocities
        .iter()
        .map(|it| format!("{it:.6}"))
        .collect();
    written.join(" ")
}
