//! `softstop zone`: the hysteresis zone between grazing and fold.

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;

use softstop::{Dimension, Machine, Parameter};
use softstop_console::arguments::{MachineArguments, title};
use softstop_console::failure::Failure;
use softstop_console::output::{self, Format};
use softstop_console::report::{self, Stated};
use softstop_console::table::{heading, number, row, table};
use softstop_dynamics::zone::{Zone, ZoneError};

const EXAMPLES: &str = "\
Examples:
  softstop zone unloaded --set clearance=10
      the paper's Fig. 8: from g0 = 1.04444 to s_SN = 1.369036
  softstop zone --regime loaded --clearance 10 --stiffness 12 --format json
      with a stiffer stop, by the shorthands of the paper's machines, for programs
  softstop zone docs/scenes/kelvin-voigt.toml --set stop.stiffness=50
      any machine with any stop, in the units of its file

Between g0, where the motion without impacts just reaches the clearance (above resonance),
and the fold s_SN, where the z = 1 motion ends, both motions exist; the start decides which
one is seen. The drive frequency plays no part here.";

/// Arguments of `softstop zone`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ZoneArguments {
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
}

/// Finds both ends of the zone and prints them.
///
/// # Errors
/// [`Failure::Usage`] for values no machine can have, or none with a zone; [`Failure::Run`] if none is found.
pub fn run(arguments: &ZoneArguments) -> Result<(), Failure> {
    arguments.machine.refuse_start()?;
    let machine = arguments.machine.machine()?;
    let why = "the zone is a range of drive frequencies, whatever the machine's own";
    arguments
        .machine
        .refuse(&machine, Parameter::Frequency, why)?;
    let zone = softstop_dynamics::zone::hysteresis(&machine.scene);
    let zone = zone.map_err(|error| match error {
        ZoneError::NoGrazing { .. } => Failure::usage(error.to_string()),
        error => {
            let place = format!("no hysteresis zone found of {}", title(&machine));
            Failure::Run(anyhow!(error.stated(&machine)).context(place))
        }
    })?;
    let report = ZoneReport::new(&machine, &zone);
    output::print(&match arguments.format {
        Format::Json => output::json(&report)?,
        Format::Text => text(&machine, &report),
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
    pub machine: Stated,
}

impl ZoneReport {
    /// The zone of this machine.
    #[must_use]
    pub fn new(machine: &Machine, zone: &Zone) -> Self {
        let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
        Self {
            frequency_g0: own(zone.frequency_g0),
            frequency_sn: own(zone.frequency_sn),
            velocity_sn: zone.velocity_sn,
            machine: Stated::of(machine),
        }
    }
}

/// The zone, one quantity a line.
fn text(machine: &Machine, report: &ZoneReport) -> String {
    let frequency = |what| machine.label(what, "η", Dimension::Frequency);
    let velocity = machine.label(
        "before-impact velocity at the fold",
        "X'-",
        Dimension::Velocity,
    );
    let mut rows = report::machine(machine);
    rows.retain(|(label, _)| *label != machine.label_of(Parameter::Frequency));
    rows.extend([
        row(&frequency("grazing g0"), [number(report.frequency_g0)]),
        row(&frequency("fold s_SN"), [number(report.frequency_sn)]),
        row(&velocity, [number(report.velocity_sn)]),
    ]);
    heading("Hysteresis zone of the z = 1 motion") + &table(&rows)
}
