//! One C program on the library for Linux and, under Wine, on the one for Windows.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use softstop_fmu::variables::by_name;
use softstop_fmu::{StartValues, guid_of};

use crate::run::{output, run, stage, target};
use crate::targets::{Target, Tools};

const SOURCE: &str = "fmu/tests/c/portable.c";
const OUTPUTS: [&str; 5] = [
    "position",
    "velocity",
    "impact.time",
    "impact.velocity",
    "energy.dissipated",
];
const STOP_TIME: &str = "100";
const STEP: &str = "0.25";

/// The two machines differ in their sine and exponential functions alone.
const TOLERANCE: f64 = 1e-12;

/// Runs the default machine on both libraries and fails if they differ.
pub fn compare_under_wine() -> Result<()> {
    let Some(wine) = wine() else {
        println!("skipped: neither wine64 nor wine is here");
        return Ok(());
    };
    let tools = Tools::new();
    let linux = results("linux64", "x86_64-linux-gnu", None, &tools)?;
    let windows = results("win64", "x86_64-windows-gnu", Some(&wine), &tools)?;
    stage("outputs on Linux and on Windows");
    for ((name, linux), (_, windows)) in linux.iter().zip(&windows) {
        println!("{name:18} {linux:.17e} {windows:.17e}");
        let difference = (linux - windows).abs();
        ensure!(
            difference <= TOLERANCE * linux.abs().max(1.0),
            "{name} differs by {difference:e}"
        );
    }
    Ok(())
}

/// The program that runs those of Windows.
fn wine() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    ["wine64", "wine"].iter().find_map(|name| {
        std::env::split_paths(&path)
            .map(|folder| folder.join(name))
            .find(|program| program.is_file())
    })
}

/// Builds library and program for one platform and runs them.
fn results(
    platform: &str,
    zig_target: &str,
    runner: Option<&Path>,
    tools: &Tools,
) -> Result<Vec<(String, f64)>> {
    stage(platform);
    let folder = target().join("portable").join(platform);
    fs::create_dir_all(&folder)?;
    let library = folder.join("softstop.library");
    fs::write(&library, Target::of(platform)?.build(tools)?.bytes)?;
    let program = folder.join("portable.exe");
    run(tools
        .zig_cc()?
        .args(["-target", zig_target, "-O2", "-Wall", "-Wextra", "-Werror"])
        .arg("-o")
        .args([&program, Path::new(SOURCE)]))?;
    let mut command = match runner {
        Some(runner) => {
            let mut command = Command::new(runner);
            command.arg(&program).env("WINEDEBUG", "-all");
            command
        }
        None => Command::new(&program),
    };
    command
        .arg(&library)
        .arg(guid_of(&StartValues::DEFAULT)?)
        .args([STOP_TIME, STEP]);
    for name in OUTPUTS {
        let variable = by_name(name).with_context(|| format!("no variable {name}"))?;
        command.args([name, &variable.reference.to_string()]);
    }
    output(&mut command)?.lines().map(parse).collect()
}

fn parse(line: &str) -> Result<(String, f64)> {
    let (name, value) = line.split_once(' ').context("a name and a value")?;
    Ok((name.to_owned(), value.trim().parse()?))
}
