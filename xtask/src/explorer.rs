//! The page of the explorer: its engine as WebAssembly, and the program that holds it.

use std::fs::{self, File};
use std::io::{Write, copy};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::run::{cargo, cargo_command, output, run, target, top};

const TRIPLE: &str = "wasm32-unknown-unknown";

/// What to do where it cannot be built.
pub const MISSING: &str = "the standard library for WebAssembly is not installed here; rustup target add wasm32-unknown-unknown installs it";

/// True if the standard library for WebAssembly is installed.
pub fn is_installed() -> Result<bool> {
    let arguments = ["--print", "target-libdir", "--target", TRIPLE];
    let folder = output(Command::new("rustc").args(arguments))?;
    Ok(Path::new(folder.trim()).exists())
}

/// Builds the engine to where the program takes it from, the program, and what compares both.
pub fn build() -> Result<()> {
    run(cargo_command()
        .args([
            "build",
            "--profile",
            "dist",
            "--locked",
            "--package",
            "softstop-explorer",
        ])
        .args(["--lib", "--target", TRIPLE]))?;
    let built = target().join(TRIPLE).join("dist/softstop_explorer.wasm");
    let kept = top().join("crates/explore/assets/explorer/engine.wasm.gz");
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    copy(
        &mut File::open(&built).with_context(|| built.display().to_string())?,
        &mut packed,
    )?;
    File::create(kept)?.write_all(&packed.finish()?)?;
    cargo("build --release --package softstop")?;
    cargo("build --release --package softstop-explorer --example answers")
}

/// Writes the page of the paper's machine into the target folder.
pub fn write() -> Result<PathBuf> {
    build()?;
    let page = target().join("explorer/explorer.html");
    let program = target().join(format!("release/softstop{}", std::env::consts::EXE_SUFFIX));
    run(Command::new(program)
        .arg("explore")
        .arg("--output")
        .arg(&page))?;
    let size = fs::metadata(&page)?.len();
    println!("{}: {} kB", page.display(), size / 1000);
    Ok(page)
}
