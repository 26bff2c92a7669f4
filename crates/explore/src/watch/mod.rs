//! `softstop watch`: a run of any machine as a page to look at.

mod page;
mod strip;

use std::path::PathBuf;

use clap::Args;

use page::{hit, html, shown};
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::output::folder_and_file;
use softstop_console::range::within;
use strip::StripHistory;

use crate::simulate::{CrossingRow, MotionArguments, PERIODS, report};

const EXAMPLES: &str = "\
Examples:
  softstop watch loaded
      the paper's loaded machine from its start on, as watch.html
  softstop watch docs/scenes/chatter.toml --periods 5 --output chatter.html
      bounces that pile up to rest on a rigid stop
  softstop watch --set eta=0.9875 --periods 2000 --last 40
      chaos, once the start is forgotten
  softstop watch loaded --missing-strips 5:7
      what three missing strips do

Open the page in any browser: it needs nothing from elsewhere. It shows the machine with its springs, stop, strip
and drive, displacement and contact force over time and the phase plane, all moving along; every impact is marked at
its exact time, and heard with a loudness after its before-impact velocity if the sound is switched on.
Space plays and pauses, the arrows step, with Shift from impact to impact; the page lists its keys.";

/// Arguments of `softstop watch`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub struct WatchArguments {
    /// Whole drive periods to run, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub periods: u64,
    /// So many of them are shown at most, the last ones, 1 to 400
    #[arg(long, value_name = "K", default_value_t = 100)]
    pub last: u64,
    /// The page to write
    #[arg(long, value_name = "FILE.html", default_value = "watch.html")]
    pub output: PathBuf,
    /// How it prints its summary, the machine, and where its motion begins.
    #[command(flatten)]
    pub motion: MotionArguments,
}

/// Drive periods on a page at most.
const MOST_SHOWN: u64 = 400;

/// Runs the machine, writes the page and prints the summary.
pub fn run(arguments: &WatchArguments) -> Result<(), Failure> {
    within("periods", arguments.periods, PERIODS)?;
    within("last", arguments.last, 1..=MOST_SHOWN)?;
    let (folder, file) = folder_and_file(&arguments.output)?;
    let plan = arguments
        .motion
        .plan(arguments.periods, 1, arguments.last)?;
    let export = Export::of_file("html", folder, file)?;
    let scene = &plan.machine.scene;
    let mut strips = scene.piercing.map(|_| StripHistory::new(scene.clearance));
    let (mut hits, from) = (Vec::new(), plan.drawn_from());
    let crossed = |crossed: &CrossingRow| {
        strips.iter_mut().for_each(|strips| strips.take(crossed));
        hits.extend(hit(crossed).filter(|_| crossed.time >= from));
        Ok(())
    };
    let run = || plan.run(|_| Ok(()), crossed);
    let outcome = arguments.motion.common.limit.budget.limit(run)?;
    if outcome.drawing.is_full() {
        return Err(Failure::usage(format!(
            "last = {}: too many impacts for a page; must be fewer drive periods",
            arguments.last
        )));
    }
    let last = outcome.drawing.phases.last();
    let strips = strips.zip(last).map(|(strips, last)| strips.finish(last.0));
    let shown = shown(&outcome, &strips.unwrap_or_default(), hits);
    export.file("html", html(&shown)?.as_bytes())?;
    let (result, text) = report(&outcome);
    export.finish(&result, text, arguments.motion.common.format)
}
