//! `softstop-lab chart precision`: what each method's accuracy costs on a scene.
//!
//! [`case`] says what is computed, [`truth`] what comes of it in truth, [`family`] by which methods it is
//! computed; [`measure`] runs them and [`errors`] compares; `lead` and `report` say what came of it.

pub mod case;
mod chart;
pub(crate) mod computer;
pub mod errors;
pub mod family;
mod lead;
pub mod measure;
mod report;
pub mod truth;

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::filter::filter;
use case::Case;
use computer::Computer;
use errors::Scale;
use family::Family;
use measure::{Bench, Effort, Row};
use report::{SceneMeasurement, text};
use softstop_console::export;
use softstop_console::failure::Failure;
use softstop_console::output::{self, Folder, Format};
use softstop_console::progress::Progress;
use softstop_console::range::{require, within};
use softstop_console::record::Record;
use truth::Truth;

const EXAMPLES: &str = "\
Examples:
  softstop-lab chart precision periodic
      the paper's machine at point A over 200 drive periods, all methods
  softstop-lab chart precision machine.toml --periods 50
      your own machine (the file is that of `softstop simulate`)
  softstop-lab chart precision stiff --method rk4 --method bdf --budget 5
      some methods, with time for finer settings
  softstop-lab chart precision all --output docs/accuracy
      the charts of docs/accuracy.md, and the lead of the exact method as a table

Every method runs with its knob (step or tolerance) turned from coarse to fine. Errors are those
against a stored reference in 67 digits (for a Hertz stop, a machine of your own or another number
of periods, two methods that agree): of the state at the end, of the times of impacts and of their
velocities, all relative to the motion's size, and impacts missed or invented. Times are medians of repeated runs. SCENE.svg draws time and force
evaluations over errors; a method is the better the further to the lower left it is; a hollow
circle is a run with a wrong number of impacts. SCENE.csv has one row per run, SCENE.json adds
machine, reference and lead. The files are written whole or not at all. docs/accuracy.md
explains them.";

/// Arguments of `softstop-lab chart precision`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub struct PrecisionArguments {
    /// A built-in scene (periodic, chaotic, stiff, chatter, hertz, grazing, sticking, loaded), `all` of
    /// them, or a machine in a TOML file, SI units
    #[arg(value_name = "SCENE")]
    pub scene: String,
    /// Drive periods to run, above 0 to 100000 [default: that of a built-in scene, 20 for a file]
    #[arg(long, value_name = "N")]
    pub periods: Option<f64>,
    /// Longest run of a method in s, 0.001 to 3600: finer settings are left out
    #[arg(long, value_name = "SECONDS", default_value_t = 0.5)]
    pub budget: f64,
    /// Only methods with this in their name; the exact one always runs. May be given several times
    #[arg(long, value_name = "NAME")]
    pub method: Vec<String>,
    /// Every other setting, fewer repetitions and a tenth of the budget
    #[arg(long)]
    pub quick: bool,
    /// Draw small pictures without titles
    #[arg(long)]
    pub small: bool,
    /// Folder for SCENE.svg, SCENE.csv and SCENE.json
    #[arg(long, value_name = "DIR", default_value = "softstop-precision")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// Measures the methods, draws the charts and says who leads.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if there is no reference or the
/// folder cannot be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &PrecisionArguments) -> Result<(), Failure> {
    check(arguments)?;
    let cases = case::cases(&arguments.scene, arguments.periods)?;
    let families = cases.iter().map(|case| chosen(case, arguments));
    let families: Vec<Vec<Family>> = families.collect::<Result<_, _>>()?;
    let names: Vec<String> = cases.iter().flat_map(|case| files(&case.name)).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let folder = Folder::open(&arguments.output, &names)?;
    let machine = Computer::this();
    let settings = families.iter().flatten().map(|it| it.settings.len());
    let runs = cases.len() + settings.sum::<usize>();
    let progress = Progress::new(runs as u64, "settings");
    let (mut scenes, mut charts) = (Vec::new(), Vec::new());
    for (case, families) in cases.iter().zip(&families) {
        let measured = measure_methods(case, families, arguments, &folder, &progress)?;
        let mut chart = chart::chart(&measured, families.iter().map(|it| it.look));
        if arguments.small {
            chart = chart.small();
        }
        let record = measured.record(&machine);
        let [svg, csv, json] = files(&case.name);
        folder.stage(&svg, chart.svg().as_bytes())?;
        folder.stage(&csv, &output::csv(&measured.rows)?)?;
        folder.stage(&json, output::json(&record)?.as_bytes())?;
        charts.push(record);
        scenes.push(measured);
    }
    drop(progress);
    folder.commit(&names)?;
    let result = Record::default().hidden("machine", json!(machine));
    let result = result.hidden("charts", charts);
    export::print(&result, text(&scenes, &machine), arguments.format)
}

fn check(arguments: &PrecisionArguments) -> Result<(), Failure> {
    let periods = arguments.periods.unwrap_or(case::PERIODS);
    let good = periods > 0.0 && periods <= 1e5;
    require(good, "periods", periods, "above 0 to 100000")?;
    within("budget", arguments.budget, 1e-3..=3600.0)
}

/// The methods that the user wants, the exact one first.
fn chosen(case: &Case, arguments: &PrecisionArguments) -> Result<Vec<Family>, Failure> {
    let all = family::all(&case.machine.scene, arguments.quick);
    let names: Vec<String> = all.iter().map(|family| family.name.clone()).collect();
    let is_wanted = filter(&arguments.method, &names)?;
    let is_chosen = |(index, family): &(usize, Family)| *index == 0 || is_wanted(&family.name);
    let chosen = all.into_iter().enumerate().filter(is_chosen);
    Ok(chosen.map(|(_, family)| family).collect())
}

/// The kinds of files of a scene.
const KINDS: [&str; 3] = ["svg", "csv", "json"];

/// The files of a scene.
fn files(name: &str) -> [String; 3] {
    KINDS.map(|kind| format!("{name}.{kind}"))
}

fn measure_methods<'a>(
    case: &'a Case,
    families: &[Family],
    arguments: &PrecisionArguments,
    folder: &Folder,
    progress: &Progress,
) -> Result<SceneMeasurement<'a>, Failure> {
    let name = &case.name;
    let task = &case.task();
    let scale = Scale::of(task)?;
    progress.say(&format!("{name}: reference"));
    let truth = Truth::of(task, &scale, case.stored(None))?;
    progress.more(1);
    let (share, repeat, most) = match arguments.quick {
        true => (0.1, 0.01, 5),
        false => (1.0, 0.2, 101),
    };
    let longest = share * arguments.budget;
    let bench = Bench {
        task,
        truth: &truth,
        scale,
        effort: Effort {
            longest,
            repeat,
            most,
        },
    };
    let mut rows: Vec<Row> = Vec::new();
    for family in families {
        progress.say(&format!("{name}: {}", family.name));
        rows.extend(bench.family(family, &|| progress.more(1))?);
    }
    let exact = rows.first().map_or("", |row| row.method.as_str());
    let places = files(name).map(|name| folder.place(&name).display().to_string());
    Ok(SceneMeasurement {
        case,
        leads: lead::leads(&rows, exact),
        truth,
        scale,
        rows,
        files: KINDS.into_iter().zip(places).collect(),
    })
}
