//! The program `softstop-lab`: the exact method beside others ([`methods`], foreign [`solvers`], stored
//! [`mod@reference`] motions), what accuracy costs ([`precision`]), where fixed steps fail ([`failures`]),
//! how fast the engines are ([`throughput`]), and the paper, drawn anew (`softstop-paper`).
#![forbid(unsafe_code)]

pub mod failures;
pub mod filter;
pub mod methods;
pub mod precision;
pub mod reference;
pub mod scenes;
pub mod solvers;
pub mod throughput;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use softstop_console::failure::Failure;
use softstop_paper::table1;

/// The laboratory of softstop: methods measured against the exact one, and the paper drawn anew.
#[derive(Debug, Parser)]
#[command(name = "softstop-lab", version, arg_required_else_help = true, after_help = EXAMPLES)]
pub struct CommandLine {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  softstop-lab table1                     the paper's Table 1, found anew
  softstop-lab paper                      all its figures, found anew
  softstop-lab chart precision periodic   speed against accuracy of all methods
  softstop-lab chart failures             where fixed-step methods fail, and how
  softstop-lab throughput                 how many drive periods a second

Exit codes: 0 done, 1 the run could not do it, 2 bad usage or values, 128 + n
ended by signal n (130: Ctrl-C; 141: nobody reads the output).";

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The paper's Table 1 found anew: 19 transitions with their types
    Table1(table1::TableArguments),
    /// The paper's figures drawn anew, and what it only describes
    Paper(softstop_paper::PaperArguments),
    /// Chart methods of computing a motion: speed against accuracy
    #[command(subcommand)]
    Chart(Chart),
    /// How fast the engines are, and whether the fast one counts the same impacts
    Throughput(throughput::ThroughputArguments),
}

/// The charts to be had.
#[derive(Debug, Subcommand)]
pub enum Chart {
    /// Speed against accuracy of all methods on one scene
    Precision(precision::PrecisionArguments),
    /// Where fixed-step methods fail: over step and stop stiffness
    Failures(failures::FailuresArguments),
}

/// Reads the command line, does what it says and turns the outcome into an exit code.
pub fn main() -> ExitCode {
    softstop_console::main(|line: CommandLine| run(line.command))
}

/// Carries out one subcommand.
///
/// # Errors
/// [`Failure`] says whether the user's values, the run or an interrupt ended it.
pub fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Table1(arguments) => table1::run(&arguments),
        Command::Paper(arguments) => softstop_paper::run(&arguments),
        Command::Chart(Chart::Precision(arguments)) => precision::run(&arguments),
        Command::Chart(Chart::Failures(arguments)) => failures::run(&arguments),
        Command::Throughput(arguments) => throughput::run(&arguments),
    }
}
