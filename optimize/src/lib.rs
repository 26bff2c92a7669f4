//! The program `softstop`: simulated motions, periodic motions, hysteresis zones and optimal
//! designs of machines whose mass strikes a stop (F. Peterka, Chaos, Solitons & Fractals 18
//! (2003) 79-88).
//!
//! One way through it: [`arguments`] and [`configuration`] turn what the user wrote into a
//! [`arguments::Machine`], [`scene_file`] reads any scene; a subcommand ([`orbit`], [`motions`],
//! [`continuation`], [`sweep`], [`basin`], [`table1`], [`paper`], [`zone`], [`optimize`], [`simulate`],
//! [`stops`], [`fidelity`], [`charts`], [`throughput`]) asks the core or the search in [`design`]; [`report`]
//! and [`chart`] say and draw the answer; [`output`] puts files in place whole or not at all.

pub mod arguments;
pub mod basin;
pub mod chart;
pub mod charts;
pub mod configuration;
pub mod continuation;
pub mod design;
pub mod failure;
pub mod failures;
pub mod fidelity;
pub mod filter;
pub mod interrupt;
pub mod motions;
pub mod optimize;
pub mod orbit;
pub mod output;
pub mod paper;
pub mod precision;
pub mod progress;
pub mod reference;
pub mod report;
pub mod scene_file;
pub mod simulate;
pub mod solvers;
pub mod stops;
pub mod sweep;
pub mod table1;
pub mod throughput;
pub mod zone;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;

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
  softstop orbit --frequency 1.15 --clearance 10   the paper's point A
  softstop motions --frequency 0.9875              all motions: z = 2/3, (2/4)B, chaos
  softstop zone --regime loaded --clearance 10     where impacts and rest coexist
  softstop continue --parameter eta --from 0.9 --to 1.5   its branch with folds and flips
  softstop sweep --from 0.8 --to 1.8               bifurcation diagram, up and down
  softstop basin --size 1000                       which start leads to which motion
  softstop table1                                  the paper's Table 1, found anew
  softstop paper                                   all its figures, found anew
  softstop simulate docs/scenes/hertz.toml         any machine with any stop, in SI units
  softstop stops                                   pictures of all the stops' laws
  softstop fidelity B --tolerance 0.02             the simplest model that will do
  softstop chart precision periodic                speed against accuracy of all methods
  softstop chart failures                          where fixed-step methods fail, and how
  softstop throughput                              how many drive periods a second

Exit codes: 0 done, 1 the run could not do it, 2 bad usage or values, 130 interrupted.
optimize, orbit, zone and continue use the paper's dimensionless ratios: m = k1 = F0 = 1.";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The stable motion with one impact per period of the drive (z = 1)
    Orbit(orbit::OrbitArguments),
    /// All motions on which a machine settles: regimes, chaos, basins' shares
    Motions(motions::MotionsArguments),
    /// Follow a periodic motion along a parameter, through folds, with all its bifurcations
    Continue(continuation::ContinueArguments),
    /// The paper's Table 1 found anew: 19 transitions with their types
    Table1(table1::TableArguments),
    /// The paper's figures drawn anew, and what it only describes
    Paper(paper::PaperArguments),
    /// The hysteresis zone of a clearance: from grazing (g0) to the fold (s_SN)
    Zone(zone::ZoneArguments),
    /// A parameter up and down: bifurcation diagram, jumps, hysteresis
    Sweep(sweep::SweepArguments),
    /// Which initial states lead to which motion
    Basin(basin::BasinArguments),
    /// Search stiffness, clearance and frequency for the hardest impact
    Optimize(optimize::OptimizeArguments),
    /// Run any scene: a motion as tables, a chart and a summary
    Simulate(simulate::SimulateArguments),
    /// Draw the laws of all stops: contact force over deflection
    Stops(stops::StopsArguments),
    /// How simple a model of a scene may be: error and cost of ever simpler stops
    Fidelity(fidelity::FidelityArguments),
    /// Chart methods of computing a motion: speed against accuracy
    Chart(charts::ChartsArguments),
    /// How fast the engines are, and whether the fast one counts the same impacts
    Throughput(throughput::ThroughputArguments),
}

/// Reads the command line, does what it says and turns the outcome into an exit code.
pub fn main() -> ExitCode {
    let line = CommandLine::parse();
    match run(line.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}

/// Carries out one subcommand.
///
/// # Errors
/// [`Failure`] says whether the user's values, the run or an interrupt ended it.
pub fn run(command: Command) -> Result<(), Failure> {
    interrupt::install();
    match command {
        Command::Orbit(arguments) => orbit::run(&arguments),
        Command::Motions(arguments) => motions::run(&arguments),
        Command::Continue(arguments) => continuation::run(&arguments),
        Command::Table1(arguments) => table1::run(&arguments),
        Command::Paper(arguments) => paper::run(&arguments),
        Command::Zone(arguments) => zone::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Basin(arguments) => basin::run(&arguments),
        Command::Optimize(arguments) => optimize::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Stops(arguments) => stops::run(&arguments),
        Command::Fidelity(arguments) => fidelity::run(&arguments),
        Command::Chart(arguments) => charts::run(&arguments),
        Command::Throughput(arguments) => throughput::run(&arguments),
    }
}
