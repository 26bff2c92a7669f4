//! `softstop study`: many machines, or many motions of one, from a file that says which.

mod axis;
mod blocks;
mod certainty;
mod column;
mod evaluate;
mod file;
mod outputs;
mod picture;
mod plot;
mod point_evaluation;
mod points;
mod read;
mod report;
mod schema;
mod shard;
mod shard_run;
mod table;
mod values;

use std::fs;
use std::path::PathBuf;

use anyhow::Context;
use clap::{Args, Subcommand};
use softstop_console::budget::Budget;
use softstop_console::export::{self, Export};
use softstop_console::failure::Failure;
use softstop_console::keep::KeepArguments;
use softstop_console::output::Format;
use softstop_console::record::Record;

use blocks::Blocks;
use report::StudyReport;
use shard::DONE;
use shard_run::ShardRun;

pub use file::Study;
pub use plot::PlotArguments;
pub use schema::schema;
pub use shard::Shard;

const EXAMPLES: &str = "\
Examples:
  softstop study docs/studies/map.toml
      the regimes over frequency and clearance; after Ctrl-C, or a kill, the same line with --resume goes on
  softstop study plot
      draws it
  softstop study docs/studies/map.toml --shard 3/7
      a seventh of its blocks, on another machine say; --resume takes up what is there of it
  softstop study merge docs/studies/map.toml
      when all shards are in the output folder: the same files as without shards, to the last byte

