//! `softstop-lab chart failures`: where methods with a fixed step fail, and how.

mod atlas;
mod family;
mod heat;
mod page;
mod report;
mod view;

pub use atlas::{Atlas, Axes, Cell, Column, Map};
pub use family::Family;
pub use view::View;

use std::path::PathBuf;

use clap::Args;

use crate::filter::Filter;
use report::FailuresReport;
use softstop_console::failure::Failure;
use softstop_console::output::{self, Folder, Format};
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
impact count, missed contact, energy gain, blow-up, stuck. docs/failures.md explains them.

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
    /// Folder for the pages, failures.csv and failures.json
    #[arg(long, value_name = "DIR", default_value = "softstop-failures")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

const TABLE: &str = "failures.csv";
const MAPS: &str = "failures.json";

/// Runs the atlas, draws it and says what came out.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if a true motion cannot be computed or the
/// folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &FailuresArguments) -> Result<(), Failure> {
    check(arguments)?;
    let views = views(arguments)?;
    let families = families(&arguments.method)?;
    let pages: Vec<String> = views
        .iter()
        .map(|view| format!("{}.svg", view.name))
        .collect();
    let mut names: Vec<&str> = pages.iter().map(String::as_str).collect();
    names.extend([TABLE, MAPS]);
    let folder = Folder::open(&arguments.output, &names)?;
    let atlases = atlases(arguments, views, &families)?;
    for (atlas, page) in atlases.iter().zip(&pages) {
        folder.stage(page, page::page(atlas).as_bytes())?;
    }
    folder.stage(TABLE, &report::table(&atlases)?)?;
    let report = FailuresReport::new(&atlases, &names, &folder);
    let json = output::json(&report)?;
    folder.stage(MAPS, json.as_bytes())?;
    folder.commit(&names)?;
    output::print(&match arguments.format {
        Format::Json => json,
        Format::Text => report.text(),
    })
}

/// All pages of the atlas.
fn atlases(
    arguments: &FailuresArguments,
    views: Vec<View>,
    families: &[Family],
) -> Result<Vec<Atlas>, Failure> {
    let axes = Axes::new(arguments.points);
    let columns = views.len() * axes.stiffness.len();
    let runs = columns * (1 + families.len() * axes.step.len());
    let progress = Progress::new(runs as u64, "runs");
    views
        .into_iter()
        .map(|view| {
            let axes = axes.clone();
            Atlas::new(view, axes, families, arguments.tolerance, &progress)
        })
        .collect()
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

fn views(arguments: &FailuresArguments) -> Result<Vec<View>, Failure> {
    let mut views = if arguments.scene.is_empty() {
        View::built_in()?
    } else {
        let find = |place: &String| View::find(place);
        arguments.scene.iter().map(find).collect::<Result<_, _>>()?
    };
    if let Some(periods) = arguments.periods {
        views
            .iter_mut()
            .for_each(|view: &mut View| view.periods = periods);
    }
    for (index, view) in views.iter().enumerate() {
        if views[..index].iter().any(|other| other.name == view.name) {
            return Err(Failure::usage(format!(
                "scene = {}: must be given once, its files go by that name",
                view.name
            )));
        }
    }
    Ok(views)
}

fn families(words: &[String]) -> Result<Vec<Family>, Failure> {
    let all = Family::all();
    let names: Vec<String> = all.iter().map(Family::name).collect();
    let filter = Filter::new(words, &names)?;
    let wanted = |family: &Family| filter.wants(&family.name());
    Ok(all.into_iter().filter(wanted).collect())
}
