//! The program `softstop`: simulated motions, periodic motions, hysteresis zones and optimal
//! designs of machines whose mass strikes a stop (F. Peterka, Chaos, Solitons & Fractals 18
//! (2003) 79-88).
//!
//! The commands that look at one machine are in `softstop-explore`; here are the search ([`design`]), its
//! command ([`optimize`]) and [`report`], and machines as FMUs ([`fmu`]).

mod cases;
mod comparison;
pub mod design;
pub mod fmu;
mod limits;
pub mod optimize;
mod order;
pub mod page;
mod pareto;
mod placed;
pub mod report;
pub mod robust;
pub mod searched;
pub mod spread;
mod started;
mod tolerated;
mod verdict;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use softstop_console::failure::Failure;
use softstop_console::{output, schema};
use softstop_explore::{
    basin, continuation, explorer, fidelity, motions, orbit, prove, simulate, stops, study, sweep,
    watch, zone,
};

/// Exact dynamics and optimal design of impact oscillators with soft, preloaded and rigid stops.
#[derive(Debug, Parser)]
#[command(name = "softstop", version, arg_required_else_help = true, after_help = EXAMPLES)]
pub struct CommandLine {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  softstop optimize                                the best design beside points A and B
  softstop orbit --set eta=1.15 --set clearance=10 the paper's point A
  softstop motions --set eta=0.9875                all motions: z = 2/3, (2/4)B, chaos
  softstop zone loaded --set clearance=10          where impacts and rest coexist
  softstop continue --parameter eta --from 0.9 --to 1.5   its branch with folds and flips
  softstop prove A --output a.json                 point A by interval arithmetic, with a certificate
  softstop sweep --from 0.8 --to 1.8               bifurcation diagram, up and down
  softstop basin --size 1000                       which start leads to which motion
  softstop study docs/studies/map.toml             a map over two parameters, or millions of machines
  softstop simulate docs/scenes/hertz.toml         any machine with any stop, in SI units
  softstop watch loaded                            the same as a page that plays the motion
  softstop explore loaded                          drag its clearance: the diagram follows
  softstop fmu docs/scenes/hertz.toml              the same machine for FMI 2.0 co-simulation
  softstop schema > machine.schema.json            what machine files may hold, for editors
  softstop schema task > task.schema.json          what the files of optimize --config may hold
  softstop schema study > study.schema.json        what the files of study may hold
  softstop stops                                   pictures of all the stops' laws
  softstop fidelity B --tolerance 0.02             the simplest model that will do

Exit codes: 0 done, 1 the run could not do it, 2 bad usage or values, 128 + n
ended by signal n (130: Ctrl-C; 141: nobody reads the output).
A MACHINE is a TOML file in SI units or ratios, or one of the paper's, unloaded or loaded; --set changes it.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The stable motion with one impact per period of the drive (z = 1)
    Orbit(orbit::OrbitArguments),
    /// All motions on which a machine settles: regimes, chaos, basins' shares
    Motions(motions::MotionsArguments),
    /// Follow a periodic motion along a parameter, through folds, with all its bifurcations
    Continue(continuation::ContinueArguments),
    /// The hysteresis zone of a clearance: from grazing (g0) to the fold (s_SN)
    Zone(zone::ZoneArguments),
    /// Prove a periodic motion, or its fold, flip or grazing, by interval arithmetic
    Prove(prove::ProveArguments),
    /// A parameter up and down: bifurcation diagram, jumps, hysteresis
    Sweep(sweep::SweepArguments),
    /// Which initial states lead to which motion
    Basin(basin::BasinArguments),
    /// Many machines from a study file: grids and samples, resumable, in shards
    Study(study::StudyArguments),
    /// Search stiffness, clearance and frequency for the hardest impact
    Optimize(optimize::OptimizeArguments),
    /// Pack a machine as an FMU for co-simulation
    Fmu(fmu::FmuArguments),
    /// Print the JSON Schema of files of machines, tasks or studies, for editors
    Schema {
        /// Which files
        #[arg(value_enum, default_value_t, value_name = "FILES")]
        of: Files,
    },
    /// Run any scene: a motion as tables, a chart and a summary
    Simulate(simulate::SimulateArguments),
    /// Play a run in a browser: one page with machine, time series, phase plane and sound
    Watch(watch::WatchArguments),
    /// Drag a machine's numbers in a browser: its bifurcation diagram and motions follow
    Explore(explorer::ExploreArguments),
    /// Draw the laws of all stops: contact force over deflection
    Stops(stops::StopsArguments),
    /// How simple a model of a scene may be: error and cost of ever simpler stops
    Fidelity(fidelity::FidelityArguments),
}

/// Files that are written by hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Files {
    /// A machine
    #[default]
    Machine,
    /// A task of `softstop optimize --config`
    Task,
    /// A study of `softstop study`
    Study,
}

/// Reads the command line, does what it says and turns the outcome into an exit code.
pub fn main() -> ExitCode {
    softstop_console::main(|line: CommandLine| run(line.command))
}

/// Runs the program with the words of a command line, its name first, and returns its exit code.
pub fn main_of(line: Vec<OsString>) -> u8 {
    softstop_console::main_of(line, |line: CommandLine| run(line.command))
}

/// Carries out one subcommand.
pub fn run(command: Command) -> Result<(), Failure> {
    optimize::check_tasks();
    match command {
        Command::Orbit(arguments) => orbit::run(&arguments),
        Command::Motions(arguments) => motions::run(&arguments),
        Command::Continue(arguments) => continuation::run(&arguments),
        Command::Zone(arguments) => zone::run(&arguments),
        Command::Prove(arguments) => prove::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Basin(arguments) => basin::run(&arguments),
        Command::Study(arguments) => study::run(&arguments),
        Command::Optimize(arguments) => optimize::run(&arguments),
        Command::Fmu(arguments) => fmu::run(&arguments),
        Command::Schema { of } => output::print(&output::json(&match of {
            Files::Machine => schema::machine(),
            Files::Task => optimize::task_schema(),
            Files::Study => study::schema(),
        })?),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Watch(arguments) => watch::run(&arguments),
        Command::Explore(arguments) => explorer::run(&arguments),
        Command::Stops(arguments) => stops::run(&arguments),
        Command::Fidelity(arguments) => fidelity::run(&arguments),
    }
}
