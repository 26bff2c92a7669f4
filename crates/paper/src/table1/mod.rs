//! `softstop-lab table1`: the paper's Table 1, found anew.

pub(crate) mod figure;
mod markdown;
pub(crate) mod matching;
pub mod paper;
pub mod report;
mod swept;

use std::path::PathBuf;

use crate::transitions::{Explorer, Rules, Transition};
use anyhow::Result;
use clap::{Args, ValueEnum};
use softstop::{Parameter, Ratios};
use softstop_dynamics::ParameterFamily;
use softstop_dynamics::monitor::{Memory, OptionalMemory};

pub use markdown::markdown;
use report::TableReport;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::keep::{Keep, KeepArguments};
use softstop_console::output::{self, Folder};
use softstop_console::progress::Progress;
use softstop_console::range::within;

const EXAMPLES: &str = "\
Examples:
  softstop-lab table1                       the 19 rows, beside the paper's figures
  softstop-lab table1 --format csv          for a spreadsheet
  softstop-lab table1 --format json         for programs
  softstop-lab table1 --output out          and as out/table1.csv, .json and .md
  softstop-lab table1 --lifetime 5000       chaos has to last longer to count
  softstop-lab table1 --output out --resume goes on after Ctrl-C, or a kill

How the rows are found: motions are searched for at a few frequencies, evenly spaced over the
paper's sub-intervals (a) to (d). Each periodic one is followed to both ends of its stability,
located to 1e-10. Beyond an end the frequency is held at 1e-8, 2e-8, 4e-8, ... of its value and
the motion let go: what it settles on is what follows. Back inside, the same is done again: if
it comes home there is no hysteresis. Motions met on the way are followed in turn. Chaos is
followed as long as half of --motions motions on it last for --lifetime drive periods.
Only then are the transitions compared with the paper's.

Types (the paper's Table 2): G grazing, SN fold, PD flip, ISN and IPD a fold or a cascade of
flips that ends in chaos, OCH out of chaos; SN also stands for the jump beyond a hard (subcritical)
flip, as in the paper. A soft flip loses nothing: the doubled motion goes on. They are told from what was found, not copied. A
row that is not found has no figure.";

/// How to print the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum TableFormat {
    /// For people.
    #[default]
    Text,
    /// For programs: one JSON object and nothing else on stdout.
    Json,
    /// Comma-separated values with a line of names.
    Csv,
}

/// Arguments of `softstop-lab table1`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct TableArguments {
    /// Motions started on chaos, and beside each end of a motion, 2 to 10000; 16 go first, the others if those disagree
    #[arg(long, value_name = "N", default_value_t = Rules::default().motions)]
    pub motions: usize,
    /// Drive periods for which half of them must wander for chaos to count, 100 to 10000000
    #[arg(long, value_name = "N", default_value_t = Rules::default().lifetime)]
    pub lifetime: u64,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
    /// Folder for table1.csv, table1.json and table1.md, and for what is done until they stand [default: no files]
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// How to print the table
    #[arg(long, value_enum, default_value_t)]
    pub format: TableFormat,
}

/// The paper's frequency interval.
pub const RANGE: (f64, f64) = (0.8, 1.8);

const NAMES: [&str; 3] = ["table1.csv", "table1.json", "table1.md"];

/// Finds the rows and prints them.
///
/// # Errors
/// [`Failure::Usage`] for values out of range, [`Failure::Run`] if nothing can be computed or the folder cannot
/// be written, [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &TableArguments) -> Result<(), Failure> {
    within("motions", arguments.motions, 2..=10_000)?;
    within("lifetime", arguments.lifetime, 100..=10_000_000)?;
    let rules = Rules {
        motions: arguments.motions,
        lifetime: arguments.lifetime,
        ..Rules::default()
    };
    let folder = arguments.output.as_ref();
    let folder = folder.map(|path| Folder::open(path, &NAMES)).transpose()?;
    let of = (rules.motions, rules.lifetime);
    let open = |path: &PathBuf| Keep::open(path, "table1", &of, arguments.keep);
    let keep = arguments.output.as_ref().map(open).transpose()?;
    if arguments.keep.resume && keep.is_none() {
        let message = "--resume: needs --output, the folder in which what is done is kept";
        return Err(Failure::usage(message));
    }
    let kept = keep.as_ref().map(|keep| keep as &dyn Memory);
    let transitions = transitions(&rules, RANGE, &values(&paper::INTERVALS), kept)?;
    let report = TableReport::new(&paper::ROWS, &transitions, &rules);
    if let Some(folder) = folder {
        folder.stage(NAMES[0], &output::csv(&report.rows)?)?;
        folder.stage(NAMES[1], output::json(&report)?.as_bytes())?;
        folder.stage(NAMES[2], markdown(&report).as_bytes())?;
        folder.commit(&NAMES)?;
    }
    if let Some(keep) = keep {
        keep.forget();
    }
    output::print(&match arguments.format {
        TableFormat::Json => output::json(&report)?,
        TableFormat::Csv => String::from_utf8_lossy(&output::csv(&report.rows)?).into_owned(),
        TableFormat::Text => report.text(),
    })
}

/// Values spread evenly over intervals, their ends left out.
pub fn values(intervals: &[(f64, f64, usize)]) -> Vec<f64> {
    let inside = |&(low, high, count): &(f64, f64, usize)| {
        let step = (high - low) / (count + 1) as f64;
        (1..=count).map(move |index| low + step * index as f64)
    };
    intervals.iter().flat_map(inside).collect()
}

/// All transitions in a range of frequencies, of the unloaded machine at rho = 10, that are found from
/// some of them. What is known is recalled.
///
/// # Errors
/// [`Failure::Run`] if they cannot be computed, [`Failure::Interrupted`] after Ctrl-C.
pub fn transitions(
    rules: &Rules,
    range: (f64, f64),
    values: &[f64],
    kept: OptionalMemory<'_>,
) -> Result<Vec<Transition>> {
    let family = ParameterFamily::new(Ratios::unloaded().scene()?, [Parameter::Frequency])?;
    let bar = Progress::open("drive periods of the present look at motions");
    let watcher = |done, _| {
        bar.at(done);
        interrupt::go_on()
    };
    let explorer = Explorer {
        family: &family,
        range,
        rules: *rules,
        monitor: &watcher,
        kept,
    };
    let found = explorer.explore(values);
    drop(bar);
    Ok(found?)
}
