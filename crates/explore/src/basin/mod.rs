//! `softstop basin`: which initial states lead to which motion.

mod attractors;
pub mod certainty;
pub mod chart;
mod plane;
mod report;

use std::path::PathBuf;

use anyhow::{Context, Error, anyhow};
use clap::Args;
use serde::Serialize;
use softstop::Machine;
use softstop_dynamics::attractors::starting_box;
use softstop_dynamics::basin::{BasinOptions, establishing_certainties, find_basins, zone_box};
use softstop_dynamics::monitor::{Monitor, OptionalMemory};
use softstop_dynamics::zone;

use plane::{Plane, Size};
use softstop_console::arguments::{CommandArguments, refuse_without_zone, title};
use softstop_console::column;
use softstop_console::export::{Array, Export, hand_over};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::{Keep, KeepArguments};
use softstop_console::progress::Progress;
use softstop_console::range::{self, within};

const EXAMPLES: &str = "\
Examples:
  softstop basin --size 1000
      the paper's point A: which of a million initial states lead to z = 1
  softstop basin --set eta=0.9875 --x 0:15 --v=-20:20
      chaos, z = 2/3 and z = (2/4)B side by side
  softstop basin --plane phi,v --at 0
      over drive angle and velocity, from position 0
  softstop basin --along-zone 21 --size 200
      establishing certainty of z = 1 at 21 places from g0 to s_SN: the share of initial states
      that lead to it (where two coexist, to the harder one), for the same plane at all of them: that
      of the machine at its own frequency, wider if motions of the zone lie outside it
  softstop basin loaded --parameter eta --from 1 --to 1.35 --steps 71 --size 100
      all attractors along eta: each keeps its number from value to value while it lasts
  softstop basin docs/scenes/rigid.toml --size 400 --format json
      any machine with any stop, in its own units
  softstop basin --size 4000 --resume
      goes on after Ctrl-C or a kill, with the same result

Each cell's motion is followed until it lies in a ball about a stable orbit in which the map
contracts; what no ball has caught after --transient drive periods is looked at one by one: what
returns is polished by Newton's method, what does not is followed on if it settles slowly (for up to
8192 periods), or is chaos. Shares come with Wilson's 95 %
interval, as if cells were drawn at random. The integrity of a basin is its integrity factor, the
radius of the largest ball anywhere inside it, in units of half of each axis of the plane: 1 would
fill the plane.

Along a parameter the plane is the same at all values. An attractor goes on as the nearest one of its
regime at the next value, or as one of another regime that lies near by, as after a soft flip. The
basin entropy (Daza et al. 2016) is that of boxes of 5 by 5 cells; where that of the boxes with several basins exceeds ln 2, their boundary is fractal.

Files, whole or not at all: basin.png (white spots: the motions at drive angle phi), basin.csv with
a row for each basin, basin.json; with --along-zone certainty.svg, certainty.csv, certainty.json;
along a parameter attractors.svg, attractors.csv, attractors.json.";

/// Arguments of `softstop basin`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct BasinArguments {
    /// Cells on each side of the plane, 2 to 4000 (2.0 GB), or across and upwards
    #[arg(long, value_name = "N|ACROSS,UP", default_value = "400")]
    pub size: Size,
    /// Plane of initial states: the quantity across, and the one upwards, of x, v and phi
    #[arg(long, value_name = "ACROSS,UP", default_value = "x,v")]
    pub plane: Plane,
    /// The third quantity, which all cells share
    #[arg(long, value_name = "VALUE", default_value_t = 0.0)]
    pub at: f64,
    /// Range of the initial position [default: twice the clearance, or the amplitude of a free mass if that is larger, both ways; more where motions go farther]
    #[arg(long, value_name = "LOW:HIGH", value_parser = range::rising, allow_hyphen_values = true)]
    pub x: Option<[f64; 2]>,
    /// Range of the initial velocity [default: that times the drive frequency both ways, more where motions are faster]
    #[arg(long, value_name = "LOW:HIGH", value_parser = range::rising, allow_hyphen_values = true)]
    pub v: Option<[f64; 2]>,
    /// Range of the drive angle in rad [default: a whole turn]
    #[arg(long, value_name = "LOW:HIGH", value_parser = range::rising, allow_hyphen_values = true)]
    pub phi: Option<[f64; 2]>,
    /// Drive periods after which what has not arrived is looked at, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = BasinOptions::default().transient)]
    pub transient: u64,
    /// Longest period looked for, in drive periods, 1 to 10000
    #[arg(long, value_name = "N", default_value_t = BasinOptions::default().longest)]
    pub longest: usize,
    /// Instead of one picture: the certainty of z = 1 at so many places of the hysteresis zone,
    /// 2 to 1000
    #[arg(long, value_name = "N")]
    pub along_zone: Option<usize>,
    /// Instead of one picture: attractors and basins along a parameter, by its key in the file, whose unit the values are
    /// in, or by its letter of ratios; eta, the drive frequency in units of sqrt(k1/m), any machine has
    #[arg(
        long,
        value_name = "NAME",
        requires = "from",
        requires = "to",
        conflicts_with = "along_zone"
    )]
    pub parameter: Option<String>,
    /// First value of the parameter
    #[arg(long, value_name = "VALUE", requires = "parameter")]
    pub from: Option<f64>,
    /// Last value
    #[arg(long, value_name = "VALUE", requires = "parameter")]
    pub to: Option<f64>,
    /// Number of values, 2 to 1000
    #[arg(long, value_name = "N", default_value_t = 41, requires = "parameter")]
    pub steps: usize,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
    /// Folder for the files
    #[arg(long, value_name = "DIR", default_value = "softstop-basin")]
    pub output: PathBuf,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

