//! Bifurcation diagrams: the sweeps behind the figures, and what they show of a step.

use anyhow::Result;
use rayon::prelude::*;
use softstop::Scene;
use softstop_dynamics::motion::MotionKind;
use softstop_dynamics::orbit::Regime;
use softstop_dynamics::sweep::{Chain, Direction, Plan, Step};

use softstop_console::failure::Failure;
use softstop_console::progress::Progress;

/// Sweeps that go together: a plan and its chains.
pub(super) type Job = (Plan, Vec<Chain>);

/// Difference of velocities, as a share, of motions that are not the same.
pub(super) const APART: f64 = 0.01;

/// The sweeps up and down.
pub(super) fn ways(scene: &Scene) -> [Chain; 2] {
    [Direction::Up, Direction::Down].map(|way| Chain::new(scene.clone(), way))
}

/// Carries all chains of all plans to their ends.
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
    errors.next().map_or(Ok(()), |error| Err(error.into()))
}

/// One way over a part of a sweep's range, going on from where that is when it comes there.
pub(super) fn part_of(sweep: &Chain, plan: &Plan) -> Job {
    let rising = sweep.rising();
    let before = match sweep.direction {
        Direction::Up => rising.iter().rfind(|step| step.value <= plan.range.0),
        Direction::Down => rising.iter().find(|step| step.value >= plan.range.1),
    };
    let start = before.map_or(plan.start, |step| step.end);
    let chain = Chain::new(sweep.machine.clone(), sweep.direction);
    (Plan { start, ..*plan }, vec![chain])
}

/// True if both steps show the same motion, or both one that does not repeat.
pub(super) fn same(a: &Step, b: &Step) -> bool {
    let (regime, one, other) = (a.motion.regime(), a.hardest(), b.hardest());
    regime == b.motion.regime()
        && (regime.is_none() || (one - other).abs() <= APART * one.max(other))
}

/// The before-impact velocities over the parameter; 0 for a motion without impacts.
pub(super) fn dots(step: &Step) -> Vec<(f64, f64)> {
    let rest = step.velocities.is_empty().then_some(0.0);
    let velocities = step.velocities.iter().copied().chain(rest);
    velocities.map(|velocity| (step.value, velocity)).collect()
}

/// True if the motion is z = 1.
pub(super) fn is_one(step: &Step) -> bool {
    step.motion.regime() == Some(Regime::ONE)
}

/// A motion in a field: p/n, or in a word.
pub(super) fn name(motion: &MotionKind) -> String {
    motion.to_string().trim_start_matches("z = ").to_owned()
}

/// Before-impact velocities in a field.
pub(super) fn velocities(step: &Step) -> String {
    let written = step.velocities.iter().map(|it| format!("{it:.6}"));
    written.collect::<Vec<String>>().join(" ")
}
