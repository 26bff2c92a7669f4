//! `softstop sweep`: a parameter up and down, and where the motion jumps.

mod chart;
mod report;
mod steps;

use std::path::PathBuf;

use anyhow::anyhow;
use clap::{Args, ValueEnum};
use softstop::{Machine, Parameter};
use softstop_dynamics::{Chain, Direction, Plan};

use chart::SweepChart;
use report::report;
use softstop_console::arguments::CommandArguments;
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::keep::{Keep, KeepArguments};
use softstop_console::progress::Progress;
use softstop_console::range::{require, within};

const EXAMPLES: &str = "\
Examples:
  softstop sweep --from 0.8 --to 1.8
      the paper's Fig. 8: rho = 10 up and down; jumps, and where the two ways differ
  softstop sweep --from 0.8 --to 1.8 --clearances 2,6,10,14,18,22
      its Fig. 6(a): six clearances, both ways, 1000 frequencies of 200 periods
  softstop sweep loaded --from 0.8 --to 1.8 --clearances 2,6,10,14,18,22
      its Fig. 6(b)
  softstop sweep --from 1 --to 1.4 --steps 401 --periods 50 --tolerance 0.01 --direction up
      a fast sweep: it loses z = 1 at 1.371, later than at the fold, 1.369036
  softstop sweep --parameter clearance --from 4 --to 20 --set eta=1.15
      along another parameter
  softstop sweep docs/scenes/rigid.toml --from 3 --to 1 --set clearance=0.5
      any machine with any stop, in its own units, downwards
  softstop sweep --from 0.8 --to 1.8 --steps 100000 --periods 1000
      long: after Ctrl-C, or a kill, the same line with --resume goes on, with the same result

The rule: each value holds for --periods drive periods; the state at their end, at drive angle phi,
is where the next value begins. So the faster the sweep, the later it loses a motion; the rate is
part of the result. The first value begins at rest. Where a state lies beyond a rigid stop, as at
clearances below zero, the next value begins at rest on the stop.

z = p/n: p impacts in n drive periods, after which the state returns (within --tolerance of its
size) all along the second half of the step. What does not return is chaos if small differences
grow more than a hundredfold meanwhile, else unsettled.

Files, whole or not at all: sweep.csv with a row for each step, sweep.svg with the largest position
and the before-impact velocities over the parameter, sweep.json with the jumps.";

fn help() -> String {
    EXAMPLES.to_owned() + &column::help("sweep.csv", &steps::columns())
}

/// Which ways to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SweepWays {
    /// The parameter rises
    Up,
    /// The parameter falls
    Down,
    /// One sweep each
    Both,
}

impl SweepWays {
    fn directions(self) -> &'static [Direction] {
        match self {
            Self::Up => &[Direction::Up],
            Self::Down => &[Direction::Down],
            Self::Both => &[Direction::Up, Direction::Down],
        }
    }
}

/// Arguments of `softstop sweep`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = help(), allow_negative_numbers = true)]
pub struct SweepArguments {
    /// Parameter to sweep, by its key in the file, whose unit the values are in, or by its letter of ratios; eta,
    /// the drive frequency in units of sqrt(k1/m), any machine has
    /// [default: the drive frequency, as the machine states it]
    #[arg(long, value_name = "NAME")]
    pub parameter: Option<String>,
    /// First value
    #[arg(long, value_name = "VALUE")]
    pub from: f64,
    /// Last value
    #[arg(long, value_name = "VALUE")]
    pub to: f64,
    /// Number of values, >= 2; all sweeps together have at most 1000000 (0.6 GB)
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub steps: usize,
    /// Drive periods at each value, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub periods: u64,
    /// Which way [default: both; down if --from lies above --to]
    #[arg(long, value_enum)]
    pub direction: Option<SweepWays>,
    /// Several clearances, a sweep for each [default: that of the machine]
    #[arg(
        long,
        value_name = "VALUE,…",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub clearances: Vec<f64>,
    /// Distance within which a state has returned, in units of the motion's size, > 0 and < 1
    #[arg(long, value_name = "SHARE", default_value_t = 1e-4)]
    pub tolerance: f64,
    /// Whether it goes on with an earlier one.
    #[command(flatten)]
    pub keep: KeepArguments,
    /// Folder for sweep.csv, sweep.svg and sweep.json
    #[arg(long, value_name = "DIR", default_value = "softstop-sweep")]
    pub output: PathBuf,
    /// How it prints its result, the machine, and what it may cost.
    #[command(flatten)]
    pub common: CommandArguments,
}

const FILES: [(&str, &str); 3] = [
    ("csv", "sweep.csv"),
    ("svg", "sweep.svg"),
    ("json", "sweep.json"),
];

