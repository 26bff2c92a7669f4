//! `softstop-lab chart failures`: where methods with a fixed step fail, and how.

mod atlas;
mod chart;
mod machines;
mod report;
mod stepped_method;

pub use atlas::{Atlas, Axes, Cell, Map, StiffnessCase};
pub use machines::{built_in, find};
pub use stepped_method::SteppedMethod;

use std::path::PathBuf;

use clap::Args;

use crate::filter::filter;
use crate::scenes::Case;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::Format;
use softstop_console::progress::Progress;
use softstop_console::range::{require, within};

const EXAMPLES: &str = "\
Examples:
  softstop-lab chart failures
      the whole atlas: five machines, every method, about a minute
  softstop-lab chart failures --scene bounce --method RK4
      one machine; every method with RK4 in its name
  softstop-lab chart failures --scene docs/scenes/kelvin-voigt.toml --periods 2 --points 25
      any machine with a stop that has a stiffness; its own stiffness is replaced
  softstop-lab chart failures --tolerance 1e-6 --format json
      a stricter judge; the result for programs

Machines of the atlas: pressed (stability), bounce (energy), graze (short contacts), chatter
(endlessly many events), driven (the paper's machine). Each is run with stops of 1 to 1e8 N/m and
steps of 1e-5 to 0.3 drive periods, and each run is put in a class: converged, inaccurate, wrong
impact count, missed contact, energy gain, blow-up, stuck. docs/methods.md explains them.

Files, whole or not at all: a page NAME.svg for each machine, failures.csv with a row for each
run, failures.json with the maps and the limits that theory sets.";

/// Arguments of `softstop-lab chart failures`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub struct FailuresArguments {
    /// Machine: pressed, bounce, graze, chatter, driven, or a TOML file; its stop's stiffness is
    /// swept. May be given several times [default: the five]
    #[arg(long, value_name = "SCENE")]
    pub scene: Vec<String>,
    /// Only methods with this in their name. May be given several times
    #[arg(long, value_name = "NAME")]
    pub method: Vec<String>,
    /// Drive periods to run, > 0, at most 100 [default: the scene's own; 3 for a file]
    #[arg(long, value_name = "N")]
    pub periods: Option<f64>,
    /// Points on each axis, 2 to 200
    #[arg(long, value_name = "N", default_value_t = 29)]
    pub points: usize,
    /// Error at the end over the motion's size up to which a run has converged, > 0 and < 1
    #[arg(long, value_name = "SHARE", default_value_t = 0.01)]
    pub tolerance: f64,
    /// Draw small pictures without titles
    #[arg(long)]
    pub small: bool,
    /// Folder for the pages, failures.csv and failures.json
    #[arg(long, value_name = "DIR", default_value = "softstop-failures")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// Runs the atlas, draws it and says what came out.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if a true motion cannot be computed or the
/// folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &FailuresArguments) -> Result<(), Failure> {
    check(arguments)?;
    let cases = cases(arguments)?;
    let families = families(&arguments.method)?;
    let files = [("csv", "failures.csv"), ("json", "failures.json")];
    let mut export = Export::open(&arguments.output, &files)?;
    export.refuse_folders_called(".svg")?;
    let axes = Axes::new(arguments.points);
    let columns = cases.len() * axes.stiffness.len();
    let runs = columns * (1 + families.len() * axes.step.len());
    let progress = Progress::new(runs as u64, "runs");
    let mut atlases = Vec::new();
    for case in cases {
        let axes = axes.clone();
        let atlas = Atlas::new(case, axes, &families, arguments.tolerance, &progress)?;
        let mut chart = chart::chart(&atlas);
        if arguments.small {
            chart = chart.small();
        }
        export.picture(&atlas.case.name, &chart.svg())?;
        atlases.push(atlas);
    }
    drop(progress);
    export.table("csv", &report::table(), report::runs(&atlases))?;
    let text = atlases.iter().map(report::text).collect();
    export.finish(&report::record(&atlases), text, arguments.format)
}

fn check(arguments: &FailuresArguments) -> Result<(), Failure> {
    within("points", arguments.points, 2..=200)?;
    let tolerance = arguments.tolerance;
    let fits = tolerance > 0.0 && tolerance < 1.0;
    require(fits, "tolerance", tolerance, "> 0 and < 1")?;
    let periods = arguments.periods.unwrap_or(1.0);
    let fits = periods > 0.0 && periods <= 100.0;
    require(fits, "periods", periods, "> 0 and at most 100")
}

fn cases(arguments: &FailuresArguments) -> Result<Vec<Case>, Failure> {
    let mut cases = match &arguments.scene[..] {
        [] => built_in()?,
        places => places.iter().map(|it| find(it)).collect::<Result<_, _>>()?,
    };
    for case in &mut cases {
        case.periods = arguments.periods.unwrap_or(case.periods);
    }
    for (index, case) in cases.iter().enumerate() {
        if cases[..index].iter().any(|other| other.name == case.name) {
            return Err(Failure::usage(format!(
                "scene = {}: must be given once, its files go by that name",
                case.name
            )));
        }
    }
    Ok(cases)
}

fn families(words: &[String]) -> Result<Vec<SteppedMethod>, Failure> {
    let all = SteppedMethod::all();
    let names: Vec<String> = all.iter().map(SteppedMethod::name).collect();
    let is_wanted = filter(words, &names)?;
    let wanted = |family: &SteppedMethod| is_wanted(&family.name());
    Ok(all.into_iter().filter(wanted).collect())
}
