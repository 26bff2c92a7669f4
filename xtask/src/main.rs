//! Tasks of the workspace, run as `cargo xtask <task>`.

mod fmu;
mod python;
mod run;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

use run::{cargo, stage};

/// Tasks of the workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", after_help = "Example: cargo xtask test")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Build the FMU and write softstop.fmu and modelDescription.xml at the top level
    Fmu,
    /// Write modelDescription.xml at the top level
    Xml,
    /// Build the FMU and run all tests, those in Rust and those with FMPy
    Test,
    /// Build the FMU and run the tests with FMPy only
    Fmpy,
    /// Run the benchmarks
    Bench,
}

fn main() -> ExitCode {
    match run_task(&Arguments::parse().task) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run_task(task: &Task) -> Result<()> {
    match task {
        Task::Fmu => {
            fmu::write_description()?;
            fmu::write_package().map(drop)
        }
        Task::Xml => fmu::write_description(),
        Task::Test => {
            let package = build()?;
            stage("Rust tests");
            cargo(&["test", "--workspace"])?;
            test_with_fmpy(&package)
        }
        Task::Fmpy => test_with_fmpy(&build()?),
        Task::Bench => cargo(&["bench", "--workspace", "--benches"]),
    }
}

fn build() -> Result<PathBuf> {
    stage("FMU");
    fmu::write_package()
}

fn test_with_fmpy(package: &Path) -> Result<()> {
    stage("FMPy tests");
    python::test(package)?;
    stage("all passed");
    Ok(())
}