/// Sweeps, writes table and chart, and says where the motion jumps.
pub fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let machine = arguments.common.machine_without_start()?;
    let stated = &arguments.common.machine;
    let name = arguments.parameter.as_deref();
    let name = name.unwrap_or_else(|| machine.name(Parameter::Frequency));
    let (parameter, unit) = stated.parameter(&machine, "parameter", name)?;
    for (flag, value) in [("--from", arguments.from), ("--to", arguments.to)] {
        require(value.is_finite(), flag, value, "finite")?;
    }
    let differs = arguments.from != arguments.to;
    require(differs, "--to", arguments.to, "another value than --from")?;
    let ends = [arguments.from * unit, arguments.to * unit];
    let why = "is not used, for it is swept: --from and --to have its values";
    stated.refuse(&machine, parameter, why)?;
    if !arguments.clearances.is_empty() {
        let name = Parameter::Clearance.name();
        stated.parameter(&machine, "clearances", name)?;
        let why = "is not used, for --clearances has the values";
        stated.refuse(&machine, Parameter::Clearance, why)?;
    }
    let plan = plan(arguments, parameter, ends)?;
    let mut chains = chains(arguments, &machine, parameter, ends)?;
    let export = Export::open(&arguments.output, &FILES)?;
    let of = plan.plan_identity(&chains);
    let keep = Keep::open(&arguments.output, "sweep", &of, arguments.keep)?;
    let steps = plan.steps * chains.len();
    let progress = Progress::new(steps as u64, "steps");
    let run = || match plan.run_chains_with_memory(&mut chains, &progress.watcher(), Some(&keep)) {
        true => Ok(()),
        false => Err(Failure::Interrupted),
    };
    arguments.common.limit.budget.limit_many(steps, run)?;
    drop(progress);
    if let Some(error) = failure(&chains) {
        keep.forget();
        return Err(Failure::Run(anyhow!("no sweep has a step: {error}")));
    }
    let chart = SweepChart {
        machine: &machine,
        plan: &plan,
        chains: &chains,
    };
    let rows = steps::rows(&plan, &chains);
    export.sheet(["csv", "svg"], &steps::columns(), rows, &chart.svg())?;
    let (result, text) = report(&machine, &plan, &chains);
    export.finish(&result, text, arguments.common.format)?;
    keep.forget();
    Ok(())
}

/// Why no sweep has made any step; none if one has.
fn failure(chains: &[Chain]) -> Option<&str> {
    let all = chains.iter().all(|chain| chain.steps.is_empty());
    let first = chains.iter().filter(|_| all);
    first.filter_map(|chain| chain.error.as_deref()).next()
}

fn plan(
    arguments: &SweepArguments,
    parameter: Parameter,
    [from, to]: [f64; 2],
) -> Result<Plan, Failure> {
    let (steps, periods) = (arguments.steps, arguments.periods);
    within("steps", steps, 2..=MOST)?;
    within("periods", periods, 1..=1_000_000)?;
    let tolerance = arguments.tolerance;
    let fits = tolerance > 0.0 && tolerance < 1.0;
    require(fits, "tolerance", tolerance, "> 0 and < 1")?;
    let plan = Plan::new(parameter, (from.min(to), from.max(to)), steps, periods)
        .map_err(|error| Failure::usage(error.to_string()))?;
    Ok(Plan { tolerance, ..plan })
}

/// Most values of all sweeps together: each takes some 600 bytes.
const MOST: usize = 1_000_000;

/// A chain for each clearance and each way; refuses what no machine can have at either end.
fn chains(
    arguments: &SweepArguments,
    machine: &Machine,
    parameter: Parameter,
    [from, to]: [f64; 2],
) -> Result<Vec<Chain>, Failure> {
    if !arguments.clearances.is_empty() && parameter == Parameter::Clearance {
        return Err(Failure::usage(
            "--clearances: the clearance itself is swept; give --from and --to only",
        ));
    }
    let at = |clearance: &f64| {
        let mut machine = machine.clone();
        machine.set(Parameter::Clearance, *clearance);
        machine
    };
    let mut machines: Vec<Machine> = arguments.clearances.iter().map(at).collect();
    if machines.is_empty() {
        machines.push(machine.clone());
    }
    for machine in &machines {
        check(arguments, machine, parameter, [from, to])?;
    }
    let falls = from > to;
    let ways = arguments.direction.unwrap_or(if falls {
        SweepWays::Down
    } else {
        SweepWays::Both
    });
    let ways = ways.directions();
    let sweeps = machines.len() * ways.len();
    if arguments.steps * sweeps > MOST {
        return Err(Failure::usage(format!(
            "steps = {} in each of {sweeps} sweeps: must be at most {MOST} together, which take 0.6 GB",
            arguments.steps
        )));
    }
    let of_machine = |machine: &Machine| {
        let ways = ways.iter();
        ways.map(|way| Chain::new(machine.clone(), *way))
            .collect::<Vec<_>>()
    };
    Ok(machines.iter().flat_map(of_machine).collect())
}

fn check(
    arguments: &SweepArguments,
    machine: &Machine,
    parameter: Parameter,
    ends: [f64; 2],
) -> Result<(), Failure> {
    let own = match arguments.clearances.is_empty() {
        true => String::new(),
        false => format!("--clearances {} with ", machine.scene.clearance),
    };
    let told = [("--from", arguments.from), ("--to", arguments.to)];
    for ((flag, value), end) in told.into_iter().zip(ends) {
        let mut machine = machine.clone();
        machine.set(parameter, end);
        machine
            .validate()
            .map_err(|error| Failure::usage(format!("{own}{flag} {value}: {error}")))?;
    }
    Ok(())
}
