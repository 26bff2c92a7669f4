//! Basins and attractors along a parameter.

mod chart;
mod report;

use softstop::{Machine, Parameter, Scene};
use softstop_dynamics::attractors::{Region, starting_box};
use softstop_dynamics::basin::{BasinOptions, BasinsAt, follow_attractors};
use softstop_dynamics::orbit::OrbitError;

use super::{BasinArguments, compute, plane};
use report::columns;
use softstop_console::arguments::{title, title_over_frequency};
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_console::range::require;

const FILES: [(&str, &str); 3] = [
    ("csv", "attractors.csv"),
    ("svg", "attractors.svg"),
    ("json", "attractors.json"),
];

/// The columns of `attractors.csv`, for `--help`.
pub(super) fn help() -> String {
    column::help("attractors.csv", &columns())
}

/// What was found along a parameter.
struct GlobalContinuation<'a> {
    machine: &'a Machine,
    parameter: Parameter,
    places: Vec<BasinsAt>,
}

impl GlobalContinuation<'_> {
    /// What the machine is called, without the frequency along which it was looked at.
    fn title(&self) -> String {
        match self.parameter {
            Parameter::Frequency => title_over_frequency(self.machine),
            _ => title(self.machine),
        }
    }
}

/// The basins at values of the parameter of this name.
pub(super) fn run(
    arguments: &BasinArguments,
    options: &BasinOptions,
    machine: &Machine,
    name: &str,
) -> Result<(), Failure> {
    plane::check(arguments)?;
    let (parameter, scenes) = scenes(arguments, machine, name)?;
    let export = Export::open(&arguments.output, &FILES)?;
    let limit = arguments.common.limit.budget;
    let region = || region(&scenes);
    let grid = limit.limit(|| plane::grid(arguments, &scenes[0].1, region))?;
    let cells = grid.cell_count() * scenes.len();
    let progress = Progress::new((cells + scenes.len()) as u64, "cells and values");
    let of = (&scenes, grid, options);
    let (places, keep) = compute(arguments, &of, cells, progress, |monitor, kept| {
        follow_attractors(&scenes, &grid, options, monitor, kept)
    })?;
    let found = GlobalContinuation {
        machine,
        parameter,
        places,
    };
    let rows = report::rows(&found);
    let chart = chart::svg(&found, &rows);
    let (result, text) = report::report(&found, &rows);
    export.sheet(["csv", "svg"], &columns(), rows, &chart)?;
    export.finish(&result, text, arguments.common.format)?;
    keep.forget();
    Ok(())
}

/// The parameter, and the machine at each of its values.
fn scenes(
    arguments: &BasinArguments,
    machine: &Machine,
    name: &str,
) -> Result<(Parameter, Vec<(f64, Scene)>), Failure> {
    let stated = &arguments.common.machine;
    let (parameter, unit) = stated.parameter(machine, "parameter", name)?;
    let why = "is not used, for basins are looked for along it: --from and --to have its values";
    stated.refuse(machine, parameter, why)?;
    let ends = [arguments.from, arguments.to].map(Option::unwrap_or_default);
    for (flag, value) in ["--from", "--to"].into_iter().zip(ends) {
        require(value.is_finite(), flag, value, "finite")?;
    }
    let [from, to] = ends;
    let last = (arguments.steps - 1) as f64;
    let at = |step: usize| {
        let share = step as f64 / last;
        let value = from * (1.0 - share) + to * share;
        let mut machine = machine.clone();
        machine.set(parameter, unit * value);
        let checked = machine.validate();
        checked.map_err(|error| Failure::usage(format!("{name} = {value}: {error}")))?;
        Ok((unit * value, machine.scene))
    };
    let scenes: Result<Vec<_>, Failure> = (0..arguments.steps).map(at).collect();
    Ok((parameter, scenes?))
}

/// The smallest box that holds the boxes of starts of all machines.
fn region(scenes: &[(f64, Scene)]) -> Result<Region, OrbitError> {
    let mut all: Option<Region> = None;
    for (_, scene) in scenes {
        let own = starting_box(scene, &interrupt::watch)?;
        all = Some(all.map_or(own, |all| all.smallest_union(&own)));
    }
    all.ok_or(OrbitError::Stopped)
}
