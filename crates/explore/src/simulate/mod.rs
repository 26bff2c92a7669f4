//! `softstop simulate`: any scene, from a start, over whole drive periods.

mod begin;
pub mod chart;
mod record;
mod report;
mod run;
mod tally;

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::Args;
use softstop::PhaseKind;

pub use begin::MotionArguments;
pub use record::contact_force;
pub(crate) use record::{CrossingRow, crossing_columns};
pub(crate) use report::report;
pub(crate) use run::{RunOutcome, faces};

use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::range::within;

const EXAMPLES: &str = "\
Examples:
  softstop simulate docs/scenes/preloaded.toml
      the paper's unloaded machine at point A over 100 drive periods
  softstop simulate docs/scenes/chatter.toml --periods 5 --samples-per-period 1000
      bounces on a rigid stop that pile up to rest
  softstop simulate docs/scenes/hertz.toml --position 0 --velocity 14 --format json
      another start; the summary for programs
  softstop simulate machine.toml --set stop.stiffness=8
      another stop, with machine.toml holding, in SI units, say
          mass = 1.0
          stiffness = 1.0
          damping = 0.04
          clearance = 10.0
          contact.damping = 0.18
          [excitation]
          amplitude = 1.0
          frequency = 1.15
          [stop]
          model = \"preloaded\"
          stiffness = 7.0
          preload = 70.0
          [initial]
          position = 6.9
          velocity = 9.5

Three files are written, whole or not at all: motion.csv, crossings.csv (every impact, rebound,
reversal, rest and release with the exact states on both sides) and motion.svg (the last
periods). docs/stops.md explains all stops.";

fn help() -> String {
    let crossings = column::help("crossings.csv", &crossing_columns());
    EXAMPLES.to_owned() + &column::help("motion.csv", &run::columns()) + &crossings
}

/// Arguments of `softstop simulate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct SimulateArguments {
    /// Whole drive periods to run, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub periods: u64,
    /// Rows of motion.csv in each period, 1 to 100000; they change nothing in the motion
    #[arg(long, value_name = "K", default_value_t = 200)]
    pub samples_per_period: u64,
    /// Folder for motion.csv, crossings.csv and motion.svg
    #[arg(long, value_name = "DIR", default_value = "softstop-motion")]
    pub output: PathBuf,
    /// How it prints its summary, the machine, and where its motion begins.
    #[command(flatten)]
    pub motion: MotionArguments,
}

const FILES: [(&str, &str); 3] = [
    ("motion_csv", "motion.csv"),
    ("crossings_csv", "crossings.csv"),
    ("svg", "motion.svg"),
];
/// Drive periods of a run.
pub(crate) const PERIODS: RangeInclusive<u64> = 1..=1_000_000;
/// Rows of motion.csv at most.
const MOST_ROWS: u64 = 20_000_000;

/// Periods that are drawn, the last ones.
const DRAWN: u64 = 4;

/// Runs the scene, writes the files and prints the summary.
pub fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    check(arguments)?;
    let plan = arguments
        .motion
        .plan(arguments.periods, arguments.samples_per_period, DRAWN)?;
    let export = Export::open(&arguments.output, &FILES)?;
    let (samples, crossings) = (run::columns(), crossing_columns());
    let mut samples = export.open_table("motion_csv", &samples)?;
    let mut crossings = export.open_table("crossings_csv", &crossings)?;
    let run = || plan.run(|row| samples.row(row), |row| crossings.row(row));
    let outcome = arguments.motion.common.limit.budget.limit(run)?;
    samples.close()?;
    crossings.close()?;
    let machine = &plan.machine;
    let title = report::chart_title(&plan);
    let chart = outcome
        .drawing
        .svg(machine, &title, &faces(&machine.check(None)?));
    export.file("svg", chart.as_bytes())?;
    let (result, text) = report(&outcome);
    export.finish(&result, text, arguments.motion.common.format)
}

fn check(arguments: &SimulateArguments) -> Result<(), Failure> {
    within("periods", arguments.periods, PERIODS)?;
    let samples = arguments.samples_per_period;
    within("samples-per-period", samples, 1..=100_000)?;
    let rows = arguments.periods * samples;
    within("periods x samples-per-period", rows, 1..=MOST_ROWS)
}

/// A phase's name in the tables, as in the library's own JSON.
pub const fn name(kind: PhaseKind) -> &'static str {
    match kind {
        PhaseKind::Free => "free",
        PhaseKind::Pierce => "pierce",
        PhaseKind::Cut => "cut",
        PhaseKind::Gap => "gap",
        PhaseKind::Stop => "stop",
        PhaseKind::Released => "released",
        PhaseKind::Chatter => "chatter",
        PhaseKind::Stuck => "stuck",
        PhaseKind::Resting => "resting",
    }
}
