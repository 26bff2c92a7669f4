//! `softstop zone`: the hysteresis zone between grazing and fold.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use serde::Serialize;

use softstop_console::failure::Failure;
use softstop_console::machine::{self, Machine, SceneSettings};
use softstop_console::output::{self, Format};
use softstop_console::report::{self, MachineReport};
use softstop_console::table::{heading, number, row, table};
use softstop_dynamics::zone::Zone;

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
    let machine = machine::machine(arguments.scene.as_ref(), &arguments.machine)?;
    let ratios = &machine.ratios;
    let scene = ratios.scene();
    let scene = scene.map_err(|error| Failure::usage(error.to_string()))?;
    let zone = softstop_dynamics::zone::hysteresis(&scene).with_context(|| {
        let (k4, rho) = (ratios.stiffness, ratios.clearance);
        format!("no hysteresis zone found at stiffness = {k4}, clearance = {rho}")
    })?;
    let report = ZoneReport::new(&machine, &zone);
    output::print(&match arguments.format {
        Format::Json => output::json(&report)?,
        Format::Text => text(&report),
    })
}

/// What `softstop zone` reports.
#[derive(Debug, Clone, Serialize)]
pub struct ZoneReport {
    /// Grazing of the motion without impacts, above resonance.
    pub frequency_g0: f64,
    /// The fold of the z = 1 motion.
    pub frequency_sn: f64,
    /// Before-impact velocity at the fold.
    pub velocity_sn: f64,
    /// The machine.
    #[serde(flatten)]
    pub machine: MachineReport,
}

impl ZoneReport {
    /// The zone of this machine.
    #[must_use]
    pub fn new(machine: &Machine, zone: &Zone) -> Self {
        Self {
            frequency_g0: zone.frequency_g0,
            frequency_sn: zone.frequency_sn,
            velocity_sn: zone.velocity_sn,
            machine: MachineReport::new(machine.regime, &machine.ratios),
        }
    }
}

/// The zone, one quantity a line.
fn text(report: &ZoneReport) -> String {
    let mut rows = report::machine(&report.machine);
    rows.push(row("grazing frequency g0", [number(report.frequency_g0)]));
    rows.push(row("fold frequency s_SN", [number(report.frequency_sn)]));
    rows.push(row(
        "velocity X'- at the fold",
        [number(report.velocity_sn)],
    ));
    heading("Hysteresis zone of the z = 1 motion") + &table(&rows)
}
