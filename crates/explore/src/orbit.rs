//! `softstop orbit`: the stable motion with one impact per drive period.

use anyhow::anyhow;
use clap::Args;
use softstop_dynamics::orbit::OrbitError;
use softstop_dynamics::zone::find_with_monitor;

use softstop::Parameter;
use softstop_console::arguments::{CommandArguments, WITHOUT_STOP, has_stop};
use softstop_console::column::Units;
use softstop_console::export;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::record::Record;
use softstop_console::report;
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

Position and velocity are those at time 0, that is at drive angle phi (excitation.phase), and
whole periods later. The motion is stable if both Floquet multipliers lie inside the unit circle,
and neutral if they lie on it, as they do without any damping.";

/// Arguments of `softstop orbit`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct OrbitArguments {
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// Finds the orbit and prints it.
pub fn run(arguments: &OrbitArguments) -> Result<(), Failure> {
    let machine = arguments.common.machine_without_start()?;
    let find = || Ok(find_with_monitor(&machine.scene, &interrupt::watch));
    let orbit = arguments
        .common
        .limit
        .budget
        .limit(find)?
        .map_err(|error| match error {
            OrbitError::NotFound { .. } if !has_stop(&machine.scene) => anyhow!(WITHOUT_STOP),
            OrbitError::NotFound { clearance, .. } => anyhow!(
                "no stable z = 1 motion found at {} = {}, clearance = {clearance}",
                machine.name(Parameter::Frequency),
                machine.value(Parameter::Frequency).unwrap_or(f64::NAN),
            ),
            other => other.into(),
        })?;
    let (stability, title) = match orbit.monodromy.is_neutral() {
        true => ("neutral", "Neutral motion"),
        false => ("stable", "Stable motion"),
    };
    let motion = report::motion(&machine, &orbit);
    let figures = report::machine(&machine, &[]).and(motion.clone());
    let text = heading(&format!("{title} with one impact per drive period (z = 1)"))
        + &figures.text(&Units::of(&machine));
    let result = Record::default().hidden("stability", stability);
    let result = result.and(motion).and(report::stated(&machine));
    export::print(&result, text, arguments.common.format)
}
