//! The report of `throughput`, for programs and for people.

use serde::Serialize;
use softstop_lanes::Instructions;

use super::beside::Beside;
use super::fleet::Range;
use super::measure::{ROUNDS, Timing, Way};
use super::zones::{Grid, Zones};
use crate::precision::computer::Machine;
use softstop_console::column::{Column, Units, text};
use softstop_console::columns;
use softstop_console::record::Record;
use softstop_console::table::heading;

/// An engine on one core.
pub(super) struct Engine<'a> {
    /// Its name in JSON, and for people.
    pub names: [&'static str; 2],
    /// Motions in lock-step and the instruction set, if it is one of lanes.
    pub lanes: Option<(usize, Instructions)>,
    /// How it goes through the motions.
    pub way: Way<'a>,
}

/// The whole report.
#[derive(Debug, Serialize)]
pub(super) struct ThroughputReport {
    /// Where times were taken.
    machine: Machine,
    /// The motions.
    scene: Range,
    /// How often they were measured.
    repeats: usize,
    /// The engines, each by its name.
    #[serde(flatten)]
    engines: Record,
    /// The lanes on all cores.
    both_cores: Record,
    /// Hysteresis zones on one core.
    zones: Zones,
    /// A study, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub study: Option<Beside>,
    /// What people read of the engines.
    #[serde(skip)]
    table: String,
}

/// An engine with what was measured of it, and the drive periods of a round.
type Measured<'a> = (&'a Engine<'a>, &'a Timing, f64);

/// What people read of it.
fn columns<'a>() -> [Column<Measured<'a>>; 7] {
    columns! { Measured<'a>, it;
        "engine" [None] Plain, "and instruction set" => name(it.0);
        "median" [None] Fixed(2), "of all rounds" => it.2 / it.1.median() / 1e6;
        "slowest" [None] Fixed(2), "round" => it.1.spread(it.2)[0] / 1e6;
        "fastest" [None] Fixed(2), "round" => it.1.spread(it.2)[1] / 1e6;
        "lanes" [None] Plain, "motions in lock-step" => it.0.lanes.map(|of| of.0);
        "handed_over" [None] Plain, "periods left to the safe engine" => it.0.lanes.map(|_| it.1.count.handed_over);
        "leapt" [None] Plain, "periods leapt over, since each is like the one before" => it.0.lanes.map(|_| it.1.count.leapt);
    }
}

fn name(engine: &Engine<'_>) -> String {
    let set = engine.lanes.map(|(_, set)| set.registers().name);
    let set = set.map_or_else(String::new, |set| format!(", {set}"));
    engine.names[1].to_owned() + &set
}

impl ThroughputReport {
    /// What was measured, without a study: the engines, of which the first is the safe one and the second one lane, and the
    /// timings of them, of all cores, of one of them and of the zones.
    pub(super) fn new(
        (scene, grid, repeats): (Range, Grid, usize),
        engines: &[Engine<'_>],
        timings: &[Timing],
        threads: usize,
    ) -> Option<Self> {
        let work = scene.all_periods() as f64;
        let (timings, others) = timings.split_at_checked(engines.len())?;
        let ([safe, scalar, batch, ..], [parallel, alone, zones]) = (timings, others) else {
            return None;
        };
        let measured = engines.iter().zip(timings);
        let measured: Vec<Measured<'_>> = measured.map(|(it, timing)| (it, timing, work)).collect();
        let figures = |(engine, timing, _): &Measured<'_>| {
            let figures = Record::default()
                .hidden("periods_per_second_per_core", work / timing.median())
                .hidden("spread", timing.spread(work))
                .hidden("impacts", timing.count.impacts);
            let Some((lanes, set)) = engine.lanes else {
                return figures;
            };
            figures
                .hidden("lanes", lanes)
                .hidden("instructions", set.registers().name)
                .hidden("handed_over", timing.count.handed_over)
                .hidden("leapt", timing.count.leapt)
                .hidden("times_scalar", scalar.median() / timing.median())
                .hidden("times_safe", safe.median() / timing.median())
        };
        let factor = alone.median() / parallel.median();
        let rate = work * ROUNDS as f64 / parallel.median();
        let table = text(&columns(), &measured, &Units::SI)
            + &format!(
                "\nAll lanes are {:.1} times as fast as one, {:.1} times as fast as the safe engine; {threads} thread(s) \
                 {factor:.2} times as fast as one: {:.2} million\n",
                scalar.median() / batch.median(),
                safe.median() / batch.median(),
                rate / 1e6
            );
        let engines = measured.iter();
        Some(Self {
            machine: Machine::this(),
            scene,
            repeats,
            engines: engines.fold(Record::default(), |all, it| {
                all.hidden(it.0.names[0], figures(it))
            }),
            both_cores: Record::default()
                .hidden("threads", threads)
                .hidden("periods_per_second", rate)
                .hidden("factor", factor),
            zones: Zones::new(grid, zones),
            study: None,
            table,
        })
    }

    /// What people read.
    pub(super) fn text(&self) -> String {
        let scene = &self.scene;
        let (low, high) = scene.frequencies;
        let mut said = heading("Throughput on one core, in millions of forcing periods per second");
        said += &format!(
            "The {} machine at {} frequencies over {low} to {high}, {} periods each from ({}, {});\n\
             medians of {} runs (--repeats)\n\n{}",
            scene.machine.name(),
            scene.motions,
            scene.periods,
            scene.start.0,
            scene.start.1,
            self.repeats,
            self.table
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
            spread[0],
            spread[1]
        );
        said += &self.study.as_ref().map_or_else(String::new, Beside::told);
        said + &format!("Machine: {}\n", self.machine.line())
    }
}
