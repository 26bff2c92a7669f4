//! `softstop-lab throughput`: how fast the engines are, and whether the fast one gives the same motions.
//!
//! [`fleet`] says what is run, [`measure`] takes the times; [`zones`] does both for hysteresis zones, [`beside`] for studies; [`random_machines`] makes random machines, [`aimed`] aims them at trouble, [`doubt`] says which
//! of their motions can be compared, [`check`] compares; `report` says what came of it.

pub mod aimed;
pub mod beside;
pub mod check;
pub mod doubt;
pub mod fleet;
pub mod measure;
pub mod random_machines;
mod report;
pub mod zones;

use std::path::PathBuf;

use anyhow::{Context, anyhow};
use clap::Args;
use softstop::MotionError;
use softstop_lanes::{Instructions, run_one_by_one, run_with};

use beside::Beside;
use check::Plan;
use fleet::{Count, EachImpact, RANGE, Range};
use measure::{ROUNDS, Way};
use report::ThroughputReport;
use softstop_console::export;
use softstop_console::failure::Failure;
use softstop_console::machine::Regime;
use softstop_console::output::Format;
use softstop_console::range::within;
use softstop_explore::study::Measured;
use zones::Grid;

const EXAMPLES: &str = "\
Examples:
  softstop-lab throughput
      the speed of the safe engine, of one lane and of all, on one core and more, and of zones
  softstop-lab throughput loaded --check 0
      with a strip to pierce
  softstop-lab throughput --format json
      the same for programs
  softstop-lab throughput --check 1000000 --repeats 5
      and whether both give the same million random motions
  softstop-lab throughput --check 50000 --check-periods 600 --aimed
      the same in machines aimed at trouble, in motions that have time to settle, so that lanes leap over most periods
  softstop-lab throughput --check 0 --study docs/studies/map.toml
      and how much longer a study takes than the lanes alone for its motions

The engines take turns, each round a measurement of each; a round ahead of them
is not counted. Lowering the machines is part of the time. The random machines of
--check are the paper's without and with a strip, others with linear stops, and with
power laws (n = 3/2, 2 and 5/2); impacts, crossings and the state at the end of a
motion are compared if no rounding error can change its crossings, which the growth
of such errors along the safe engine's motion tells; else from just before a leap on.
Exit code 1 if one differs.";

const WIDEST: Instructions = Instructions::Widest;

/// Arguments of `softstop-lab throughput`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ThroughputArguments {
    /// Machine whose drive periods are counted
    #[arg(value_enum, default_value_t = Regime::Unloaded)]
    pub machine: Regime,
    /// Random motions to compare both engines on, 0 to 1000000000
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    pub check: u64,
    /// Drive periods of each of them, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 20)]
    pub check_periods: u64,
    /// Aim them at trouble: faces beside turning points of settled motions, frequencies beside changes of the motion
    #[arg(long)]
    pub aimed: bool,
    /// Seed of the random machines
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
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

/// Measures, compares and says what came of it.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if the engines differ,
/// [`Failure::Interrupted`] after Ctrl-C.
pub fn run(arguments: &ThroughputArguments) -> Result<(), Failure> {
    let ThroughputArguments { check, repeats, .. } = *arguments;
    within("check", check, 0..=1_000_000_000)?;
    within("check-periods", arguments.check_periods, 1..=1_000_000)?;
    within("repeats", repeats, 1..=1000)?;
    within("zones", arguments.zones, 4..=1_000_000)?;
    let study = arguments.study.as_deref().map(Measured::read).transpose()?;
    let range = Range {
        machine: arguments.machine,
        ..RANGE
    };
    let fleet = &range.fleet().context("the machines of the measurement")?;
    let sets = measure::narrower();
    let (all, one) = (measure::pool(0)?, measure::pool(1)?);
    let grid = Grid::of(arguments.zones);
    let machines = grid.scenes().context("the machines of the zones")?;
    let lanes = |set| way(move || fleet.batch(set));
    let mut ways = vec![
        way(|| fleet.safe()),
        way(|| fleet.follow(|machines, jobs| run_one_by_one(machines, jobs, &mut ()))),
        lanes(WIDEST),
        way(|| fleet.follow(|machines, jobs| run_with(WIDEST, machines, jobs, &mut EachImpact))),
        way(|| all.install(|| fleet.parallel(ROUNDS))),
        way(|| one.install(|| fleet.parallel(ROUNDS))),
        Box::new(|| zones::count(&machines, &one)),
    ];
    ways.extend(sets.iter().map(|set| lanes(*set)));
    let timings = measure::measure(&ways, repeats)?;
    let timings = (&timings[..], all.current_num_threads());
    let report = ThroughputReport::new(range, grid, repeats, timings, &sets);
    let mut report = report.context("a measurement is missing")?;
    if let (Some(path), Some(study)) = (&arguments.study, &study) {
        report.study = Some(Beside::measure(path, study, repeats)?);
    }
    if check > 0 {
        report.check = Some(check::check(Plan {
            trajectories: check,
            periods: arguments.check_periods,
            seed: arguments.seed,
            aimed: arguments.aimed,
        })?);
    }
    export::print(&report, report.text(), arguments.format)?;
    match report.check.map_or(0, |check| check.tally.different) {
        0 => Ok(()),
        different => Err(Failure::Run(anyhow!(
            "{different} of {check} random motions differ in lanes from those by the safe engine"
        ))),
    }
}

/// A way through the motions of the measurement.
fn way<'a>(run: impl Fn() -> Result<Count, MotionError> + 'a) -> Way<'a> {
    Box::new(move || run().context("a motion of the measurement"))
}
