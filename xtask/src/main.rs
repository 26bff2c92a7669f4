//! Tasks of the workspace, run as `cargo xtask <task>`.

mod archive;
mod book;
mod darwin;
mod explorer;
mod fmu;
mod library;
mod manual;
mod notices;
mod portable;
mod python;
mod run;
mod system;
mod targets;
mod wheel;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::slice;

use anyhow::{Result, ensure};
use clap::{Parser, Subcommand};

use fmu::STANDARDS;
use run::{cargo, cargo_command, run, stage};
use softstop_optimize::fmu::{Standard, version_parser};

/// Tasks of the workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", after_help = "Example: cargo xtask test")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Before each commit: format, clippy and the tests that take seconds
    Check,
    /// Write softstop.fmu, drive.fmu, feeder.fmu, the machine that they make (piercing-machine.ssp),
    /// modelDescription.xml and, for FMI 3.0, softstop-fmi3.fmu, drive-fmi3.fmu, feeder-fmi3.fmu and
    /// piercing-machine-fmi3.ssp at the top level
    Fmu {
        /// Only those for this version of FMI
        #[arg(long, value_parser = version_parser(), value_name = "VERSION")]
        fmi: Option<Standard>,
        /// As it is shipped: optimized as a whole, and for any Linux with version 2.17 of the C library or a
        /// later one; without it the library of the daily build, for this machine's C library
        #[arg(long)]
        dist: bool,
        /// As it is shipped, with a library for every platform: Linux (x86-64, AArch64), Windows and macOS
        #[arg(long)]
        all_targets: bool,
    },
    /// Write modelDescription.xml at the top level
    Xml,
    /// Write the notices of the crates in the library to fmu/assets/third-party.txt
    Notices,
    /// Run one C program on the libraries for Linux and for Windows (under Wine) and compare
    Wine,
    /// Build the FMU as it is shipped and run all tests: in Rust, with FMPy and with other importers
    Test,
    /// Build the FMU of daily work and run the tests with FMPy only
    Fmpy,
    /// Build the FMU of daily work and run the tests with other importers only
    Importers,
    /// Write the Python package as a wheel for this machine into target/wheels
    Wheel {
        /// As it is shipped, for every platform: Linux (glibc 2.17, musl), Windows and macOS
        #[arg(long)]
        all_targets: bool,
        /// The source distribution instead, or beside the wheels for every platform
        #[arg(long)]
        sdist: bool,
    },
    /// Write the programs for this machine, as they are shipped, with their manual into target/archive
    Archive,
    /// Build the wheel and the program and run the package's tests only
    Python,
    /// Build the program and run the tests of its pages in a headless Chromium only
    Pages,
    /// Build the engine as WebAssembly, the program that holds it, and the page of the explorer
    Explorer,
    /// Test the pages of the guide with all that they show, and build it as a book with mdBook
    Book,
    /// Write the manual pages of softstop, and completions for shells, into the target folder
    Manual,
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
        Task::Check => check(),
        Task::Fmu {
            fmi,
            dist,
            all_targets,
        } => {
            fmu::write_description()?;
            let standards = fmi.as_ref().map_or(&STANDARDS[..], slice::from_ref);
            if *all_targets {
                fmu::write_shipped_for_all(standards)
            } else if *dist {
                fmu::write_shipped(standards).map(drop)
            } else {
                fmu::write_package(standards).map(drop)
            }
        }
        Task::Xml => fmu::write_description(),
        Task::Notices => notices::write(),
        Task::Wine => portable::compare_under_wine(),
        Task::Test => {
            stage("FMU");
            let package = fmu::write_shipped(&STANDARDS)?;
            stage("Rust tests");
            run(cargo_command()
                .args(["test", "--release", "--workspace", "--no-fail-fast"])
                // Criterion asks for other features of shared crates: they would be built again.
                .args(["--exclude", "softstop-benches"])
                // A Python loads it, and not every one has a library to link it with.
                .args(["--exclude", "softstop-python"])
                .env("SOFTSTOP_FMU", &package))?;
            test_with_fmpy(&package)?;
            test_with_importers(&package)?;
            test_pages()?;
            test_wheel()?;
            stage("the library for Windows under Wine");
            portable::compare_under_wine()?;
            stage("all passed");
            Ok(())
        }
        Task::Fmpy => {
            build_program()?;
            test_with_fmpy(&build()?)
        }
        Task::Importers => test_with_importers(&build()?),
        Task::Wheel { all_targets, sdist } => wheel::write(*all_targets, *sdist),
        Task::Archive => {
            println!("written: {}", archive::write()?.display());
            Ok(())
        }
        Task::Python => {
            build_program()?;
            test_wheel()
        }
        Task::Pages => {
            build_program()?;
            test_pages()
        }
        Task::Explorer => {
            ensure!(explorer::is_installed()?, "{}", explorer::MISSING);
            explorer::write().map(drop)
        }
        Task::Book => {
            println!("written: {}", book::write()?.display());
            Ok(())
        }
        Task::Manual => {
            println!("written: {}", manual::write()?.display());
            Ok(())
        }
        Task::Bench => {
            cargo("bench --profile dist --package softstop-benches")?;
            cargo("bench --profile dist --package softstop-fmu --bench c_speed")
        }
    }
}

