//! Bifurcation diagrams: the sweeps behind the figures, and what they show of a step.

use anyhow::{Error, Result};
use rayon::prelude::*;
use softstop::Scene;
use softstop_dynamics::watch::Kept;
use softstop_dynamics::{Chain, Direction, Plan, Regime, Step};

use crate::figure;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;
use softstop_draw::style;

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

/// A row for each step of some sweeps: the name of a sweep, its direction, what a step shows and how it was met.
pub(super) fn table<'a>(
    name: &str,
    sweeps: impl IntoIterator<Item = (String, &'a str, &'a [Step])>,
) -> Result<Vec<u8>> {
    let columns =
        format!("{name},direction,eta,z,impacts_per_period,max_position,before_impact_velocities");
    let rows = sweeps.into_iter().flat_map(|(sweep, direction, steps)| {
        steps.iter().map(move |step| {
            let motion = step.motion.to_string();
            let motion = motion.trim_start_matches("z = ").to_owned();
            let velocities = step.velocities.iter().map(|it| format!("{it:.6}"));
            let velocities = velocities.collect::<Vec<String>>().join(" ");
            let position = format!("{:.6}", step.max_position);
            let eta = format!("{:.12}", step.value);
            let how = (step.impacts_per_period, position, velocities);
            (sweep.clone(), direction, eta, motion, how)
        })
    });
    figure::table(&columns, rows)
}

/// The way on which a motion is seen, and its colour.
pub(super) const WAYS: [(&str, &str); 3] = [
    ("up and down", style::BOTH_WAYS),
    ("up only", style::RISING),
    ("down only", style::FALLING),
];

/// Steps up and down at the same values by the way on which their motions are seen.
pub(super) fn by_way<'a, T>(
    up: &'a [T],
    down: &'a [T],
    step: impl Fn(&T) -> &Step,
) -> [Vec<&'a T>; 3] {
    let mut ways = [const { Vec::new() }; 3];
    for pair in up.iter().zip(down) {
        match same(step(pair.0), step(pair.1)) {
            true => ways[0].extend([pair.0, pair.1]),
            false => {
                ways[1].push(pair.0);
                ways[2].push(pair.1);
            }
        }
    }
    ways
}
