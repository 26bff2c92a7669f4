//! `softstop continue`: a periodic motion followed along a parameter, stable or not.

mod branches;
pub mod chart;
mod curves;
pub mod report;
pub mod seed;
mod tables;

use std::path::PathBuf;

use clap::Args;
use nalgebra::Vector2;
use softstop_dynamics::continuation::{Along, Limits, Parameter};

use crate::continuation::chart::{BranchChart, CurveChart};
use report::ContinuationReport;
use seed::Wanted;
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::machine::{self, SceneSettings};
use softstop_console::model::{self, Model};
use softstop_console::output::Format;
use softstop_console::scene_file;

const EXAMPLES: &str = "\
Examples:
  softstop continue --parameter frequency --from 0.9 --to 1.5
      the z = 1 motion of the paper's point A, both ways: it is born and dies in grazing (G),
      doubles its period at eta = 0.988907 (PD) and turns back at the fold s_SN = 1.369036 (SN)
  softstop continue --frequency 0.9875 --orbit 2/3 --parameter eta --from 0.95 --to 1.05
      the isolated z = 2/3 motion, found from scratch at eta = 0.9875
  softstop continue --parameter eta --from 0.9 --to 1.8 --second rho --second-from 2 --second-to 18
      besides, each special point as a curve in (eta, rho): regions of the z = 1 motion
  softstop continue --parameter rho --from -1 --to 20 --double 4 docs/scenes/rigid.toml
      a scene in SI units; from each flip on to the orbits of twice the period, four times
  softstop continue --parameter k4 --from 1 --to 40 --state 6.9,9.5
      along the stop's stiffness, from an orbit near a state: an unstable one if that is nearest

Words: SN fold, where two orbits meet and vanish; PD flip, where the period doubles; G grazing,
where an impact dies or a turning point reaches a surface; NS Neimark-Sacker, which damping
rules out. All are located to 1e-10. In the chart stable orbits are drawn solid, unstable ones
dashed; of an orbit with several impacts each has its line.

The parameter starts at the machine's own value, which must lie between --from and --to.";

/// Arguments of `softstop continue`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct ContinueArguments {
    /// Scene in SI units as for `softstop simulate`, instead of the paper's machine
    #[arg(value_name = "SCENE.toml", conflicts_with = "scene")]
    pub file: Option<PathBuf>,
    /// Parameter to follow the motion along, by the name of its option or the paper's letter:
    /// frequency (eta), clearance (rho), stiffness (k4), preload (Fp), damping (beta1),
    /// contact_damping (beta), restitution (R), amplitude (F0), rigid_travel (epsilon), and of
    /// the strip k2, k3, sigma, nu
    #[arg(long, value_name = "NAME", value_parser = model::parameter)]
    pub parameter: Parameter,
    /// Lowest value of the parameter
    #[arg(long, value_name = "VALUE")]
    pub from: f64,
    /// Highest value of the parameter
    #[arg(long, value_name = "VALUE")]
    pub to: f64,
    /// Motion to start from: p impacts in n drive periods, stable, found from scratch
    #[arg(long, value_name = "p/n", default_value = "1/1")]
    pub orbit: Wanted,
    /// Start from the orbit of n drive periods (--orbit p/n) nearest to this state at drive angle
    /// 0, stable or not
    #[arg(long, value_name = "X,V", value_parser = seed::state)]
    pub state: Option<Vector2<f64>>,
    /// Follow the orbits of twice the period from every flip on, so many times over
    #[arg(long, value_name = "TIMES", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=6))]
    pub double: u32,
    /// Second parameter: follow each special point as a curve in both
    #[arg(long, value_name = "NAME", value_parser = model::parameter, requires_all = ["second_from", "second_to"])]
    pub second: Option<Parameter>,
    /// Lowest value of the second parameter
    #[arg(long, value_name = "VALUE", requires = "second")]
    pub second_from: Option<f64>,
    /// Highest value of the second parameter
    #[arg(long, value_name = "VALUE", requires = "second")]
    pub second_to: Option<f64>,
    /// Most points of a branch or curve in each direction
    #[arg(long, value_name = "COUNT", default_value_t = 2000)]
    pub points: usize,
    /// Folder for branches.csv, branches.svg, curves.csv and curves.svg
    #[arg(long, value_name = "DIR", default_value = "softstop-continue")]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Machine in a TOML file, by the names below; the command line has the last word
    #[arg(long, value_name = "FILE.toml")]
    pub scene: Option<PathBuf>,
    /// The machine.
    #[command(flatten)]
    pub machine: SceneSettings,
}

