//! `softstop motions`: all motions on which a machine settles.

mod chart;
mod report;

use std::path::PathBuf;

use anyhow::Error;
use clap::Args;
use softstop_dynamics::attractors::{SearchOptions, find_attractors, starting_box};

use report::report;
use softstop_console::arguments::CommandArguments;
use softstop_console::export::{self, Export};
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::progress::Progress;
use softstop_console::range::within;

const EXAMPLES: &str = "\
Examples:
  softstop motions --set eta=0.9875 --set clearance=10
      three motions coexist: chaos, z = 2/3 and (2/4)B of the paper's Fig. 9
  softstop motions --set eta=0.9526475
      below g0: z = 0, and chaos that ends after some 10,000 periods
  softstop motions --set eta=0.9875 --output three
      the same with a picture of each in the phase plane
  softstop motions docs/scenes/rigid.toml --starts 1000
      any machine with any stop, in the units of its file; more starts find smaller basins
  softstop motions loaded --set eta=1.15 --format json
      for programs

How they are found: --starts quasi-random starts fill the box that basin has, too, and settle: twice the
clearance both ways (or the amplitude of a free mass), that times the drive frequency, and more where
motions go farther. What returns is polished by Newton's method on the exact
map, so each periodic motion listed exists and is stable (both multipliers inside the unit
circle). What does not return and has a Lyapunov exponent above zero by more than three
half-widths of its 95 % interval is chaos. It is watched for --patience more periods: if motions
leave it meanwhile, it is transient, and its mean lifetime is told.

z = p/n: p impacts in n drive periods. The order of impacts tells them apart: 1-0-1-0 is the
paper's (2/4)A, 1-1-0-0 its (2/4)B. The share of starts is a rough measure of the basin.
A motion whose basin is a share p of the box is missed by n random starts with probability
(1 - p)^n: 1 % by 256 in 8 of 100 searches, by 1000 in 4 of 100,000. The quasi-random starts do no
worse. Where three motions coexist, at eta = 0.9875, 16 starts found all in 100 of 100 searches.";

const FILES: [(&str, &str); 2] = [("json", "motions.json"), ("svg", "motions.svg")];

/// Arguments of `softstop motions`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct MotionsArguments {
    /// Starts, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = SearchOptions::default().starts)]
    pub starts: usize,
    /// Shifts the starts: another seed, other starts
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    pub seed: u64,
    /// Drive periods before a motion is looked at, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = SearchOptions::default().transient)]
    pub transient: u64,
    /// Longest period looked for, in drive periods, 1 to 10000
    #[arg(long, value_name = "N", default_value_t = SearchOptions::default().longest)]
    pub longest: usize,
    /// Drive periods for which motions that do not repeat are watched, all together; 20 times
    /// fewer where motions take longer, as with a pressed rigid stop or a power law other than n = 3/2, 2 and 5/2
    #[arg(long, value_name = "N", default_value_t = SearchOptions::default().patience)]
    pub patience: u64,
    /// Folder for motions.json and motions.svg, a picture of all motions; none without it
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

/// Finds the motions and prints them.
pub fn run(arguments: &MotionsArguments) -> Result<(), Failure> {
    let mut options = options(arguments)?;
    let machine = arguments.common.machine_without_start()?;
    let export = arguments.output.as_deref();
    let export = export.map(|it| Export::open(it, &FILES)).transpose()?;
    let progress = Progress::new(1, "drive periods at most");
    let watcher = |done, planned| {
        progress.at_of(done, planned);
        interrupt::go_on()
    };
    let survey = arguments.common.limit.budget.limit(|| {
        let region = starting_box(&machine.scene, &|_, _| interrupt::go_on());
        options.region = Some(region.map_err(Error::from)?);
        Ok(find_attractors(&machine.scene, &options, &watcher).map_err(Error::from)?)
    })?;
    drop(progress);
    let (result, text) = report(&machine, &options, &survey);
    let Some(export) = export else {
        return export::print(&result, text, arguments.common.format);
    };
    let picture = chart::svg(&machine, &survey).map_err(Error::from)?;
    export.file("svg", picture.as_bytes())?;
    export.finish(&result, text, arguments.common.format)
}

fn options(arguments: &MotionsArguments) -> Result<SearchOptions, Failure> {
    within("starts", arguments.starts, 1..=1_000_000)?;
    within("transient", arguments.transient, 1..=1_000_000)?;
    within("longest", arguments.longest, 1..=10_000)?;
    within("patience", arguments.patience, 1..=1_000_000_000_000)?;
    Ok(SearchOptions {
        starts: arguments.starts,
        seed: arguments.seed,
        transient: arguments.transient,
        longest: arguments.longest,
        patience: arguments.patience,
        region: None,
    })
}
