//! `softstop zone`: the hysteresis zone between grazing and fold.

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;

use softstop::{Dimension, Machine, Parameter};
use softstop_console::arguments::{MachineArguments, title};
use softstop_console::column::{Column, Units};
use softstop_console::columns;
use softstop_console::export::{self, Report};
use softstop_console::failure::Failure;
use softstop_console::output::Format;
use softstop_console::record::Record;
use softstop_console::report::{self, Stated};
use softstop_console::table::heading;
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
    let report = ZoneReport {
        zone: Record::of(&columns(), &(&machine, &zone)),
        stated: Stated::of(&machine),
        machine: &machine,
    };
    export::print(&report, arguments.format)
}

/// What `softstop zone` reports.
#[derive(Debug, Serialize)]
struct ZoneReport<'a> {
    #[serde(flatten)]
    zone: Record,
    #[serde(flatten)]
    stated: Stated,
    #[serde(skip)]
    machine: &'a Machine,
}

fn columns<'a>() -> [Column<(&'a Machine, &'a Zone)>; 3] {
    columns! { (&'a Machine, &'a Zone), it;
        "frequency_g0" [Frequency] Six, "grazing g0" => it.0.to_own(Dimension::Frequency, it.1.frequency_g0);
        "frequency_sn" [Frequency] Six, "fold s_SN" => it.0.to_own(Dimension::Frequency, it.1.frequency_sn);
        "velocity_sn" [Velocity] Six, "before-impact velocity at the fold" => it.1.velocity_sn;
    }
}

impl Report for ZoneReport<'_> {
    fn text(&self) -> String {
        let machine = report::machine(self.machine, &[Parameter::Frequency]);
        heading("Hysteresis zone of the z = 1 motion")
            + &machine
                .and(self.zone.clone())
                .text(&Units::of(self.machine))
    }
}