const PICTURE: [(&str, &str); 3] = [
    ("png", "basin.png"),
    ("csv", "basin.csv"),
    ("json", "basin.json"),
];
const ALONG: [(&str, &str); 3] = [
    ("svg", "certainty.svg"),
    ("csv", "certainty.csv"),
    ("json", "certainty.json"),
];

fn help() -> String {
    let certainty = column::help("certainty.csv", &report::places());
    EXAMPLES.to_owned()
        + &column::help("basin.csv", &report::columns())
        + &certainty
        + &attractors::help()
}

/// Finds the basins, draws them and says how large they are.
pub fn run(arguments: &BasinArguments) -> Result<(), Failure> {
    let options = options(arguments)?;
    let machine = arguments.common.machine_without_start()?;
    match (&arguments.parameter, arguments.along_zone) {
        (Some(name), _) => attractors::run(arguments, &options, &machine, name),
        (None, Some(places)) => along_zone(arguments, &options, &machine, places),
        (None, None) => picture(arguments, &options, &machine),
    }
}

/// Most cells on a side: each takes 125 bytes.
const LARGEST: usize = 4000;

fn options(arguments: &BasinArguments) -> Result<BasinOptions, Failure> {
    within("size", arguments.size.across, 2..=LARGEST)?;
    within("size", arguments.size.up, 2..=LARGEST)?;
    within("transient", arguments.transient, 1..=1_000_000)?;
    within("longest", arguments.longest, 1..=10_000)?;
    within("steps", arguments.steps, 2..=1000)?;
    within("along-zone", arguments.along_zone.unwrap_or(2), 2..=1000)?;
    Ok(BasinOptions {
        transient: arguments.transient,
        longest: arguments.longest,
    })
}

/// Does work on so many cells within the budget, each piece of it kept: what it finds, and the pieces.
fn compute<T, E: std::error::Error + Send + Sync + 'static>(
    arguments: &BasinArguments,
    of: &impl Serialize,
    cells: usize,
    progress: Progress,
    work: impl FnOnce(Monitor<'_>, OptionalMemory<'_>) -> Result<T, E>,
) -> Result<(T, Keep), Failure> {
    let keep = Keep::open(&arguments.output, "basin", of, arguments.keep)?;
    let found = arguments.common.limit.budget.limit_many(cells, || {
        Ok(work(&progress.watcher(), Some(&keep)).map_err(Error::from)?)
    })?;
    Ok((found, keep))
}

/// The basins of one machine.
fn picture(
    arguments: &BasinArguments,
    options: &BasinOptions,
    machine: &Machine,
) -> Result<(), Failure> {
    let scene = &machine.scene;
    plane::check(arguments)?;
    let export = Export::open(&arguments.output, &PICTURE)?;
    let limit = arguments.common.limit.budget;
    let region = || starting_box(scene, &interrupt::watch);
    let grid = limit.limit(|| plane::grid(arguments, scene, region))?;
    let cells = grid.cell_count();
    let progress = Progress::new(cells as u64, "cells");
    let of = (scene, grid, options);
    let (basins, keep) = compute(arguments, &of, cells, progress, |monitor, kept| {
        find_basins(scene, &grid, options, monitor, kept)
    })?;
    let shown = format!("Basins: {}", title(machine));
    let png = chart::png(machine, &basins, shown);
    let png = png.map_err(|error| anyhow!("cannot draw basin.png: {error}"))?;
    export.file("png", &png)?;
    hand_over("labels", || Array::Indices(basins.cells.clone()));
    for (name, axis) in [("across", &grid.across), ("up", &grid.up)] {
        let middles = || (0..axis.cells).map(|cell| axis.value_at(cell)).collect();
        hand_over(name, || Array::Numbers(middles()));
    }
    let (result, text) = report::basins(machine, &basins, plane::beyond(machine, &grid));
    export.table("csv", &report::columns(), report::rows(&basins))?;
    export.finish(&result, text, arguments.common.format)?;
    keep.forget();
    Ok(())
}

/// The certainty of z = 1 along the hysteresis zone.
fn along_zone(
    arguments: &BasinArguments,
    options: &BasinOptions,
    machine: &Machine,
    places: usize,
) -> Result<(), Failure> {
    plane::check(arguments)?;
    refuse_without_zone(machine)?;
    let export = Export::open(&arguments.output, &ALONG)?;
    let limit = arguments.common.limit.budget;
    let zone = limit.limit(|| {
        let zone = zone::hysteresis_with_monitor(&machine.scene, &interrupt::watch);
        Ok(zone.with_context(|| format!("no hysteresis zone found of {}", title(machine)))?)
    })?;
    let mut widened = false;
    let region = || {
        let (region, is_wider) = zone_box(&machine.scene, &zone, &interrupt::watch)?;
        widened = is_wider;
        Ok(region)
    };
    let grid = limit.limit(|| plane::grid(arguments, &zone.scene, region))?;
    let shares: Vec<f64> = (0..places)
        .map(|k| k as f64 / (places - 1) as f64)
        .collect();
    let cells = grid.cell_count() * places;
    let progress = Progress::new(cells as u64, "cells");
    let of = (&zone.scene, &shares, grid, options);
    let (found, keep) = compute(arguments, &of, cells, progress, |monitor, kept| {
        establishing_certainties(&zone, &shares, &grid, options, monitor, kept)
    })?;
    let title = format!("Establishing certainty: {}", title(machine));
    let chart = certainty::chart(machine, &found, &title);
    let (result, text) = report::certainties(machine, (&grid, widened), &found);
    let rows = found.iter().map(|place| (machine, place));
    export.sheet(["csv", "svg"], &report::places(), rows, &chart)?;
    export.finish(&result, text, arguments.common.format)?;
    keep.forget();
    Ok(())
}