const FILES: [(&str, &str); 4] = [
    ("branches", "branches.csv"),
    ("branch_chart", "branches.svg"),
    ("curves", "curves.csv"),
    ("curve_chart", "curves.svg"),
];

fn help() -> String {
    let curves = column::help("curves.csv", &tables::curve_columns());
    EXAMPLES.to_owned() + &column::help("branches.csv", &tables::branch_columns()) + &curves
}

/// Follows the motion and writes tables and charts.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if there is no orbit to start from,
/// [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &ContinueArguments) -> Result<(), Failure> {
    let model = model(arguments)?;
    let family = family(&model, [arguments.parameter])?;
    let [start] = family.values();
    let range = range(
        arguments.parameter,
        start,
        (arguments.from, arguments.to),
        "",
    )?;
    let second = match (arguments.second, arguments.second_from, arguments.second_to) {
        (Some(parameter), Some(from), Some(to)) => {
            Some(second(arguments, &model, parameter, (from, to))?)
        }
        _ => None,
    };
    let files = if second.is_some() {
        &FILES[..]
    } else {
        &FILES[..2]
    };
    let export = Export::open(&arguments.output, files)?;
    let limits = Limits {
        range,
        points: arguments.points,
    };
    let branches = branches::branches(arguments, &model, &family, start, &limits)?;
    export.table(
        "branches",
        &tables::branch_columns(),
        tables::branch_rows(&branches),
    )?;
    let chart = BranchChart::new(arguments.parameter, &branches).svg();
    export.file("branch_chart", chart.as_bytes())?;
    let curves = match &second {
        Some(second) => {
            let curves = curves::curves(&model, arguments, second, range, &branches[0])?;
            export.table(
                "curves",
                &tables::curve_columns(),
                tables::curve_rows(&curves),
            )?;
            let parameters = [arguments.parameter, second.parameter];
            let chart = CurveChart::new(parameters, &curves).svg();
            export.file("curve_chart", chart.as_bytes())?;
            Some((second.parameter, curves))
        }
        None => None,
    };
    let report = ContinuationReport::new(arguments, &branches, curves.as_ref());
    export.finish(&report, arguments.format)
}

fn model(arguments: &ContinueArguments) -> Result<Model, Failure> {
    Ok(match &arguments.file {
        Some(path) => Model::Scene(Box::new(scene_file::read(path)?.scene)),
        None => Model::Paper(machine::machine(
            arguments.scene.as_ref(),
            &arguments.machine,
        )?),
    })
}

fn family<const N: usize>(
    model: &Model,
    parameters: [Parameter; N],
) -> Result<Along<Model, N>, Failure> {
    Along::new(model.clone(), parameters).map_err(|error| Failure::usage(error.to_string()))
}

/// The range of a parameter around its start.
fn range(
    parameter: Parameter,
    start: f64,
    (from, to): (f64, f64),
    option: &str,
) -> Result<(f64, f64), Failure> {
    if from.is_finite() && to.is_finite() && from < to && (from..=to).contains(&start) {
        return Ok((from, to));
    }
    Err(Failure::usage(format!(
        "--{option}from {from} --{option}to {to}: must be finite and enclose the machine's own {} = {start}",
        parameter.name()
    )))
}

/// The second parameter, its start and its range.
struct Second {
    parameter: Parameter,
    start: f64,
    range: (f64, f64),
}

fn second(
    arguments: &ContinueArguments,
    model: &Model,
    parameter: Parameter,
    ends: (f64, f64),
) -> Result<Second, Failure> {
    if parameter == arguments.parameter {
        return Err(Failure::usage(format!(
            "--second {}: must be another one than --parameter",
            parameter.name()
        )));
    }
    let [start] = family(model, [parameter])?.values();
    Ok(Second {
        parameter,
        start,
        range: range(parameter, start, ends, "second-")?,
    })
}