A study is a TOML file (softstop schema study tells all keys):

  machine = \"unloaded\"            # or a file, seen from the study's folder
  set = [\"stop.stiffness=7\"]
  outputs = [\"z\", \"velocity\", \"max_position\"]

  [[axis]]
  parameter = \"eta\"               # a key of the machine's file, or a letter
  from = 0.8
  to = 1.8
  count = 1000                    # a grid; scale = \"log\" spaces logarithms evenly

  [[axis]]
  parameter = \"clearance\"
  values = [6, 8, 10]

An axis with sample = \"sobol\" (Owen-scrambled) or \"random\" instead of count is drawn; samples = N, beside outputs,
says how often at each point of the grid, seed = N which. initial.position and initial.velocity are axes, too.

Files, whole or not at all: study.parquet with a row for each point, the first axis slowest and samples
fastest; study.json, which tells all that it follows from; with --csv study.csv.";

fn help() -> String {
    EXAMPLES.to_owned() + &outputs::help()
}

/// Arguments of `softstop study`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct StudyArguments {
    /// What else to do with a study.
    #[command(subcommand)]
    pub then: Option<StudyCommand>,
    /// What to compute, and where its results go.
    #[command(flatten)]
    pub what: Option<ResultArguments>,
    /// Compute one of N parts, the first of which is 1/N, for `softstop study merge`
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
}

/// What to do with a study that is computed.
#[derive(Debug, Subcommand)]
pub enum StudyCommand {
    /// Put the shards of a study together
    Merge(MergeArguments),
    /// Draw a map over two axes, or a slice along one
    Plot(PlotArguments),
}

/// A study, and where its results go.
#[derive(Debug, Args)]
pub struct ResultArguments {
    /// The study
    #[arg(value_name = "STUDY.toml")]
    pub study: PathBuf,
    /// Write study.csv, too
    #[arg(long)]
    pub csv: bool,
    /// Folder for study.parquet and study.json, and for shards
    #[arg(long, value_name = "DIR", default_value = FOLDER)]
    pub output: PathBuf,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Work that each point may cost, in millions of scan windows; outputs of a point that would cost more are left
    /// out, the same ones on every computer
    #[arg(long, value_name = "MILLIONS", default_value_t = Budget::POINT)]
    pub budget: Budget,
}

const FOLDER: &str = "softstop-study";

/// Arguments of `softstop study merge`.
#[derive(Debug, Args)]
pub struct MergeArguments {
    /// What was computed, and where its results go.
    #[command(flatten)]
    pub what: ResultArguments,
    /// Shards, or folders of them [default: those in the output folder]
    #[arg(value_name = "SHARDS")]
    pub shards: Vec<PathBuf>,
}

const FILES: [(&str, &str); 3] = [("parquet", TABLE), ("json", MANIFEST), ("csv", "study.csv")];
const TABLE: &str = "study.parquet";
const MANIFEST: &str = "study.json";

/// Computes a study or a shard of it, merges shards, or draws.
pub fn run(arguments: &StudyArguments) -> Result<(), Failure> {
    match (&arguments.then, &arguments.what, arguments.shard) {
        (Some(StudyCommand::Merge(arguments)), ..) => merge(arguments),
        (Some(StudyCommand::Plot(arguments)), ..) => plot::run(arguments),
        (None, Some(what), Some(shard)) => part(what, shard, arguments.keep),
        (None, Some(what), None) => whole(what, arguments.keep),
        (None, None, _) => Err(Failure::usage("STUDY.toml: must say what to compute")),
    }
}

impl Study {
    /// How many points it has.
    pub fn points(&self) -> u64 {
        self.points
    }

    /// Drive periods for which each motion is followed.
    pub fn periods(&self) -> u64 {
        self.settling.periods
    }

    /// Computes all of it and writes its table, into a folder that is taken away.
    ///
    /// # Errors
    /// [`Failure::Run`] if a file cannot be written; [`Failure::Interrupted`].
    pub fn compute(&self) -> Result<(), Failure> {
        let folder = tempfile::tempdir().context("no folder for the results")?;
        let run = ShardRun::open(self, Shard::WHOLE, folder.path().join("study.part"), false)?;
        run.go_on()?;
        let file = fs::File::create(folder.path().join(TABLE)).context(TABLE)?;
        table::write(self, &mut run.done(), file, None)?;
        Ok(())
    }
}

/// The whole study.
fn whole(what: &ResultArguments, keep: KeepArguments) -> Result<(), Failure> {
    let study = Study::read(&what.study, what.budget)?;
    let export = export(what)?;
    let path = what.output.join("study.part");
    let run = ShardRun::open(&study, Shard::WHOLE, path.clone(), keep.resume)?;
    run.go_on()?;
    write(&study, &mut run.done(), export, what)?;
    // The results stand: what is left of the way to them harms nobody.
    let _ = fs::remove_file(path);
    Ok(())
}

/// One shard.
fn part(what: &ResultArguments, shard: Shard, keep: KeepArguments) -> Result<(), Failure> {
    let study = Study::read(&what.study, what.budget)?;
    let folder = &what.output;
    let cannot = || format!("output folder {}: cannot be written", folder.display());
    fs::create_dir_all(folder).with_context(cannot)?;
    let done = folder.join(shard.name());
    let path = done.with_extension("part");
    if keep.resume {
        ShardRun::wait(&path)?;
    }
    if !(keep.resume
        && Blocks::merged(&study, std::slice::from_ref(&done)).is_ok_and(|it| it.has(shard)))
    {
        let run = ShardRun::open(&study, shard, path, keep.resume)?;
        run.go_on()?;
        run.close(&done)?;
    }
    let file = done.display().to_string();
    let text = format!("Shard {shard}: {file}\n");
    let result = Record::default()
        .hidden("study", study.hash)
        .hidden("shard", shard.to_string())
        .hidden("file", file);
    export::print(&result, text, what.format)
}

/// All shards.
fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    let what = &arguments.what;
    let study = Study::read(&what.study, what.budget)?;
    let own = [what.output.clone()];
    let places = match arguments.shards.as_slice() {
        [] => &own,
        shards => shards,
    };
    let mut blocks = Blocks::merged(&study, &shards(places)?)?;
    blocks.complete(&study)?;
    write(&study, &mut blocks, export(what)?, what)
}

/// The files of finished shards in these places.
fn shards(places: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut all = Vec::new();
    for place in places {
        let cannot = || format!("cannot read {}", place.display());
        if !place.is_dir() {
            all.push(place.clone());
            continue;
        }
        let mut found = Vec::new();
        for entry in fs::read_dir(place).with_context(cannot)? {
            let path = entry.with_context(cannot)?.path();
            if path.extension().is_some_and(|it| it == DONE) {
                found.push(path);
            }
        }
        found.sort();
        all.extend(found);
    }
    Ok(all)
}

fn export(what: &ResultArguments) -> Result<Export, Failure> {
    let files = &FILES[..FILES.len() - usize::from(!what.csv)];
    Export::open(&what.output, files)
}

/// Puts the results in place and prints what they are.
fn write(
    study: &Study,
    blocks: &mut Blocks,
    export: Export,
    what: &ResultArguments,
) -> Result<(), Failure> {
    let csv = what.csv.then(|| export.rows("csv")).transpose()?;
    let summaries = table::write(study, blocks, export.open_file("parquet")?, csv)?;
    let report = StudyReport::new(study, summaries);
    export.finish(&report, report.text(study), what.format)
}
