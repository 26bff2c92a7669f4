//! One C program on the library for Linux and, under Wine, on the one for Windows.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};
use softstop_fmu::{Imprint, Machine, Standard, guid_of, table};

use crate::library::Artifact;
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

/// Runs the default machine on both libraries and fails if they differ. Where Wine or the tools that
/// build for Windows are missing it says so.
pub fn compare_under_wine() -> Result<()> {
    let Some(wine) = wine() else {
        println!("left out: neither wine64 nor wine is here");
        return Ok(());
    };
    let tools = Tools::new();
    let platforms = [
        ("linux64", "x86_64-linux-gnu"),
        ("win64", "x86_64-windows-gnu"),
    ];
    for (platform, _) in platforms {
        if let Err(error) = Target::of(platform)?.prepare(&tools) {
            println!("left out: {error:#}");
            return Ok(());
        }
    }
    let [linux, windows] =
        platforms.map(|(platform, zig_target)| Program::build(platform, zig_target, &tools));
    let (linux, windows) = (linux?, windows?);
    let linux = linux.results(Command::new(&linux.program))?;
    let mut under_wine = Command::new(wine);
    under_wine.arg(&windows.program).env("WINEDEBUG", "-all");
    let windows = windows.results(under_wine)?;
    stage("outputs on Linux and on Windows");
    ensure!(
        !linux.is_empty() && linux.len() == windows.len(),
        "{} outputs on Linux, {} on Windows",
        linux.len(),
        windows.len()
    );
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

/// The C program and the library for one platform.
struct Program {
    library: PathBuf,
    program: PathBuf,
}

impl Program {
    fn build(platform: &str, zig_target: &str, tools: &Tools) -> Result<Self> {
        stage(platform);
        let folder = target().join("portable").join(platform);
        fs::create_dir_all(&folder)?;
        let library = folder.join("softstop.library");
        let artifact = Artifact::of::<Machine>(Standard::Fmi2);
        fs::write(
            &library,
            Target::of(platform)?.build(artifact, tools)?.bytes,
        )?;
        let program = folder.join("portable.exe");
        run(tools
            .zig_cc()?
            .args(["-target", zig_target, "-O2", "-Wall", "-Wextra", "-Werror"])
            .arg("-o")
            .args([&program, Path::new(SOURCE)]))?;
        Ok(Self { library, program })
    }

    /// What the program prints of the outputs, started by `command`.
    fn results(&self, mut command: Command) -> Result<Vec<(String, f64)>> {
        command
            .arg(&self.library)
            .arg(guid_of(&Imprint::library()))
            .args([STOP_TIME, STEP]);
        for name in OUTPUTS {
            let variable = table()
                .by_name(name)
                .with_context(|| format!("no variable {name}"))?;
            command.args([name, &variable.reference.to_string()]);
        }
        output(&mut command)?.lines().map(parse).collect()
    }
}

fn parse(line: &str) -> Result<(String, f64)> {
    let (name, value) = line.split_once(' ').context("a name and a value")?;
    Ok((name.to_owned(), value.trim().parse()?))
}
