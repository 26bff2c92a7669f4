//! Bifurcation diagrams: the sweeps behind the figures, and what they show of a step.

use anyhow::{Error, Result};
use rayon::prelude::*;
use softstop::Scene;
use softstop_dynamics::watch::Kept;
use softstop_dynamics::{Chain, Direction, Plan, Regime, Step};

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

/// Carries all chains of all plans to their ends; what is known of them is recalled.
pub(super) fn sweep(mut jobs: Vec<Job>, what: &str, kept: Kept<'_>) -> Result<Vec<Chain>> {
    let steps = jobs.iter().map(|(plan, chains)| plan.steps * chains.len());
    let progress = Progress::new(steps.sum::<usize>() as u64, what);
    let finished = jobs
        .par_iter_mut()
        .map(|(plan, chains)| plan.run_kept(chains, &progress.watcher(), kept));
    if !finished.collect::<Vec<bool>>().into_iter().all(|it| it) {
        return Err(Failure::Interrupted.into());
    }
    let chains: Vec<Chain> = jobs.into_iter().flat_map(|job| job.1).collect();
    let error = chains.iter().find_map(|chain| chain.error.clone());
    error.map_or(Ok(chains), |error| Err(Error::msg(error)))
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

/// The steps of some sweeps.
pub(super) fn steps(chains: &[Chain]) -> impl Iterator<Item = &Step> + Clone {
    chains.iter().flat_map(|chain| &chain.steps)
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

/// The columns of [`fields`].
pub(super) const FIELDS: &str = "z,max_position,before_impact_velocities";

/// The motion, p/n or in a word, its largest position and its before-impact velocities.
pub(super) fn fields(step: &Step) -> [String; 3] {
    let motion = step.motion.to_string();
    let velocities = step.velocities.iter().map(|it| format!("{it:.6}"));
    [
        motion.trim_start_matches("z = ").to_owned(),
        format!("{:.6}", step.max_position),
        velocities.collect::<Vec<String>>().join(" "),
    ]
}
