//! What it takes to compute a motion.

use std::time::Instant;

use anyhow::Context;
use softstop::internals::Evaluations;
use softstop::{Clock, MotionError, Scene, Start};

use softstop_console::failure::Failure;
use softstop_console::median::median;
use softstop_console::progress::Progress;

/// What a drive period of a model's settled motion takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    /// Evaluations of the law of force: the same on every machine.
    pub(super) evaluations_per_period: f64,
    /// Median time.
    pub(super) microseconds_per_period: f64,
}

/// The costs of motions, timed turn and turn about, so that what else the machine does meanwhile falls on
/// all of them.
pub(super) fn costs(
    motions: &[(Scene, Start)],
    periods: u64,
    repeats: u64,
) -> Result<Vec<Cost>, Failure> {
    let progress = Progress::new(motions.len() as u64 * repeats, "runs");
    let mut times = vec![Vec::new(); motions.len()];
    let mut evaluations = vec![0; motions.len()];
    for _ in 0..repeats {
        for (index, (scene, start)) in motions.iter().enumerate() {
            let begin = Instant::now();
            let taken = run(scene, *start, periods).context("cannot time a motion")?;
            times[index].push(begin.elapsed().as_secs_f64());
            evaluations[index] = taken.evaluations;
            progress.step()?;
        }
    }
    let per_period = |total: f64| total / periods as f64;
    let cost = |(times, evaluations): (Vec<f64>, u64)| Cost {
        evaluations_per_period: per_period(evaluations as f64),
        microseconds_per_period: 1e6 * per_period(median(times)),
    };
    Ok(times.into_iter().zip(evaluations).map(cost).collect())
}

fn run(scene: &Scene, start: Start, periods: u64) -> Result<Evaluations, MotionError> {
    let mut motion = scene.motion(start)?;
    let mut taken = Evaluations::default();
    motion.advance(Clock::at_cycle(periods), &mut taken)?;
    motion.tell_arc(&mut taken);
    Ok(taken)
}
