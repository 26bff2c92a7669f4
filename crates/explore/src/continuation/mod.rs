//! `softstop continue`: a periodic motion followed along a parameter, stable or not.

pub mod chart;
pub mod report;
pub mod seed;
mod text;

use std::ops::ControlFlow;
use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use nalgebra::Vector2;
use softstop_dynamics::continuation::{
    Adjustable, Along, Branch, Curve, Family, Follower, Limits, Parameter, Region, SpecialKind,
    Test, curve,
};

use crate::continuation::chart::{BranchChart, CurveChart};
use report::{BranchReport, ContinuationReport, CurveReport, CurvesReport};
use seed::Wanted;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::machine::{self, SceneSettings};
use softstop_console::model::{self, Model};
use softstop_console::output::{self, Folder, Format};
use softstop_console::progress::Progress;
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
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
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

/// Largest steps along branches and curves, scaled: fine enough for charts of wide ranges.
const STEP: f64 = 0.02;
/// Steps of a narrow range, and the least share of `STEP` that they are.
const NARROW: (f64, f64) = (100.0, 0.1);

/// Largest step of a range, so that its chart has no corners.
fn step(family: &Along<Model, 1>, (low, high): (f64, f64)) -> f64 {
    let [scale] = family.parameter_scales();
    let (steps, least) = NARROW;
    ((high - low) / (steps * scale)).clamp(least * STEP, STEP)
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
    let names: &[&str] = if second.is_some() {
        &["branches.csv", "branches.svg", "curves.csv", "curves.svg"]
    } else {
        &["branches.csv", "branches.svg"]
    };
    let folder = Folder::open(&arguments.output, names)?;
    let limits = Limits {
        range,
        points: arguments.points,
    };
    let branches = branches(arguments, &model, &family, start, &limits)?;
    write_branches(&folder, arguments.parameter, &branches)?;
    let curves = match second {
        Some(second) => Some(curves(
            &model,
            arguments,
            &second,
            range,
            &branches[0],
            &folder,
        )?),
        None => None,
    };
    let report = ContinuationReport {
        parameter: arguments.parameter.name(),
        branches: branches.iter().map(BranchReport::new).collect(),
        curves,
        files: names
            .iter()
            .map(|name| folder.place(name).display().to_string())
            .collect(),
    };
    folder.commit(names)?;
    output::print(&match arguments.format {
        Format::Json => output::json(&report)?,
        Format::Text => text::text(&report),
    })
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

/// Counts a point; asks to stop after Ctrl-C.
fn count(bar: &Progress) -> ControlFlow<()> {
    match bar.step() {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    }
}

/// The branch of the start, and doubled ones.
fn branches(
    arguments: &ContinueArguments,
    model: &Model,
    family: &Along<Model, 1>,
    start: f64,
    limits: &Limits,
) -> Result<Vec<Branch>, Failure> {
    let scene = model
        .scene()
        .map_err(|error| Failure::usage(error.to_string()))?;
    let state = match arguments.state {
        Some(state) => state,
        None => seed::find(&scene, arguments.orbit)?.state(),
    };
    let bar = Progress::open("points");
    let largest = step(family, limits.range);
    let follower = Follower::new(family, arguments.orbit.periods).with_steps(largest);
    let first = follower
        .branch(start, state, limits, |_| count(&bar))
        .map_err(|error| anyhow!(error).context("no orbit to start from"))?;
    let mut branches = vec![first];
    let mut done = 0;
    for _ in 0..arguments.double {
        let last = branches.len();
        let doubled: Vec<Branch> = branches[done..last]
            .iter()
            .flat_map(|branch| doubled(family, branch, limits, &bar))
            .collect();
        branches.extend(doubled);
        done = last;
    }
    drop(bar);
    if interrupt::requested() {
        return Err(Failure::Interrupted);
    }
    Ok(branches)
}

/// The branches of twice the period from the flips of one.
fn doubled(
    family: &Along<Model, 1>,
    branch: &Branch,
    limits: &Limits,
    bar: &Progress,
) -> Vec<Branch> {
    let follower = Follower::new(family, branch.periods).with_steps(step(family, limits.range));
    let flips = branch
        .specials
        .iter()
        .filter(|special| special.kind == SpecialKind::Critical(Test::Flip));
    flips
        .filter_map(|flip| follower.doubled(&flip.point, limits, |_| count(bar)).ok())
        .collect()
}

fn write_branches(
    folder: &Folder,
    parameter: Parameter,
    branches: &[Branch],
) -> Result<(), Failure> {
    let mut table = folder.create("branches.csv")?;
    table.header(&report::BRANCH_COLUMNS)?;
    for (number, branch) in branches.iter().enumerate() {
        for row in report::branch_rows(number, branch) {
            table.row(&row)?;
        }
    }
    table.close()?;
    let chart = BranchChart::new(parameter, branches).svg();
    folder.stage("branches.svg", chart.as_bytes())
}

/// Follows the special points of a branch in both parameters.
fn curves(
    model: &Model,
    arguments: &ContinueArguments,
    second: &Second,
    range: (f64, f64),
    branch: &Branch,
    folder: &Folder,
) -> Result<CurvesReport, Failure> {
    let parameters = [arguments.parameter, second.parameter];
    let family = family(model, parameters)?;
    let region = Region {
        ranges: [range, second.range],
        points: arguments.points,
        step: STEP,
    };
    let bar = Progress::open("points of curves");
    let mut found: Vec<Curve> = Vec::new();
    for special in &branch.specials {
        let start = [special.point.parameter, second.start];
        let known = found.iter().any(|curve| passes(curve, special.kind, start));
        if known {
            continue;
        }
        let kind = (special.kind, &special.point);
        let curve = curve(&family, branch.periods, kind, start, &region, |_| {
            count(&bar)
        });
        found.push(curve.map_err(|error| {
            anyhow!(error).context(format!("no curve of the {}", special.kind.name()))
        })?);
    }
    drop(bar);
    if interrupt::requested() {
        return Err(Failure::Interrupted);
    }
    let mut table = folder.create("curves.csv")?;
    table.header(&report::CURVE_COLUMNS)?;
    for (number, curve) in found.iter().enumerate() {
        for row in report::curve_rows(number, curve) {
            table.row(&row)?;
        }
    }
    table.close()?;
    let chart = CurveChart::new(parameters, &found).svg();
    folder.stage("curves.svg", chart.as_bytes())?;
    Ok(CurvesReport {
        parameter: second.parameter.name(),
        curves: found.iter().map(CurveReport::new).collect(),
    })
}

/// True if a curve of the same kind passes a point.
fn passes(curve: &Curve, kind: SpecialKind, [p, q]: [f64; 2]) -> bool {
    let between = |a: f64, b: f64, value: f64| (a - value) * (b - value) <= 0.0;
    let crosses = |pair: &[softstop_dynamics::continuation::CurvePoint]| {
        let ([a, c], [b, d]) = (pair[0].parameters, pair[1].parameters);
        if !between(c, d, q) || c == d {
            return false;
        }
        let at = a + (b - a) * (q - c) / (d - c);
        (at - p).abs() < SAME * (b - a).abs().max(SAME * p.abs())
    };
    curve.kind.symbol() == kind.symbol() && curve.points.windows(2).any(crosses)
}

/// Share of a step of a curve within which it passes a point.
const SAME: f64 = 0.1;
