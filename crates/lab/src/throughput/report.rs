//! What is said of a measurement: plain data whose field names are the keys of the JSON.

use serde::Serialize;
use softstop_lanes::Instructions;

use super::check::Check;
use super::fleet::Range;
use super::measure::{ROUNDS, Timing, Timings};
use crate::precision::machine::Machine;

/// The whole report.
#[derive(Debug, Clone, Serialize)]
pub struct ThroughputReport {
    /// Where times were taken.
    pub machine: Machine,
    /// The motions.
    pub scene: Range,
    /// How often they were measured.
    pub repeats: usize,
    /// The safe engine, which decides what the lanes leave undecided.
    pub safe: Engine,
    /// One motion after the other, each alone in one lane.
    pub scalar: LaneEngine,
    /// The lanes with the widest instruction set.
    pub batch: LaneEngine,
    /// The same with registers of 256 bits, where the processor has wider ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub avx2: Option<LaneEngine>,
    /// The same without vector instructions, where it has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub portable: Option<LaneEngine>,
    /// The lanes on all cores.
    pub both_cores: Cores,
    /// The engines on random machines, if asked for.
    pub check: Option<Check>,
}

/// One engine on one core.
#[derive(Debug, Clone, Serialize)]
pub struct Engine {
    /// Forcing periods per second, the median.
    pub periods_per_second_per_core: f64,
    /// Slowest and fastest measurement.
    pub spread: (f64, f64),
    /// Impacts of all motions.
    pub impacts: u64,
}

/// Lanes on one core.
#[derive(Debug, Clone, Serialize)]
pub struct LaneEngine {
    /// The engine.
    #[serde(flatten)]
    pub engine: Engine,
    /// Motions in lock-step.
    pub lanes: usize,
    /// Name of the instruction set.
    pub instructions: &'static str,
    /// Forcing periods that the safe engine followed, in part or whole.
    pub handed_over: u64,
    /// How many times as fast as one lane.
    pub times_scalar: f64,
    /// How many times as fast as the safe engine.
    pub times_safe: f64,
}

/// All cores together.
#[derive(Debug, Clone, Serialize)]
pub struct Cores {
    /// Threads.
    pub threads: usize,
    /// Forcing periods per second, the median.
    pub periods_per_second: f64,
    /// How many times as fast as one core at the same work.
    pub factor: f64,
}

impl ThroughputReport {
    /// What was measured, without a check.
    pub fn new(range: Range, repeats: usize, timings: &Timings) -> Self {
        let work = range.all_periods() as f64;
        let lanes = |wanted| {
            let mut all = timings.narrower.iter();
            let (set, timing) = all.find(|(set, _)| *set == wanted)?;
            Some(LaneEngine::new(*set, timing, timings, work))
        };
        let parallel = work * ROUNDS as f64 / timings.parallel.median();
        let batch = LaneEngine::new(Instructions::Widest, &timings.batch, timings, work);
        Self {
            machine: Machine::this(),
            scene: range,
            repeats,
            safe: Engine::new(&timings.safe, work),
            scalar: LaneEngine::new(Instructions::OneByOne, &timings.scalar, timings, work),
            both_cores: Cores {
                threads: timings.threads,
                periods_per_second: parallel,
                factor: timings.alone.median() / timings.parallel.median(),
            },
            batch,
            avx2: lanes(Instructions::Avx2),
            portable: lanes(Instructions::Portable),
            check: None,
        }
    }
}

impl Engine {
    fn new(timing: &Timing, work: f64) -> Self {
        let rate = |seconds: Option<&f64>| seconds.map_or(f64::NAN, |seconds| work / seconds);
        Self {
            periods_per_second_per_core: work / timing.median(),
            spread: (rate(timing.seconds.last()), rate(timing.seconds.first())),
            impacts: timing.count.impacts,
        }
    }
}

impl LaneEngine {
    fn new(set: Instructions, timing: &Timing, all: &Timings, work: f64) -> Self {
        let registers = set.registers();
        Self {
            engine: Engine::new(timing, work),
            lanes: registers.lanes,
            instructions: registers.name,
            handed_over: timing.count.handed_over,
            times_scalar: all.scalar.median() / timing.median(),
            times_safe: all.safe.median() / timing.median(),
        }
    }
}
