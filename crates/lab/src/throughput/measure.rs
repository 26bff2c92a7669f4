//! How fast the engines are: all of them by turns, over and over, and the median of each.

use std::time::Instant;

use anyhow::{Context, Result};
use rayon::{ThreadPool, ThreadPoolBuilder};
use softstop_lanes::InstructionLimit;

use super::batch::Count;
use softstop_console::failure::Failure;
use softstop_console::median::median;
use softstop_console::progress::Progress;

/// A way through motions or machines, which says what it found.
pub type Way<'a> = Box<dyn Fn() -> Result<Count> + 'a>;

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

    /// So much work over the longest time and over the shortest.
    pub fn spread(&self, work: f64) -> [f64; 2] {
        let rate = |seconds: Option<&f64>| seconds.map_or(f64::NAN, |seconds| work / seconds);
        [rate(self.seconds.last()), rate(self.seconds.first())]
    }
}

/// The instruction sets narrower than the widest that this processor has.
pub fn narrower() -> Vec<InstructionLimit> {
    let widest = InstructionLimit::Widest.registers();
    let portable = InstructionLimit::Portable.registers();
    let mut sets = vec![InstructionLimit::Avx2, InstructionLimit::Portable];
    sets.retain(|set| set.registers() != widest);
    sets.retain(|set| *set == InstructionLimit::Portable || set.registers() != portable);
    sets
}

/// So many threads; 0 for all cores.
///
/// # Errors
/// [`Failure::Run`] if there are none to be had.
pub fn pool(threads: usize) -> Result<ThreadPool, Failure> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.context("no threads to be had")?)
}

/// Measures ways by turns, so many rounds after one that is not counted.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn measure(ways: &[&Way<'_>], repeats: usize) -> Result<Vec<Timing>, Failure> {
    let progress = Progress::new(((repeats + 1) * ways.len()) as u64, "measurements");
    let mut timings = vec![Timing::default(); ways.len()];
    for round in 0..=repeats {
        for (way, timing) in ways.iter().zip(&mut timings) {
            let begin = Instant::now();
            timing.count = way()?;
            if round > 0 {
                timing.seconds.push(begin.elapsed().as_secs_f64());
            }
            progress.step()?;
        }
    }
    for timing in &mut timings {
        timing.seconds.sort_by(f64::total_cmp);
    }
    Ok(timings)
}
