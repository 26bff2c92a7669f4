//! The measurement as a table for people.

use super::check::Check;
use super::report::{Engine, LaneEngine, ThroughputReport};
use softstop_console::table::{Row, heading, row, table};

/// The report.
pub fn text(report: &ThroughputReport) -> String {
    let scene = &report.scene;
    let (low, high) = scene.frequencies;
    let mut text = heading("Throughput on one core, in millions of forcing periods per second");
    text += &format!(
        "The {} machine at {} frequencies over {low} to {high}, {} periods each from ({}, {});\nmedians of {} runs (--repeats)\n\n",
        scene.machine, scene.motions, scene.periods, scene.start.0, scene.start.1, report.repeats
    );
    let mut rows = vec![row(
        "  engine",
        ["median", "slowest", "fastest", "lanes", "handed over"].map(String::from),
    )];
    rows.push(row("  safe", figures(&report.safe)));
    rows.push(lanes("  scalar", &report.scalar));
    rows.push(lanes("  batch", &report.batch));
    let narrower = [&report.avx2, &report.portable];
    rows.extend(
        narrower
            .into_iter()
            .flatten()
            .map(|engine| lanes("  batch", engine)),
    );
    text += &table(&rows);
    let cores = &report.both_cores;
    text += &format!(
        "\nAll lanes are {:.1} times as fast as one, {:.1} times as fast as the safe engine; {} thread(s) {:.2} times \
         as fast as one: {} million\n",
        report.batch.times_scalar,
        report.batch.times_safe,
        cores.threads,
        cores.factor,
        millions(cores.periods_per_second)
    );
    if let Some(check) = &report.check {
        text += &told(check);
    }
    text + &format!("Machine: {}\n", report.machine.line())
}

fn figures(engine: &Engine) -> Vec<String> {
    let (slowest, fastest) = engine.spread;
    [engine.periods_per_second_per_core, slowest, fastest]
        .map(millions)
        .to_vec()
}

fn lanes(name: &str, engine: &LaneEngine) -> Row {
    let mut cells = figures(&engine.engine);
    cells.push(engine.lanes.to_string());
    cells.push(engine.handed_over.to_string());
    row(&format!("{name}, {}", engine.instructions), cells)
}

fn millions(rate: f64) -> String {
    format!("{:.2}", rate / 1e6)
}

fn told(check: &Check) -> String {
    let tally = &check.tally;
    let mut text = format!(
        "\nBoth engines on {} random motions of {} periods with {} impacts, in {:.1} s:\n\
         {} count different impacts; of {} more that are chaotic or graze within rounding, {} do\n\
         {} periods in {} motions were handed over\n",
        tally.trajectories,
        check.periods,
        tally.impacts,
        check.seconds,
        tally.different,
        tally.chaotic,
        tally.different_in_chaos,
        tally.handed_over_periods,
        tally.handed_over,
    );
    for difference in &tally.first {
        text += &format!(
            "  {} impacts in lanes, {} by the safe engine: {:?} from {:?}\n",
            difference.batch, difference.scalar, difference.scene, difference.start
        );
    }
    text
}
