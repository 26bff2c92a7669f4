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
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    /// Seconds of each round, sorted.
    pub seconds: Vec<f64>,
    /// What it found.
    pub count: Count,
}

/// What was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Timings {
    /// The safe engine.
    pub safe: Timing,
    /// One motion after the other, in one lane.
    pub scalar: Timing,
    /// The lanes with the widest instruction set.
    pub batch: Timing,
    /// The same with narrower ones.
    pub narrower: Vec<(Instructions, Timing)>,
    /// The lanes on all cores, [`ROUNDS`] times over.
    pub parallel: Timing,
    /// The same on one core.
    pub alone: Timing,
    /// Threads that they ran on.
    pub threads: usize,
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

/// One way through the motions.
#[derive(Debug, Clone, Copy)]
enum Way {
    Safe,
    Lanes(Instructions),
    AllCores,
    OneCore,
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

/// Measurements that [`measure`] makes in so many repeats.
pub fn measurements(sets: &[Instructions], repeats: usize) -> u64 {
    ((repeats + 1) * (sets.len() + 5)) as u64
}

/// Measures so many rounds after one that is not counted: the safe engine, one lane, all lanes, all cores and one
/// of them, lanes with the narrower sets.
///
/// # Errors
/// [`Failure::Run`] if a motion cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn measure(
    fleet: &Fleet,
    sets: &[Instructions],
    repeats: usize,
    progress: &Progress,
) -> Result<Timings, Failure> {
    let pool = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.context("no threads to be had")
    };
    let (all, one) = (pool(0)?, pool(1)?);
    let sets_ways = sets.iter().map(|set| Way::Lanes(*set));
    let mut ways = vec![
        Way::Safe,
        Way::Lanes(Instructions::OneByOne),
        Way::Lanes(Instructions::Widest),
        Way::AllCores,
        Way::OneCore,
    ];
    ways.extend(sets_ways);
    let mut rounds = vec![Vec::new(); ways.len()];
    for round in 0..=repeats {
        for (way, times) in ways.iter().zip(&mut rounds) {
            let took = timed(|| way.go(fleet, &all, &one))?;
            progress.step()?;
            if round > 0 {
                times.push(took);
            }
        }
    }
    let mut timings = rounds.into_iter().map(timing);
    let mut next = || timings.next().context("a measurement is missing");
    Ok(Timings {
        safe: next()?,
        scalar: next()?,
        batch: next()?,
        parallel: next()?,
        alone: next()?,
        narrower: sets.iter().copied().zip(timings).collect(),
        threads: all.current_num_threads(),
    })
}

impl Way {
    fn go(self, fleet: &Fleet, all: &ThreadPool, one: &ThreadPool) -> Result<Count, MotionError> {
        match self {
            Self::Safe => fleet.safe(),
            Self::Lanes(set) => fleet.batch(set),
            Self::AllCores => all.install(|| fleet.parallel(ROUNDS)),
            Self::OneCore => one.install(|| fleet.parallel(ROUNDS)),
        }
    }
}

fn timed(work: impl FnOnce() -> Result<Count, MotionError>) -> Result<(f64, Count), Failure> {
    let begin = Instant::now();
    let count = work().context("a motion of the measurement")?;
    Ok((begin.elapsed().as_secs_f64(), count))
}

fn timing(rounds: Vec<(f64, Count)>) -> Timing {
    let count = rounds.last().map_or(Count::default(), |(_, count)| *count);
    let mut seconds: Vec<f64> = rounds.into_iter().map(|(seconds, _)| seconds).collect();
    seconds.sort_by(f64::total_cmp);
    Timing { seconds, count }
}
