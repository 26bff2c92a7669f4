//! Bifurcation diagrams: the sweeps behind the figures, and what they show of a step.

use anyhow::{Error, Result};
use rayon::prelude::*;
use serde::Deserialize;
use softstop::{Parameter, Scene};
use softstop_dynamics::monitor::OptionalMemory;
use softstop_dynamics::{Chain, Direction, MotionKind, Orbit, Plan, Regime, SweepStep};

use crate::figure::Detail;
use softstop_console::column::{Unit, column};
use softstop_console::columns;
use softstop_console::export::csv;
use softstop_console::failure::Failure;
use softstop_console::progress::Progress;
use softstop_draw::style;

/// A part of the diagram.
#[derive(Deserialize)]
pub(super) struct Part {
    /// Its letter, if it has one.
    #[serde(default)]
    pub(super) name: String,
    /// Range of eta.
    pub(super) range: (f64, f64),
    /// Number of frequencies, and drive periods at each, for print and for a first look.
    sizes: [(usize, u64); 2],
}

impl Part {
    pub(super) fn size(&self, detail: Detail) -> (usize, u64) {
        detail.pick(self.sizes[0], self.sizes[1])
    }

    pub(super) fn plan(&self, detail: Detail) -> Result<Plan> {
        let (steps, periods) = self.size(detail);
        Ok(Plan::new(Parameter::Frequency, self.range, steps, periods)?)
    }
}

/// Sweeps that go together: a plan and its chains.
pub(super) type Job = (Plan, Vec<Chain>);

/// Difference of velocities, as a share, of motions that are not the same.
pub(super) const APART: f64 = 0.01;

/// The sweeps up and down.
pub(super) fn ways(scene: &Scene) -> [Chain; 2] {
    [Direction::Up, Direction::Down].map(|way| Chain::new(scene.clone(), way))
}

/// Carries all chains of all plans to their ends; what is known of them is recalled.
pub(super) fn sweep(
    mut jobs: Vec<Job>,
    what: &str,
    kept: OptionalMemory<'_>,
) -> Result<Vec<Chain>> {
    let steps = jobs.iter().map(|(plan, chains)| plan.steps * chains.len());
    let progress = Progress::new(steps.sum::<usize>() as u64, what);
    let finished = jobs
        .par_iter_mut()
        .map(|(plan, chains)| plan.run_chains_with_memory(chains, &progress.watcher(), kept));
    if !finished.collect::<Vec<bool>>().into_iter().all(|it| it) {
        return Err(Failure::Interrupted.into());
    }
    let chains: Vec<Chain> = jobs.into_iter().flat_map(|job| job.1).collect();
    let error = chains.iter().find_map(|chain| chain.error.clone());
    error.map_or(Ok(chains), |error| Err(Error::msg(error)))
}

/// One way over a part of a sweep's range, going on from where that is when it comes there.
pub(super) fn part_of(sweep: &Chain, plan: &Plan) -> Job {
    let rising = sweep.rising_steps();
    let before = match sweep.direction {
        Direction::Up => rising.iter().rfind(|step| step.value <= plan.range.0),
        Direction::Down => rising.iter().find(|step| step.value >= plan.range.1),
    };
    let start = before.map_or(plan.start, |step| step.end);
    let chain = Chain::new(sweep.machine.clone(), sweep.direction);
    (Plan { start, ..*plan }, vec![chain])
}

/// The steps of some sweeps.
pub(super) fn steps(chains: &[Chain]) -> impl Iterator<Item = &SweepStep> + Clone {
    chains.iter().flat_map(|chain| &chain.steps)
}

/// True if both steps show the same motion, or both one that does not repeat.
pub(super) fn same(a: &SweepStep, b: &SweepStep) -> bool {
    let (regime, one, other) = (a.motion.regime(), a.hardest_impact(), b.hardest_impact());
    regime == b.motion.regime()
        && (regime.is_none() || (one - other).abs() <= APART * one.max(other))
}

/// The motion of a step with the order of its impacts as Newton's method has it, where that tells its name or colour.
pub(super) fn motion(scene: &Scene, step: &SweepStep) -> MotionKind {
    let seen = || step.motion.clone();
    match step.motion.regime() {
        Some(regime) if regime.periods >= 4 && 2 * regime.impacts == regime.periods => {
            let scene = scene.at_frequency(step.value);
            let orbit = Orbit::find_periodic(&scene, step.end.into(), regime.periods).ok();
            let orbit = orbit.filter(|orbit| orbit.regime() == regime);
            orbit.map_or_else(seen, |orbit| MotionKind::of(&orbit))
        }
        _ => seen(),
    }
}

/// The before-impact velocities over the parameter; 0 for a motion without impacts.
pub(super) fn dots(step: &SweepStep) -> Vec<(f64, f64)> {
    let rest = step.velocities.is_empty().then_some(0.0);
    let velocities = step.velocities.iter().copied().chain(rest);
    velocities.map(|velocity| (step.value, velocity)).collect()
}

/// True if the motion is z = 1.
pub(super) fn is_one(step: &SweepStep) -> bool {
    step.motion.regime() == Some(Regime::ONE)
}

/// A step of a sweep.
struct StepRow<'a> {
    /// The sweep's name.
    sweep: String,
    direction: &'a str,
    step: &'a SweepStep,
}

/// A row for each step of some sweeps, of which the first column tells this.
pub(super) fn table<'a>(
    name: &'static str,
    sweeps: impl IntoIterator<Item = (String, &'a str, &'a [SweepStep])>,
) -> Result<Vec<u8>> {
    let mut columns = columns! { StepRow<'a>, it;
        "sweep" [None], "which one" => it.sweep.clone();
        "direction" [None], "of the frequency" => it.direction;
        "eta" [None], "drive frequency" => format!("{:.12}", it.step.value);
        "z" [None], "p/n, or what else the motion is" => it.step.motion.to_string().trim_start_matches("z = ");
        "impacts_per_period" [None], "mean per drive period" => it.step.impacts_per_period;
        "max_position" [None], "largest position" => format!("{:.6}", it.step.max_position);
        "before_impact_velocities" [None], "all of them, rising" => velocities(it.step);
    };
    columns[0] = column(name, Unit::None, "which sweep", |it| {
        it.sweep.clone().into()
    });
    let rows = sweeps.into_iter().flat_map(|(sweep, direction, steps)| {
        let steps = steps.iter();
        steps.map(move |step| StepRow {
            sweep: sweep.clone(),
            direction,
            step,
        })
    });
    Ok(csv(&columns, rows)?)
}

fn velocities(step: &SweepStep) -> String {
    let velocities = step.velocities.iter().map(|it| format!("{it:.6}"));
    velocities.collect::<Vec<String>>().join(" ")
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
    step: impl Fn(&T) -> &SweepStep,
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
