//! `softstop zone`: the hysteresis zone between grazing and fold.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;

use crate::arguments::SceneSettings;
use crate::failure::Failure;
use crate::orbit;
use crate::output::{self, Format};
use crate::report::{self, ZoneReport};

const EXAMPLES: &str = "\
Examples:
  softstop zone --regime unloaded --clearance 10
      the paper's Fig. 8: from g0 = 1.04444 to s_SN = 1.369036
  softstop zone --regime loaded --clearance 10 --stiffness 12 --format json
      with a stiffer stop, for programs

Between g0, where the motion without impacts just reaches the clearance (above resonance),
and the fold s_SN, where the z = 1 motion ends, both motions exist; the start decides which
one is seen. The drive frequency plays no part here.";

/// Arguments of `softstop zone`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ZoneArguments {
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

/// Finds both ends of the zone and prints them.
///
/// # Errors
/// [`Failure::Usage`] for values no machine can have, [`Failure::Run`] if there is no zone.
pub fn run(arguments: &ZoneArguments) -> Result<(), Failure> {
    let machine = orbit::machine(arguments.scene.as_ref(), &arguments.machine)?;
    let ratios = &machine.ratios;
    let zone = softstop::zone::hysteresis(ratios).with_context(|| {
        let (k4, rho) = (ratios.stiffness, ratios.clearance);
        format!("no hysteresis zone found at stiffness = {k4}, clearance = {rho}")
    })?;
    let report = ZoneReport::new(&machine, &zone);
    output::print(&match arguments.format {
        Format::Json => output::json(&report)?,
        Format::Text => report::text::zone(&report),
    })
}
