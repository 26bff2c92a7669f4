//! `softstop-lab throughput`: how fast the engines are.
//!
//! [`batch`] says what is run, [`measure`] takes the times; [`zones`] does both for hysteresis zones, [`study_cost`] for studies;
//! `report` says what came of it.

pub mod batch;
pub mod measure;
mod report;
pub mod study_cost;
pub mod zones;

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use softstop::MotionError;
use softstop_lanes::{InstructionLimit, run_one_by_one, run_with};

use batch::{Count, EachImpact, RANGE, Range};
use measure::{ROUNDS, Way};
use report::{Engine, report};
use softstop_console::budget::Budget;
use softstop_console::export;
use softstop_console::failure::Failure;
use softstop_console::machine::PaperMachine;
use softstop_console::output::Format;
use softstop_console::range::within;
use softstop_explore::study::Study;
use study_cost::StudyCost;
use zones::Grid;

const EXAMPLES: &str = "\
Examples:
  softstop-lab throughput
      the speed of the safe engine, of one lane and of all, on one core and more, and of zones
  softstop-lab throughput loaded
      with a strip to pierce
  softstop-lab throughput --format json
      the same for programs
  softstop-lab throughput --study docs/studies/map.toml
      and how much longer a study takes than the lanes alone for its motions

The engines take turns, each round a measurement of each; a round ahead of them
is not counted. Lowering the machines is part of the time.";

const WIDEST: InstructionLimit = InstructionLimit::Widest;

/// Arguments of `softstop-lab throughput`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ThroughputArguments {
    /// Machine whose drive periods are counted
    #[arg(value_enum, default_value_t = PaperMachine::Unloaded)]
    pub machine: PaperMachine,
    /// Measurements that the medians are of, 1 to 1000
    #[arg(long, value_name = "R", default_value_t = 11)]
    pub repeats: usize,
    /// Machines, over clearance and stiffness, whose hysteresis zones are computed in each round, 4 to 1000000; a square
    /// grid of as many or a few more
    #[arg(long, value_name = "N", default_value_t = 400)]
    pub zones: u32,
    /// A study of motions, to be measured beside the lanes alone
    #[arg(long, value_name = "STUDY.toml")]
    pub study: Option<PathBuf>,
    /// How to print the result
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// Measures and says what came of it.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if a motion cannot be computed,
/// [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &ThroughputArguments) -> Result<(), Failure> {
    let repeats = arguments.repeats;
    within("repeats", repeats, 1..=1000)?;
    within("zones", arguments.zones, 4..=1_000_000)?;
    let read = |path: &PathBuf| Study::read(path, Budget::POINT);
    let study = arguments.study.as_ref().map(read).transpose()?;
    let range = Range {
        machine: arguments.machine,
        ..RANGE
    };
    let batch = &range.batch().context("the machines of the measurement")?;
    let (all, one) = (measure::pool(0)?, measure::pool(1)?);
    let grid = Grid::of(arguments.zones);
    let machines = grid.scenes().context("the machines of the zones")?;
    let lanes = |set| way(move || batch.follow(|it, jobs| run_with(set, it, jobs, &mut ())));
    let each = || batch.follow(|it, jobs| run_with(WIDEST, it, jobs, &mut EachImpact));
    let engine = |names, lanes, way| Engine { names, lanes, way };
    let of_set = |set: InstructionLimit| Some((set.registers().lanes, set));
    let scalar = || batch.follow(|it, jobs| run_one_by_one(it, jobs, &mut ()));
    let one_lane = Some((1, InstructionLimit::Avx2));
    let mut engines = vec![
        engine(["safe"; 2], None, way(|| batch.safe())),
        engine(["scalar"; 2], one_lane, way(scalar)),
        engine(["batch"; 2], of_set(WIDEST), lanes(WIDEST)),
        engine(["each_impact", "each impact"], of_set(WIDEST), way(each)),
    ];
    engines.extend(measure::narrower().into_iter().map(|set| {
        let key = match set {
            InstructionLimit::Avx2 => "avx2",
            _ => "portable",
        };
        engine([key, "batch"], of_set(set), lanes(set))
    }));
    let others: [Way<'_>; 3] = [
        way(|| all.install(|| batch.parallel(ROUNDS))),
        way(|| one.install(|| batch.parallel(ROUNDS))),
        Box::new(|| zones::count(&machines, &one)),
    ];
    let ways = engines.iter().map(|engine| &engine.way).chain(&others);
    let timings = measure::measure(&ways.collect::<Vec<_>>(), repeats)?;
    let (threads, what) = (all.current_num_threads(), (range, grid, repeats));
    let study = arguments.study.as_ref().zip(study.as_ref());
    let study = study.map(|(path, study)| StudyCost::measure(path, study, repeats));
    let report = report(
        what,
        &engines,
        &timings,
        threads,
        study.transpose()?.as_ref(),
    );
    let (result, text) = report.context("a measurement is missing")?;
    export::print(&result, text, arguments.format)
}

/// A way through the motions of the measurement.
fn way<'a>(run: impl Fn() -> Result<Count, MotionError> + 'a) -> Way<'a> {
    Box::new(move || run().context("a motion of the measurement"))
}
