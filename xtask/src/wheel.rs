//! The Python package: its wheels, its source distribution and its tests.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use crate::darwin;
use crate::library::remaps;
use crate::notices::{WHEEL, notices};
use crate::python::{environment, pytest_of};
use crate::run::{run, stage, target, top};
use crate::targets::{Tools, install_standard_library};

/// Rust's names of the targets that wheels are shipped for, and what maturin wants added for them. Zig links for version
/// 2.17 of glibc unless something else is said.
const TARGETS: [(&str, &[&str]); 7] = [
    ("x86_64-unknown-linux-gnu", &[]),
    ("aarch64-unknown-linux-gnu", &[]),
    ("x86_64-unknown-linux-musl", MUSL),
    ("aarch64-unknown-linux-musl", MUSL),
    ("x86_64-pc-windows-gnu", &[]),
    ("x86_64-apple-darwin", &[]),
    ("aarch64-apple-darwin", &[]),
];

const MUSL: &[&str] = &["--compatibility", "musllinux_1_2"];

/// The first moment that a wheel can name as the time of its files.
const EARLIEST: &str = "315532800";

/// Writes what is asked for into an empty folder of wheels.
pub fn write(all_targets: bool, sdist: bool) -> Result<()> {
    let tools = Tools::new();
    prepare()?;
    if sdist {
        run(maturin(&tools, "sdist")?.env("SOURCE_DATE_EPOCH", EARLIEST))?;
    }
    if all_targets {
        write_shipped(&tools)?;
    } else if !sdist {
        write_daily(&tools)?;
    }
    for path in written()? {
        let size = fs::metadata(&path)?.len().div_ceil(1024);
        println!("{} ({size} KiB)", path.display());
    }
    Ok(())
}

/// Builds the wheel for this machine, installs it into an environment of its own and runs the package's tests there.
pub fn test() -> Result<()> {
    prepare()?;
    write_daily(&Tools::new())?;
    let python = environment("package", "python/tests/requirements.txt")?;
    run(Command::new(&python)
        .args(["-m", "pip", "install", "--quiet"])
        .args([
            "--disable-pip-version-check",
            "--force-reinstall",
            "--no-deps",
        ])
        .args(written()?))?;
    run(&mut pytest_of(&python, "python/tests"))
}

fn folder() -> PathBuf {
    target().join("wheels")
}

fn written() -> Result<Vec<PathBuf>> {
    let files = fs::read_dir(folder())?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<_> = files.collect::<Result<_>>()?;
    files.sort();
    Ok(files)
}

/// Empties the folder of wheels and writes the notices of the crates in them.
fn prepare() -> Result<()> {
    let folder = folder();
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    fs::create_dir_all(&folder)?;
    let path = top().join("python/NOTICE");
    fs::write(&path, notices(&WHEEL)?).with_context(|| path.display().to_string())
}

/// Maturin, which takes the crate and its bindings from the file `pyproject.toml` of the folder where it runs.
fn maturin(tools: &Tools, task: &str) -> Result<Command> {
    let mut command = tools.maturin()?;
    command
        .current_dir(top().join("python"))
        .args([task, "--out"])
        .arg(folder());
    Ok(command)
}

/// How maturin builds, apart from all other builds: its crates have other features, and one of both would replace the
/// library of the FMU that the other holds.
fn build(tools: &Tools, profile: &str) -> Result<Command> {
    let mut command = maturin(tools, "build")?;
    command
        .args(["--locked", "--profile", profile, "--target-dir"])
        .arg(target().join("extension"));
    Ok(command)
}

fn write_daily(tools: &Tools) -> Result<()> {
    run(&mut build(tools, "release")?)
}

/// Left out are targets whose standard library cannot be had; where it is there, a build that fails is an error.
fn write_shipped(tools: &Tools) -> Result<()> {
    for (triple, arguments) in TARGETS {
        stage(triple);
        if let Err(error) = install_standard_library(triple) {
            println!("skipped: {error:#}");
            continue;
        }
        let mut command = build(tools, "dist")?;
        if triple.contains("apple") {
            command.env("SDKROOT", darwin::kit(&tools.zig_library()?)?);
        }
        if triple.contains("windows") {
            // With --zig it would ask every library that is linked for the function that starts the module.
            command.env("CARGO", tools.cargo_zigbuild()?.get_program());
        } else {
            command.arg("--zig");
        }
        run(command
            .args(["--target", triple])
            .args(arguments)
            .env("SOURCE_DATE_EPOCH", EARLIEST)
            .env_remove("RUSTFLAGS")
            .env("CARGO_ENCODED_RUSTFLAGS", remaps()?.join("\u{1f}")))?;
    }
    Ok(())
}
