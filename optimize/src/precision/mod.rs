//! `softstop chart precision`: what each method's accuracy costs on a scene.

pub mod case;

use std::path::PathBuf;

use clap::Args;

use crate::arguments::require;
use crate::failure::Failure;
use crate::output::Format;

/// Arguments of `softstop chart precision`.
#[derive(Debug, Args)]
pub struct PrecisionArguments {
    /// A built-in scene (periodic, chaotic, stiff, chatter, hertz, grazing, sticking, loaded), `all` of
    /// them, or a machine in a TOML file, SI units
    #[arg(value_name = "SCENE")]
    pub scene: String,
    /// Drive periods to run, above 0 to 100000 [default: that of a built-in scene, 20 for a file]
    #[arg(long, value_name = "N")]
    pub periods: Option<f64>,
    /// Time in s that each method may take, 0.001 to 3600
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0)]
    pub budget: f64,
    /// Only methods whose name contains one of these, separated by commas; the exact one always runs
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub methods: Vec<String>,
    /// Fewer settings and repetitions, a tenth of the budget
    #[arg(long)]
    pub quick: bool,
    /// Folder for SCENE.svg, SCENE.csv and SCENE.json
    #[arg(long, value_name = "DIR", default_value = "softstop-precision")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// Measures the methods, draws the chart and says who leads.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if there is no reference or the
/// folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &PrecisionArguments) -> Result<(), Failure> {
    check(arguments)?;
    case::cases(&arguments.scene, arguments.periods)?;
    Ok(())
}

fn check(arguments: &PrecisionArguments) -> Result<(), Failure> {
    let periods = arguments.periods.unwrap_or(case::PERIODS);
    let good = periods > 0.0 && periods <= 1e5;
    require(good, "periods", periods, "above 0 to 100000")?;
    let budget = arguments.budget;
    require(
        (1e-3..=3600.0).contains(&budget),
        "budget",
        budget,
        "0.001 to 3600",
    )
}
