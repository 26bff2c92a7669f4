//! `softstop continue`: a periodic motion followed along a parameter, stable or not.

mod branches;
pub mod chart;
mod curves;
mod from_point;
mod report;
pub mod seed;
mod tables;

use std::path::PathBuf;

use clap::Args;
use nalgebra::Vector2;
use softstop::{Machine, Parameter};
use softstop_dynamics::{ParameterFamily, Regime};

use from_point::EarlierPoint;
pub(crate) use report::met;
use report::report;
use softstop_console::arguments::CommandArguments;
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::range;

const EXAMPLES: &str = "\
Examples:
  softstop continue --parameter frequency --from 0.9 --to 1.5
      the z = 1 motion of the paper's point A, both ways: it is born and dies in grazing (G),
      doubles its period at eta = 0.988907 (PD) and turns back at the fold s_SN = 1.369036 (SN)
  softstop continue --set eta=0.9875 --orbit 2/3 --parameter eta --from 0.95 --to 1.05
      the isolated z = 2/3 motion, found from scratch at eta = 0.9875
  softstop continue --parameter eta --from 0.9 --to 1.8 --second rho --second-from 2 --second-to 18
      besides, each special point as a curve in (eta, rho): regions of the z = 1 motion; --switch 1 adds
      the curves that begin in points of codimension two on these
  softstop continue --parameter clearance --from -1 --to 20 --double 4 docs/scenes/rigid.toml
      any machine in its own units; from each flip on to the orbits of twice the period, four times
  softstop continue --parameter k4 --from 1 --to 40 --state 6.9,9.5
      along the stop's stiffness, from an orbit near a state: an unstable one if that is nearest
  softstop continue --parameter eta --from 0.9 --to 1.5 --format json > eta.json
  softstop continue --from-point eta.json:PD --parameter rho --from 5 --to 15
      another parameter, from the flip of an earlier branch on

Words: SN fold, where two orbits meet and vanish; PD flip, where the period doubles; G grazing,
where an impact dies or a turning point reaches a surface; NS Neimark-Sacker, which damping
rules out; PF pitchfork, where motions between two equal stops cease to be symmetric. All are
located to 1e-10; where a touch comes or goes, multipliers may jump past 1 (SN) or -1 (PD).
On curves in two parameters: CP cusp, where two folds meet; GPD generalised flip, where a flip turns
from supercritical to subcritical (located to 1e-6); RG resonant grazing, where curves of folds and
flips end on one of grazing. --format json has the coefficients of the normal forms; a flip with a
positive one is supercritical. In the chart stable orbits are drawn solid, unstable ones
dashed; of an orbit with several impacts each has its line.

The parameter starts at the machine's own value, which must lie between --from and --to.";

/// Arguments of `softstop continue`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct ContinueArguments {
    /// Parameter to follow the motion along, by its key in the file, whose unit the values are in, such
    /// as excitation.frequency, excitation.frequency_hz or mass, or by its letter of ratios (eta, rho, k4);
    /// eta, the drive frequency in units of sqrt(k1/m), any machine has
    #[arg(long, value_name = "NAME")]
    pub parameter: String,
    /// Lowest value of the parameter
    #[arg(long, value_name = "VALUE")]
    pub from: f64,
    /// Highest value of the parameter
    #[arg(long, value_name = "VALUE")]
    pub to: f64,
    /// Motion to start from: p impacts in n drive periods, stable, found from scratch
    #[arg(long, value_name = "p/n", default_value = "1/1", value_parser = seed::regime)]
    pub orbit: Regime,
    /// Start from the orbit of n drive periods (--orbit p/n) nearest to this state at time 0,
    /// that is at drive angle phi, stable or not
    #[arg(long, value_name = "X,V", value_parser = seed::state, allow_hyphen_values = true)]
    pub state: Option<Vector2<f64>>,
    /// Start from a point of an earlier run, stable or not: FILE is its --format json, POINT a special point (SN, or PD2
    /// for the second PD; not PF) or a row of its branches.csv; the parameter of that run takes its value there
    #[arg(long, value_name = "FILE:POINT", value_parser = from_point::parse, conflicts_with_all = ["orbit", "state"])]
    pub from_point: Option<EarlierPoint>,
    /// Follow the orbits of twice the period from every flip on, and asymmetric ones from every pitchfork, so many times over
    #[arg(long, value_name = "TIMES", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=6))]
    pub double: u32,
    /// Second parameter: follow each special point but pitchforks, those of doubled branches too, as a curve in both; those that
    /// begin none are listed
    #[arg(long, value_name = "NAME", requires_all = ["second_from", "second_to"])]
    pub second: Option<String>,
    /// Lowest value of the second parameter
    #[arg(long, value_name = "VALUE", requires = "second")]
    pub second_from: Option<f64>,
    /// Highest value of the second parameter
    #[arg(long, value_name = "VALUE", requires = "second")]
    pub second_to: Option<f64>,
    /// Follow also the curves that begin in points of codimension two on these, so many times over: of grazing, folds and
    /// flips in resonant grazing, of folds of twice the period in a generalised flip
    #[arg(long, value_name = "TIMES", requires = "second", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=6))]
    pub switch: u32,
    /// Most points of a branch or curve in each direction
    #[arg(long, value_name = "COUNT", default_value_t = 10_000)]
    pub points: usize,
    /// Folder for branches.csv, branches.svg, curves.csv and curves.svg
    #[arg(long, value_name = "DIR", default_value = "softstop-continue")]
    pub output: PathBuf,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

