//! `softstop sweep`: a parameter up and down, and where the motion jumps.

pub mod chart;
mod keep;
mod report;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use softstop_dynamics::continuation::{Adjustable, Parameter};
use softstop_dynamics::sweep::{Chain, Direction, Plan};

use crate::sweep::chart::SweepChart;
use keep::Keep;
use report::SweepReport;
use softstop_console::column;
use softstop_console::export::Export;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_console::machine::{self, SceneSettings, require};
use softstop_console::model::{self, Model};
use softstop_console::output::Format;
use softstop_console::progress::Progress;
use softstop_console::scene_file;

const EXAMPLES: &str = "\
Examples:
  softstop sweep --from 0.8 --to 1.8
      the paper's Fig. 8: rho = 10 up and down; jumps, and where the two ways differ
  softstop sweep --from 0.8 --to 1.8 --clearances 2,6,10,14,18,22
      its Fig. 6(a): six clearances, both ways, 1000 frequencies of 200 periods
  softstop sweep --from 0.8 --to 1.8 --clearances 2,6,10,14,18,22 --regime loaded
      its Fig. 6(b)
  softstop sweep --from 1 --to 1.4 --steps 401 --periods 50 --tolerance 0.01 --direction up
      a fast sweep: it loses z = 1 at 1.371, later than at the fold, 1.369036
  softstop sweep --parameter clearance --from 4 --to 20 --frequency 1.15
      along another parameter
  softstop sweep docs/scenes/rigid.toml --parameter frequency --from 1 --to 3
      any machine with any stop, in SI units
  softstop sweep --from 0.8 --to 1.8 --steps 100000 --periods 1000
      long: after Ctrl-C the same line with --resume goes on, with the same result

The rule: each value holds for --periods drive periods; the state at their end, at drive angle 0,
is where the next value begins. So the faster the sweep, the later it loses a motion; the rate is
part of the result. The first value begins at rest.

z = p/n: p impacts in n drive periods, after which the state returns (within --tolerance of its
size) all along the second half of the step. What does not return is chaos if small differences
grow more than a hundredfold meanwhile, else unsettled.

Files, whole or not at all: sweep.csv with a row for each step, sweep.svg with the largest position
and the before-impact velocities over the parameter, sweep.json with the jumps.";

fn help() -> String {
    EXAMPLES.to_owned() + &column::help("sweep.csv", &report::columns())
}

/// Which ways to go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Ways {
    /// The parameter rises
    Up,
    /// The parameter falls
    Down,
    /// One sweep each
    Both,
}

impl Ways {
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
    /// Scene in SI units as for `softstop simulate`, instead of the paper's machine
    #[arg(value_name = "SCENE.toml", conflicts_with = "scene")]
    pub file: Option<PathBuf>,
    /// Parameter to sweep, by the name of its option or the paper's letter, as for
    /// `softstop continue`
    #[arg(long, value_name = "NAME", value_parser = model::parameter, default_value = "frequency")]
    pub parameter: Parameter,
    /// Lowest value
    #[arg(long, value_name = "VALUE")]
    pub from: f64,
    /// Highest value
    #[arg(long, value_name = "VALUE")]
    pub to: f64,
    /// Number of values, 2 to 10000000
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub steps: usize,
    /// Drive periods at each value, 1 to 1000000
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub periods: u64,
    /// Which way
    #[arg(long, value_enum, default_value = "both")]
    pub direction: Ways,
    /// Several clearances, a sweep for each [default: that of the machine]
    #[arg(
        long,
        value_name = "RHO,…",
        value_delimiter = ',',
        conflicts_with = "clearance"
    )]
    pub clearances: Vec<f64>,
    /// Distance within which a state has returned, in units of the motion's size, > 0 and < 1
    #[arg(long, value_name = "SHARE", default_value_t = 1e-4)]
    pub tolerance: f64,
    /// Go on with a sweep that was interrupted, from the same arguments
    #[arg(long)]
    pub resume: bool,
    /// Folder for sweep.csv, sweep.svg and sweep.json
    #[arg(long, value_name = "DIR", default_value = "softstop-sweep")]
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

const FILES: [(&str, &str); 3] = [
    ("table", "sweep.csv"),
    ("chart", "sweep.svg"),
    ("report", "sweep.json"),
];
/// How often what is done is kept for `--resume`.
const KEEPING: Duration = Duration::from_secs(10);

