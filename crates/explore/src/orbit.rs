//! `softstop orbit`: the stable motion with one impact per drive period.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;
use softstop_dynamics::orbit::{Orbit, OrbitError};

use softstop_console::failure::Failure;
use softstop_console::machine::{self, Machine, SceneSettings};
use softstop_console::output::{self, Format};
use softstop_console::report::{self, MachineReport, MotionReport};
use softstop_console::table::{heading, number, row, table};

const EXAMPLES: &str = "\
Examples:
  softstop orbit --regime unloaded --frequency 1.15 --clearance 10
      the paper's point A: before-impact velocity 6.494627
  softstop orbit --regime loaded --frequency 1.15 --clearance 10 --format json
      its point B, for programs
  softstop orbit --scene machine.toml --frequency 1.2
      with machine.toml holding, say,
          regime = \"loaded\"
          clearance = 8.0
          contact_damping = 0.1

Position and velocity are those at drive angle 0 (a multiple of the drive's period). The
motion is stable if both Floquet multipliers lie inside the unit circle.";

/// Arguments of `softstop orbit`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct OrbitArguments {
    /// Machine in a TOML file, by the names below; the command line has the last word
    #[arg(long, value_name = "FILE.toml")]
    pub scene: Option<PathBuf>,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: SceneSettings,
}

/// Finds the orbit and prints it.
///
/// # Errors
/// [`Failure::Usage`] for values no machine can have, [`Failure::Run`] if there is no orbit.
pub fn run(arguments: &OrbitArguments) -> Result<(), Failure> {
    let machine = machine::machine(arguments.scene.as_ref(), &arguments.machine)?;
    let scene = machine
        .ratios
        .scene()
        .map_err(|error| Failure::usage(error.to_string()))?;
    let orbit = softstop_dynamics::orbit::find(&scene).map_err(|error| match error {
        OrbitError::NotFound {
            frequency,
            clearance,
        } => anyhow!(
            "no stable z = 1 motion found at frequency = {frequency}, clearance = {clearance}"
        ),
        other => other.into(),
    })?;
    let report = OrbitReport::new(&machine, &orbit);
    output::print(&match arguments.format {
        Format::Json => output::json(&report)?,
        Format::Text => text(&report),
    })
}

/// What `softstop orbit` reports.
#[derive(Debug, Clone, Serialize)]
pub struct OrbitReport {
    /// The motion.
    #[serde(flatten)]
    pub motion: MotionReport,
    /// Where it was found.
    #[serde(flatten)]
    pub machine: MachineReport,
}

impl OrbitReport {
    /// The orbit of this machine.
    #[must_use]
    pub fn new(machine: &Machine, orbit: &Orbit) -> Self {
        Self {
            motion: MotionReport::new(machine.ratios.frequency, orbit),
            machine: MachineReport::new(machine.regime, &machine.ratios),
        }
    }
}

/// The orbit, one quantity a line.
fn text(report: &OrbitReport) -> String {
    let mut rows = report::machine(&report.machine);
    rows.push(row(
        "drive frequency eta",
        [number(report.motion.frequency)],
    ));
    rows.extend(report::motion(&report.motion));
    heading("Stable motion with one impact per drive period (z = 1)") + &table(&rows)
}
