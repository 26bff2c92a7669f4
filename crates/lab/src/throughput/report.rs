//! The report of `throughput`, for programs and for people.

use serde_json::json;
use softstop_lanes::InstructionLimit;

use super::batch::Range;
use super::measure::{ROUNDS, Timing, Way};
use super::study_cost::StudyCost;
use super::zones::Grid;
use crate::precision::computer::Computer;
use softstop_console::column::{Column, Units, text};
use softstop_console::columns;
use softstop_console::record::Record;
use softstop_console::table::heading;

/// An engine on one core.
pub(super) struct Engine<'a> {
    /// Its name in JSON, and for people.
    pub names: [&'static str; 2],
    /// Motions in lock-step and the instruction set, if it is one of lanes.
    pub lanes: Option<(usize, InstructionLimit)>,
    /// How it goes through the motions.
    pub way: Way<'a>,
}

/// An engine with its times.
struct EngineTiming<'a> {
    engine: &'a Engine<'a>,
    timing: &'a Timing,
    /// Drive periods of a round.
    periods: f64,
}

/// What people read of it.
fn columns<'a>() -> [Column<EngineTiming<'a>>; 7] {
    columns! { EngineTiming<'a>, it;
        "engine" [None] Plain, "and instruction set" => name(it.engine);
        "median" [None] Fixed(2), "of all rounds" => it.periods / it.timing.median() / 1e6;
        "slowest" [None] Fixed(2), "round" => it.timing.spread(it.periods)[0] / 1e6;
        "fastest" [None] Fixed(2), "round" => it.timing.spread(it.periods)[1] / 1e6;
        "lanes" [None] Plain, "motions in lock-step" => it.engine.lanes.map(|(lanes, _)| lanes);
        "handed_over" [None] Plain, "periods left to the safe engine" => it.engine.lanes.map(|_| it.timing.count.handed_over);
        "leapt" [None] Plain, "periods leapt over, since each is like the one before" => it.engine.lanes.map(|_| it.timing.count.leapt);
    }
}

fn name(engine: &Engine<'_>) -> String {
    let set = engine.lanes.map(|(_, set)| set.registers().name);
    let set = set.map_or_else(String::new, |set| format!(", {set}"));
    engine.names[1].to_owned() + &set
}

/// An engine's times for programs, beside the safe engine and one lane.
fn figures(timed: &EngineTiming<'_>, safe: &Timing, scalar: &Timing) -> Record {
    let EngineTiming {
        engine,
        timing,
        periods,
    } = timed;
    let figures = Record::default()
        .hidden("periods_per_second_per_core", periods / timing.median())
        .hidden("spread", timing.spread(*periods))
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
}

/// What was measured, and the text of it: the engines, of which the first is the safe one and the second one lane, and the
/// timings of them, of all cores, of one of them and of the zones; a study, if asked for.
pub(super) fn report(
    (scene, grid, repeats): (Range, Grid, usize),
    engines: &[Engine<'_>],
    timings: &[Timing],
    threads: usize,
    study: Option<&StudyCost>,
) -> Option<(Record, String)> {
    let periods = scene.all_periods() as f64;
    let (timings, others) = timings.split_at_checked(engines.len())?;
    let ([safe, scalar, batch, ..], [parallel, alone, zones]) = (timings, others) else {
        return None;
    };
    let timed = engines.iter().zip(timings);
    let timed: Vec<EngineTiming<'_>> = timed
        .map(|(engine, timing)| EngineTiming {
            engine,
            timing,
            periods,
        })
        .collect();
    let factor = alone.median() / parallel.median();
    let rate = periods * ROUNDS as f64 / parallel.median();
    let machines = f64::from(grid.edge * grid.edge);
    let (found, per_second) = (zones.count.found, machines / zones.median());
    let spread @ [slowest, fastest] = zones.spread(machines);
    let (named, edge) = (grid.machine, grid.edge);
    let ((from, to), (soft, stiff)) = (grid.clearances, grid.stiffnesses);
    let computer = Computer::this();

    let (machine, (low, high), start) = (scene.machine.name(), scene.frequencies, scene.start);
    let text = heading("Throughput on one core, in millions of forcing periods per second")
        + &format!(
            "The {machine} machine at {} frequencies over {low} to {high}, {} periods each from {start:?};\n\
             medians of {repeats} runs (--repeats)\n\n",
            scene.motions, scene.periods
        )
        + &text(&columns(), &timed, &Units::SI)
        + &format!(
            "\nAll lanes are {:.1} times as fast as one, {:.1} times as fast as the safe engine; {threads} thread(s) \
             {factor:.2} times as fast as one: {:.2} million\n",
            scalar.median() / batch.median(),
            safe.median() / batch.median(),
            rate / 1e6
        )
        + &format!(
            "Hysteresis zones of the {named} machine at {edge} x {edge} places over clearance {from} to {to} and stiffness \
             {soft} to {stiff}, {found} found:\n{per_second:.0} a second on one core, {slowest:.0} to {fastest:.0}\n",
        )
        + &study.map_or_else(String::new, StudyCost::told)
        + &format!("Machine: {}\n", computer.line());

    let result = Record::default()
        .hidden("machine", json!(computer))
        .hidden("scene", json!(scene))
        .hidden("repeats", repeats);
    let result = timed.iter().fold(result, |result, it| {
        result.hidden(it.engine.names[0], figures(it, safe, scalar))
    });
    let both_cores = Record::default()
        .hidden("threads", threads)
        .hidden("periods_per_second", rate)
        .hidden("factor", factor);
    let zones = Record::default()
        .hidden("grid", json!(grid))
        .hidden("found", found)
        .hidden("zones_per_second_per_core", per_second)
        .hidden("spread", spread);
    let mut result = result
        .hidden("both_cores", both_cores)
        .hidden("zones", zones);
    if let Some(study) = study {
        result = result.hidden("study", json!(study));
    }
    Some((result, text))
}