/// Sweeps, writes table and chart, and says where the motion jumps.
///
/// # Errors
/// [`Failure::Usage`] for values that cannot be, [`Failure::Run`] if the folder cannot be written,
/// [`Failure::Suspended`] after Ctrl-C.
pub fn run(arguments: &SweepArguments) -> Result<(), Failure> {
    let plan = plan(arguments)?;
    let mut chains = chains(arguments)?;
    let export = Export::open(&arguments.output, &FILES)?;
    let keep = Keep::new(&arguments.output, &plan, &chains);
    if arguments.resume {
        keep.restore(&mut chains)?;
    }
    follow(&plan, &mut chains, &keep)?;
    export.table("table", &report::columns(), report::rows(&plan, &chains))?;
    let chart = SweepChart::new(&plan, &chains).svg();
    export.file("chart", chart.as_bytes())?;
    export.finish(&SweepReport::new(&plan, &chains), arguments.format)?;
    keep.forget();
    Ok(())
}

fn plan(arguments: &SweepArguments) -> Result<Plan, Failure> {
    let (steps, periods) = (arguments.steps, arguments.periods);
    let fits = (2..=10_000_000).contains(&steps);
    require(fits, "steps", steps as f64, "2 to 10000000")?;
    let fits = (1..=1_000_000).contains(&periods);
    require(fits, "periods", periods as f64, "1 to 1000000")?;
    let tolerance = arguments.tolerance;
    let fits = tolerance > 0.0 && tolerance < 1.0;
    require(fits, "tolerance", tolerance, "> 0 and < 1")?;
    let range = (arguments.from, arguments.to);
    let plan = Plan::new(arguments.parameter, range, steps, periods)
        .map_err(|error| Failure::usage(error.to_string()))?;
    Ok(Plan { tolerance, ..plan })
}

/// A chain for each clearance and each way; refuses what no machine can have at either end.
fn chains(arguments: &SweepArguments) -> Result<Vec<Chain<Model>>, Failure> {
    let model = match &arguments.file {
        Some(path) if arguments.machine == SceneSettings::default() => {
            Model::Scene(Box::new(scene_file::read(path)?.scene))
        }
        Some(path) => {
            return Err(Failure::usage(format!(
                "{}: a scene file says all of the machine; it goes with none of the paper's ratios",
                path.display()
            )));
        }
        None => Model::Paper(machine::machine(
            arguments.scene.as_ref(),
            &arguments.machine,
        )?),
    };
    let parameter = arguments.parameter;
    if !arguments.clearances.is_empty() && parameter == Parameter::Clearance {
        return Err(Failure::usage(
            "--clearances: the clearance itself is swept; give --from and --to only",
        ));
    }
    let mut machines = Vec::new();
    for clearance in &arguments.clearances {
        let mut machine = model.clone();
        machine.set(Parameter::Clearance, *clearance);
        machines.push(machine);
    }
    if machines.is_empty() {
        machines.push(model);
    }
    for machine in &machines {
        check(machine, parameter, [arguments.from, arguments.to])?;
    }
    let ways = arguments.direction.directions();
    let of_machine = |machine: &Model| {
        ways.iter()
            .map(|way| Chain::new(machine.clone(), *way))
            .collect::<Vec<_>>()
    };
    Ok(machines.iter().flat_map(of_machine).collect())
}

fn check(machine: &Model, parameter: Parameter, ends: [f64; 2]) -> Result<(), Failure> {
    if machine.value(parameter).is_none() {
        let name = parameter.name();
        return Err(Failure::usage(format!(
            "--parameter {name}: this machine has none"
        )));
    }
    for value in ends {
        let mut machine = machine.clone();
        machine.set(parameter, value);
        machine
            .scene()
            .map_err(|error| Failure::usage(error.to_string()))?;
    }
    Ok(())
}

/// Carries the chains on to their ends, and keeps what is done from time to time.
fn follow(plan: &Plan, chains: &mut [Chain<Model>], keep: &Keep) -> Result<(), Failure> {
    let all = (plan.steps * chains.len()) as u64;
    let progress = Progress::new(all, "steps");
    let done =
        |chains: &[Chain<Model>]| chains.iter().map(|chain| chain.steps.len()).sum::<usize>();
    progress.at(done(chains) as u64);
    loop {
        let begin = Instant::now();
        let finished = plan.run(chains, &|steps| {
            progress.more(steps);
            !interrupt::requested() && begin.elapsed() < KEEPING
        });
        if finished {
            return Ok(());
        }
        keep.store(chains)?;
        if interrupt::requested() {
            return Err(Failure::Suspended(format!(
                "{} of {all} steps are done; the same line with --resume goes on",
                done(chains)
            )));
        }
    }
}
