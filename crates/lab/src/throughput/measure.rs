//! How fast the engines are: all of them by turns, over and over, and the median of each.

use std::time::Instant;

use anyhow::Context;
use rayon::{ThreadPool, ThreadPoolBuilder};
use softstop::MotionError;
use softstop_lanes::Instructions;

use super::fleet::{Count, Fleet};
use softstop_console::failure::Failure;
use softstop_console::median::median;
use softstop_console::progress::Progress;

/// One way through the motions, with its times.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Timing {
    /// Seconds of each round, sorted.
    pub seconds: Vec<f64>,
    /// What it found.
    pub count: Count,
}

/// How often all cores together run the motions in one measurement: threads end together but for a
/// part of the jobs, which would weigh much in a short one.
pub const ROUNDS: usize = 16;

impl Timing {
    /// The middle one of the times, in s.
    pub fn median(&self) -> f64 {
        median(self.seconds.clone())
    }
}

/// The instruction sets narrower than the widest that this processor has.
pub fn narrower() -> Vec<Instructions> {
    let widest = Instructions::Widest.registers();
    let portable = Instructions::Portable.registers();
    let mut sets = vec![Instructions::Avx2, Instructions::Portable];
    sets.retain(|set| set.registers() != widest);
    sets.retain(|set| *set == Instructions::Portable || set.registers() != portable);
    sets
}

/// Measurements that [`measure`] makes in so many repeats, and that of the zones.
pub fn measurements(sets: &[Instructions], repeats: usize) -> u64 {
    ((repeats + 1) * (sets.len() + 7)) as u64
}

/// So many threads; 0 for all cores.
///
/// # Errors
/// [`Failure::Run`] if there are none to be had.
pub fn pool(threads: usize) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.context("no threads to be had")?)
}

/// Measures so many rounds after one that is not counted: the safe engine, one lane, all lanes, all lanes with each impact
/// told, all cores and one of them, each [`ROUNDS`] times over, lanes with the narrower sets. Gives the number of threads of all cores, too.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn measure(
    fleet: &Fleet,
    sets: &[Instructions],
    repeats: usize,
    progress: &Progress,
) -> Result<(Vec<Timing>, usize), Failure> {
    let (all, one) = (pool(0)?, pool(1)?);
    type Way<'a> = Box<dyn Fn() -> Result<Count, MotionError> + 'a>;
    let lanes = |set| -> Way<'_> { Box::new(move || fleet.batch(set)) };
    let mut ways: Vec<Way<'_>> = vec![
        Box::new(|| fleet.safe()),
        Box::new(|| fleet.one_by_one()),
        lanes(Instructions::Widest),
        Box::new(|| fleet.each_impact(Instructions::Widest)),
        Box::new(|| all.install(|| fleet.parallel(ROUNDS))),
        Box::new(|| one.install(|| fleet.parallel(ROUNDS))),
    ];
    ways.extend(sets.iter().map(|set| lanes(*set)));
    let mut timings = vec![Timing::default(); ways.len()];
    for round in 0..=repeats {
        for (way, timing) in ways.iter().zip(&mut timings) {
            let begin = Instant::now();
            timing.count = way().context("a motion of the measurement")?;
            if round > 0 {
                timing.seconds.push(begin.elapsed().as_secs_f64());
            }
            progress.step()?;
        }
    }
    for timing in &mut timings {
        timing.seconds.sort_by(f64::total_cmp);
    }
    Ok((timings, all.current_num_threads()))
}
