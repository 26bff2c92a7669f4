//! `softstop-lab system`: drive, press and feeder in co-simulation, as a master steps them.

mod chart;
mod coupled;
mod order;
mod part;
mod report;
mod run_up;
mod strips;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::Format;
use softstop_console::progress::Progress;

use report::{OrderReport, RunUpReport, StripsReport};

const EXAMPLES: &str = "\
Examples:
  softstop-lab system strips
      strips fail in runs, at every drive angle, and by chance: on an ideal drive and on a motor
  softstop-lab system run-up
      which torque passes the resonance and lands in z = 1; speed over voltage, up and down
  softstop-lab system order
      what the coupling costs in accuracy: error over the step of the master
  softstop-lab system strips --draft
      a first look in seconds

All of them are of the paper's machine B on the units of piercing-machine.ssp. docs/system.md tells what is to be seen.
Files, whole or not at all: NAME.svg, NAME.csv.";

/// Arguments of `softstop-lab system`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SystemArguments {
    /// What is studied
    #[arg(value_enum)]
    pub study: Study,
    /// Few points, for a first look
    #[arg(long)]
    pub draft: bool,
    /// Folder for picture and table
    #[arg(long, value_name = "DIR", default_value = "softstop-system")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// The studies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Study {
    /// Strips that fail
    Strips,
    /// Running up from rest, and the voltage up and down
    RunUp,
    /// Error of the coupling over the step
    Order,
}

/// Runs a study, draws it and says what came out.
///
/// # Errors
/// [`Failure::Run`] if a unit cannot go on or the folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &SystemArguments) -> Result<(), Failure> {
    let name = match arguments.study {
        Study::Strips => "strips",
        Study::RunUp => "run-up",
        Study::Order => "order",
    };
    let (svg, csv) = (format!("{name}.svg"), format!("{name}.csv"));
    let export = Export::open(&arguments.output, &[("svg", &svg), ("csv", &csv)])?;
    let (draft, format) = (arguments.draft, arguments.format);
    match arguments.study {
        Study::Strips => {
            let strips = strips(draft)?;
            export.file("svg", chart::strips(&strips).as_bytes())?;
            export.table("csv", &report::runs(), &strips.runs)?;
            export.finish(&StripsReport::new(strips), format)
        }
        Study::RunUp => {
            let report = run_up(draft)?;
            export.file("svg", chart::run_up(&report).as_bytes())?;
            export.table("csv", &report::run_ups(), &report.run_ups)?;
            export.finish(&report, format)
        }
        Study::Order => {
            let steps: i32 = if draft { 5 } else { 8 };
            let progress = Progress::new(steps as u64 * order::COUPLINGS.len() as u64, "runs");
            let report = OrderReport::new(order::study(steps, &progress)?);
            drop(progress);
            export.file("svg", chart::order(&report).as_bytes())?;
            export.table("csv", &report::errors(), &report.errors)?;
            export.finish(&report, format)
        }
    }
}

fn strips(draft: bool) -> Result<strips::Strips, Failure> {
    let detail = match draft {
        true => strips::Detail {
            frequencies: 3,
            angles: 2,
            seeds: 1,
        },
        false => strips::Detail {
            frequencies: 12,
            angles: 6,
            seeds: 2,
        },
    };
    let progress = Progress::new(detail.runs() as u64, "runs");
    Ok(strips::study(detail, &progress)?)
}

fn run_up(draft: bool) -> Result<RunUpReport, Failure> {
    let detail = match draft {
        true => run_up::Detail {
            torques: 2,
            rises: 2,
            plateaus: 9,
            plateau: 150.0,
        },
        false => run_up::Detail {
            torques: 18,
            rises: 16,
            plateaus: 41,
            plateau: 300.0,
        },
    };
    let runs = detail.torques * detail.rises + 2 * detail.plateaus;
    let progress = Progress::new(runs as u64, "runs");
    Ok(RunUpReport {
        run_ups: run_up::run_ups(detail, &progress)?,
        plateaus: run_up::up_and_down(detail, &progress)?,
    })
}