const FILES: [(&str, &str); 4] = [
    ("branches_csv", "branches.csv"),
    ("branches_svg", "branches.svg"),
    ("curves_csv", "curves.csv"),
    ("curves_svg", "curves.svg"),
];

fn help() -> String {
    let curves = column::help("curves.csv", &tables::curve_columns());
    EXAMPLES.to_owned() + &column::help("branches.csv", &tables::branch_columns()) + &curves
}

/// Follows the motion and writes tables and charts.
pub fn run(arguments: &ContinueArguments) -> Result<(), Failure> {
    range::require(arguments.points > 0, "points", arguments.points, "> 0")?;
    let mut machine = arguments.common.machine_without_start()?;
    let mut start = (arguments.orbit.periods, arguments.state);
    if let Some(point) = &arguments.from_point {
        let (periods, state) = point.take(&mut machine)?;
        start = (periods, Some(state));
    }
    let followed =
        |flags, name, ends| FollowedParameter::new(arguments, &machine, flags, name, ends);
    let ends = (arguments.from, arguments.to);
    let first = followed(["parameter", ""], &arguments.parameter, ends)?;
    let ends = arguments.second_from.zip(arguments.second_to);
    let second = arguments.second.as_ref().zip(ends);
    let second = second
        .map(|(name, ends)| followed(["second", "second-"], name, ends))
        .transpose()?;
    if second
        .as_ref()
        .is_some_and(|it| it.parameter == first.parameter)
    {
        let name = machine.name(first.parameter);
        let message = format!("--second {name}: must be another one than --parameter");
        return Err(Failure::usage(message));
    }
    let files = &FILES[..if second.is_some() { 4 } else { 2 }];
    let export = Export::open(&arguments.output, files)?;
    let limit = arguments.common.limit.budget;
    let branches = limit.limit(|| branches::branches(arguments, &machine, &first, start))?;
    let chart = chart::branches(&machine, first.parameter, &branches);
    let rows = branches.iter().enumerate().flat_map(tables::branch_rows);
    export.sheet(
        ["branches_csv", "branches_svg"],
        &tables::branch_columns(),
        rows,
        &chart,
    )?;
    let mut curves = None;
    if let Some(second) = &second {
        let both = [&first, second];
        let found = limit.limit(|| curves::curves(&machine, arguments, both, &branches))?;
        let chart = chart::curves(&machine, both.map(|one| one.parameter), &found.found);
        let rows = found.found.iter().enumerate();
        let rows = rows.flat_map(tables::curve_rows);
        export.sheet(
            ["curves_csv", "curves_svg"],
            &tables::curve_columns(),
            rows,
            &chart,
        )?;
        curves = Some((second.parameter, found));
    }
    let report = report(&machine, first.parameter, &branches, curves.as_ref());
    let (result, text) = report.map_err(anyhow::Error::from)?;
    export.finish(&result, text, arguments.common.format)
}

/// A parameter that is followed, where it starts and how far it goes.
struct FollowedParameter {
    parameter: Parameter,
    start: f64,
    range: (f64, f64),
}

impl FollowedParameter {
    /// The one of this name; its flag and the beginning of the flags of its range.
    fn new(
        arguments: &ContinueArguments,
        machine: &Machine,
        [flag, prefix]: [&str; 2],
        name: &str,
        (from, to): (f64, f64),
    ) -> Result<Self, Failure> {
        let (parameter, unit) = arguments.common.machine.parameter(machine, flag, name)?;
        let own = machine.value(parameter).unwrap_or(f64::NAN);
        let start = own / unit;
        let (low, high) = (from.min(to), from.max(to));
        if low.is_finite() && high.is_finite() && low < high && (low..=high).contains(&start) {
            return Ok(Self {
                parameter,
                start: own,
                range: (low * unit, high * unit),
            });
        }
        Err(Failure::usage(format!(
            "--{prefix}from {from} --{prefix}to {to}: must be finite and enclose the machine's own {} = {start}",
            if unit == 1.0 {
                machine.name(parameter)
            } else {
                name
            },
        )))
    }
}

/// A machine along some of its parameters.
fn family<const N: usize>(
    machine: &Machine,
    parameters: [Parameter; N],
) -> Result<ParameterFamily<N>, Failure> {
    ParameterFamily::new(machine.clone(), parameters)
        .map_err(|error| Failure::usage(error.to_string()))
}