/// What a contributor asks before each commit: rooms whose tests take seconds are tested whole, the others by the tests
/// beside their code.
fn check() -> Result<()> {
    stage("format");
    cargo("fmt --all --check")?;
    stage("lints");
    cargo("clippy --release --workspace --all-targets -- -D warnings")?;
    stage("unit tests");
    cargo(
        "test --release --workspace --exclude softstop-benches --exclude softstop-python --lib --quiet",
    )?;
    stage("quick rooms");
    let quick = "lanes console fmi explore units testing".split(' ');
    let packages: String = quick.map(|room| format!(" -p softstop-{room}")).collect();
    cargo(&format!("test --release{packages} --tests --quiet"))?;
    cargo("test --release -p softstop --test optimize --quiet -- simulate refusals")
}

fn build() -> Result<PathBuf> {
    stage("FMU");
    fmu::write_package(&STANDARDS)
}

fn build_program() -> Result<()> {
    stage("program");
    cargo("build --release --package softstop")
}

fn test_with_fmpy(package: &Path) -> Result<()> {
    stage("FMPy tests");
    python::test(package)
}

fn test_pages() -> Result<()> {
    stage("pages in a headless Chromium");
    match explorer::is_installed()? {
        true => explorer::build()?,
        false => println!("left out, the page of the explorer: {}", explorer::MISSING),
    }
    python::test_pages()
}

fn test_wheel() -> Result<()> {
    stage("Python package");
    wheel::test()
}

fn test_with_importers(package: &Path) -> Result<()> {
    stage("tests with other importers");
    python::test_importers(package)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// The text of a workflow and its name.
    fn workflows() -> impl Iterator<Item = (PathBuf, String)> {
        let folder = run::top().join(".github/workflows");
        let entries = fs::read_dir(folder).expect("the workflows");
        entries.map(|entry| {
            let path = entry.expect("an entry").path();
            let text = fs::read_to_string(&path).expect("a workflow");
            (path, text)
        })
    }

    #[test]
    fn workflows_name_tasks_that_exist() {
        let mut count = 0;
        for (path, text) in workflows() {
            for rest in text.split("cargo xtask ").skip(1) {
                let end = rest.find(['\n', '&']).unwrap_or(rest.len());
                let line = ["xtask"].into_iter().chain(rest[..end].split_whitespace());
                let parsed = Arguments::try_parse_from(line);
                assert!(parsed.is_ok(), "{}: {}", path.display(), &rest[..end]);
                count += 1;
            }
        }
        assert!(count >= 6, "{count} commands");
    }

    #[test]
    fn workflows_pin_actions_limit_times_and_begin_without_permissions() {
        for (path, text) in workflows() {
            let named = path.display();
            for action in text.lines().filter_map(|line| line.split_once("uses: ")) {
                let (_, commit) = action.1.split_once('@').expect("a version");
                let (commit, version) =
                    commit.split_once(" # v").expect("a commit and its version");
                assert!(
                    commit.len() == 40 && !version.is_empty(),
                    "{named}: {commit}"
                );
            }
            let count = |what: &str| text.matches(what).count();
            assert_eq!(count("runs-on:"), count("timeout-minutes:"), "{named}");
            assert!(
                text.contains("\npermissions:\n  contents: read\n"),
                "{named}"
            );
        }
    }
}
