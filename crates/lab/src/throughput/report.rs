//! The report of `throughput`, for programs and for people.

use serde::Serialize;
use softstop_lanes::Instructions;

use super::beside::Beside;
use super::fleet::Range;
use super::measure::{ROUNDS, Timing};
use super::zones::{Grid, Zones};
use crate::precision::computer::Machine;
use softstop_console::column::{Column, Units, text};
use softstop_console::columns;
use softstop_console::table::heading;

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
    /// The same with each impact told, so that no motion with impacts is leapt over.
    pub each_impact: LaneEngine,
    /// The lanes with registers of 256 bits, where the processor has wider ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub avx2: Option<LaneEngine>,
    /// The same without vector instructions, where it has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub portable: Option<LaneEngine>,
    /// The lanes on all cores.
    pub both_cores: Cores,
    /// Hysteresis zones on one core.
    pub zones: Zones,
    /// A study, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub study: Option<Beside>,
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
    /// Forcing periods that were leapt over, since each is like the one before.
    pub leapt: u64,
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
    /// What was measured, without a study: the timings of the safe engine, of one lane, of all, of all with each
    /// impact told, of all cores, of one of them, of the zones, and of the narrower sets.
    pub fn new(
        scene: Range,
        grid: Grid,
        repeats: usize,
        (timings, threads): (&[Timing], usize),
        sets: &[Instructions],
    ) -> Option<Self> {
        let [
            safe,
            scalar,
            batch,
            each_impact,
            parallel,
            alone,
            zones,
            narrower @ ..,
        ] = timings
        else {
            return None;
        };
        let work = scene.all_periods() as f64;
        let lanes = |set: Instructions, timing: &Timing| LaneEngine {
            engine: Engine::new(timing, work),
            lanes: set.registers().lanes,
            instructions: set.registers().name,
            handed_over: timing.count.handed_over,
            leapt: timing.count.leapt,
            times_scalar: scalar.median() / timing.median(),
            times_safe: safe.median() / timing.median(),
        };
        let narrower = |wanted: Instructions| {
            let mut all = sets.iter().zip(narrower);
            let (set, timing) = all.find(|(set, _)| **set == wanted)?;
            Some(lanes(*set, timing))
        };
        Some(Self {
            machine: Machine::this(),
            scene,
            repeats,
            safe: Engine::new(safe, work),
            scalar: LaneEngine {
                lanes: 1,
                ..lanes(Instructions::Avx2, scalar)
            },
            batch: lanes(Instructions::Widest, batch),
            each_impact: lanes(Instructions::Widest, each_impact),
            avx2: narrower(Instructions::Avx2),
            portable: narrower(Instructions::Portable),
            both_cores: Cores {
                threads,
                periods_per_second: work * ROUNDS as f64 / parallel.median(),
                factor: alone.median() / parallel.median(),
            },
            zones: Zones::new(grid, zones),
            study: None,
        })
    }
}

impl Engine {
    fn new(timing: &Timing, work: f64) -> Self {
        Self {
            periods_per_second_per_core: work / timing.median(),
            spread: timing.spread(work),
            impacts: timing.count.impacts,
        }
    }
}

/// A line of the table for people: the engine's name, the engine, what it has if it is one of lanes.
type Line<'a> = (String, &'a Engine, Option<&'a LaneEngine>);

/// Its columns.
fn table<'a>() -> [Column<Line<'a>>; 7] {
    columns! { Line<'a>, it;
        "engine" [None] Plain, "and instruction set" => it.0.as_str();
        "median" [None] Fixed(2), "of all rounds" => it.1.periods_per_second_per_core / 1e6;
        "slowest" [None] Fixed(2), "round" => it.1.spread.0 / 1e6;
        "fastest" [None] Fixed(2), "round" => it.1.spread.1 / 1e6;
        "lanes" [None] Plain, "motions in lock-step" => it.2.map(|of| of.lanes);
        "handed_over" [None] Plain, "periods left to the safe engine" => it.2.map(|of| of.handed_over);
        "leapt" [None] Plain, "periods leapt over, since each is like the one before" => it.2.map(|of| of.leapt);
    }
}

impl ThroughputReport {
    /// What people read.
    pub(super) fn text(&self) -> String {
        let (scene, cores) = (&self.scene, &self.both_cores);
        let (low, high) = scene.frequencies;
        let narrower = [&self.avx2, &self.portable].into_iter().flatten();
        let batches = [("batch", &self.batch), ("each impact", &self.each_impact)];
        let batches = batches
            .into_iter()
            .chain(narrower.map(|lanes| ("batch", lanes)));
        let mut lines: Vec<Line<'_>> = vec![("safe".to_owned(), &self.safe, None)];
        for (name, lanes) in [("scalar", &self.scalar)].into_iter().chain(batches) {
            let name = format!("{name}, {}", lanes.instructions);
            lines.push((name, &lanes.engine, Some(lanes)));
        }
        let mut said = heading("Throughput on one core, in millions of forcing periods per second");
        said += &format!(
            "The {} machine at {} frequencies over {low} to {high}, {} periods each from ({}, {});\n\
             medians of {} runs (--repeats)\n\n",
            scene.machine.name(),
            scene.motions,
            scene.periods,
            scene.start.0,
            scene.start.1,
            self.repeats
        );
        said += &text(&table(), &lines, &Units::SI);
        said += &format!(
            "\nAll lanes are {:.1} times as fast as one, {:.1} times as fast as the safe engine; {} thread(s) {:.2} \
             times as fast as one: {:.2} million\n",
            self.batch.times_scalar,
            self.batch.times_safe,
            cores.threads,
            cores.factor,
            cores.periods_per_second / 1e6
        );
        let Zones { grid, spread, .. } = &self.zones;
        said += &format!(
            "Hysteresis zones of the {} machine at {} x {} places over clearance {} to {} and stiffness {} to {}, {} \
             found:\n{:.0} a second on one core, {:.0} to {:.0}\n",
            grid.machine,
            grid.edge,
            grid.edge,
            grid.clearances.0,
            grid.clearances.1,
            grid.stiffnesses.0,
            grid.stiffnesses.1,
            self.zones.found,
            self.zones.zones_per_second_per_core,
            spread.0,
            spread.1
        );
        said += &self.study.as_ref().map_or_else(String::new, Beside::told);
        said + &format!("Machine: {}\n", self.machine.line())
    }
}
