//! `softstop orbit`: the stable motion with one impact per drive period.

use anyhow::anyhow;
use clap::Args;
use serde::Serialize;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::find_with_monitor;

use softstop::{Machine, Parameter, Scene, Stop};
use softstop_console::arguments::MachineArguments;
use softstop_console::budget::BudgetArguments;
use softstop_console::column::Units;
use softstop_console::export::{self, Report};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::output::Format;
use softstop_console::record::Record;
use softstop_console::report::{self, Stated};
use softstop_console::table::heading;

const EXAMPLES: &str = "\
Examples:
  softstop orbit unloaded --set frequency=1.15 --set clearance=10
      the paper's point A: before-impact velocity 6.494627
  softstop orbit loaded --set eta=1.15 --set clearance=10 --format json
      its point B, for programs
  softstop orbit docs/scenes/kelvin-voigt.toml --set excitation.frequency=1.1
      any machine with any stop, in the units of its file
  softstop orbit machine.toml --set eta=1.2
      with machine.toml holding a machine in the paper's ratios, in a table [ratios] (softstop schema)

It is the motion with the hardest impact, of those on all stretches that `softstop zone` lists
and of those that a search at this frequency finds.

Position and velocity are those at drive angle 0 (a multiple of the drive's period). The
motion is stable if both Floquet multipliers lie inside the unit circle, and neutral if they lie on it,
as they do without any damping.";

/// Arguments of `softstop orbit`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct OrbitArguments {
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// The machine.
    #[command(flatten)]
    pub machine: MachineArguments,
    /// What it may cost.
    #[command(flatten)]
    pub limit: BudgetArguments,
}

/// Finds the orbit and prints it.
pub fn run(arguments: &OrbitArguments) -> Result<(), Failure> {
    arguments.machine.refuse_start()?;
    let machine = arguments.machine.machine()?;
    let find = || Ok(find_with_monitor(&machine.scene, &interrupt::watch));
    let orbit = arguments
        .limit
        .budget
        .limit(find)?
        .map_err(|error| match error {
            OrbitError::NotFound { .. } if is_free(&machine.scene) => {
                anyhow!("stop.model = \"none\": the machine has no stop, so no motion of it has an impact")
            }
            OrbitError::NotFound { clearance, .. } => anyhow!(
                "no stable z = 1 motion found at {} = {}, clearance = {clearance}",
                machine.name(Parameter::Frequency),
                machine.value(Parameter::Frequency).unwrap_or(f64::NAN),
            ),
            other => other.into(),
        })?;
    let report = OrbitReport {
        stability: if orbit.is_neutral() {
            "neutral"
        } else {
            "stable"
        },
        motion: report::motion(&machine, &orbit),
        stated: Stated::of(&machine),
        machine: &machine,
    };
    export::print(&report, arguments.format)
}

/// True if nothing stands in the way of the mass.
fn is_free(scene: &Scene) -> bool {
    scene.stop == Stop::None && scene.piercing.is_none() && scene.wall().is_none()
}

/// What `softstop orbit` reports.
#[derive(Debug, Serialize)]
struct OrbitReport<'a> {
    stability: &'static str,
    #[serde(flatten)]
    motion: Record,
    #[serde(flatten)]
    stated: Stated,
    #[serde(skip)]
    machine: &'a Machine,
}

impl Report for OrbitReport<'_> {
    fn text(&self) -> String {
        let figures = report::machine(self.machine, &[]).and(self.motion.clone());
        let title = match self.stability {
            "neutral" => "Neutral motion",
            _ => "Stable motion",
        };
        heading(&format!("{title} with one impact per drive period (z = 1)"))
            + &figures.text(&Units::of(self.machine))
    }
}
