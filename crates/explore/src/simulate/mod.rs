//! `softstop simulate`: any scene, from a start, over whole drive periods.

pub mod chart;
mod record;
mod report;
mod run;
mod tally;

use std::path::PathBuf;

use clap::Args;
use softstop::{Allowed, Machine, PhaseKind, Start};

use report::SimulateReport;
use softstop_console::arguments::MachineArguments;
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::Format;
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
    let crossings = column::help("crossings.csv", &record::columns());
    EXAMPLES.to_owned() + &column::help("motion.csv", &run::columns()) + &crossings
}

/// Arguments of `softstop simulate`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct SimulateArguments {
    /// Whole drive periods to run, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub periods: u64,
    /// Position to start from [default: that of the machine]
    #[arg(long, value_name = "X")]
    pub position: Option<f64>,
    /// Velocity to start with [default: that of the machine]
    #[arg(long, value_name = "V")]
    pub velocity: Option<f64>,
    /// Rows of motion.csv in each period, 1 to 100000; they change nothing in the motion
    #[arg(long, value_name = "K", default_value_t = 200)]
    pub samples_per_period: u64,
    /// Folder for motion.csv, crossings.csv and motion.svg
    #[arg(long, value_name = "DIR", default_value = "softstop-motion")]
    pub output: PathBuf,
    /// How to print the summary
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
}

const FILES: [(&str, &str); 3] = [
    ("motion_csv", "motion.csv"),
    ("crossings_csv", "crossings.csv"),
    ("svg", "motion.svg"),
];
/// Rows of motion.csv at most.
const MOST_ROWS: u64 = 20_000_000;

/// Runs the scene, writes the files and prints the summary.
pub fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    check(arguments)?;
    let given = [
        ("position", arguments.position),
        ("velocity", arguments.velocity),
    ];
    for (flag, _) in given.iter().filter(|(_, value)| value.is_some()) {
        arguments.machine.refuse_start_beside(flag)?;
    }
    let machine = arguments.machine.machine()?;
    let Machine { scene, start, .. } = &machine;
    let start = Start::new(
        arguments.position.unwrap_or(start.position),
        arguments.velocity.unwrap_or(start.velocity),
    );
    let motion = scene.motion(start)?;
    let export = Export::open(&arguments.output, &FILES)?;
    let (samples, crossings) = (run::columns(), record::columns());
    let plan = run::Plan {
        scene,
        periods: arguments.periods,
        samples: arguments.samples_per_period,
    };
    let outcome = plan.run(
        motion,
        export.open_table("motion_csv", &samples)?,
        export.open_table("crossings_csv", &crossings)?,
    )?;
    let report = SimulateReport::new(arguments, &machine, start, &outcome);
    let title = report::chart_title(&machine, arguments.periods);
    let chart = outcome.drawing.svg(&machine, &title, &run::faces(scene));
    export.file("svg", chart.as_bytes())?;
    export.finish(&report, arguments.format)
}

fn check(arguments: &SimulateArguments) -> Result<(), Failure> {
    within("periods", arguments.periods, 1..=1_000_000)?;
    let samples = arguments.samples_per_period;
    within("samples-per-period", samples, 1..=100_000)?;
    let rows = arguments.periods * samples;
    within("periods x samples-per-period", rows, 1..=MOST_ROWS)?;
    Allowed::Finite.check("position", arguments.position.unwrap_or(0.0))?;
    Ok(Allowed::Finite.check("velocity", arguments.velocity.unwrap_or(0.0))?)
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
