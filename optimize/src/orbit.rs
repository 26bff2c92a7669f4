//! `softstop orbit`: the stable motion with one impact per drive period.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use softstop::orbit::OrbitError;

use crate::arguments::{Machine, SceneSettings};
use crate::configuration;
use crate::failure::Failure;
use crate::output::{self, Format};
use crate::report::{self, OrbitReport};

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
    let machine = machine(arguments.scene.as_ref(), &arguments.machine)?;
    let scene = machine
        .ratios
        .scene()
        .map_err(|error| Failure::usage(error.to_string()))?;
    let orbit = softstop::orbit::find(&scene).map_err(|error| match error {
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
        Format::Text => report::text::orbit(&report),
    })
}

/// The machine of a scene file under the command line.
///
/// # Errors
/// [`Failure::Usage`] naming the file or the parameter.
pub fn machine(scene: Option<&PathBuf>, line: &SceneSettings) -> Result<Machine, Failure> {
    match scene {
        Some(path) => Machine::from_layers(&[line, &configuration::read(path)?]),
        None => Machine::from_layers(&[line]),
    }
}
