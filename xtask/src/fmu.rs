//! Building the FMU.

use std::fs;
use std::path::PathBuf;
use std::process::Stdio;

use anyhow::{Context, Result, ensure};
use serde_json::Value;
use softstop_fmu::package::{self, Library};
use softstop_fmu::{StartValues, guid_of, model_description};

use crate::run::{cargo_command, top};

/// Writes the model description of the default FMU at the top level, if it has changed.
pub fn write_description() -> Result<()> {
    let start = StartValues::DEFAULT;
    let xml = model_description::write(&start, &guid_of(&start)?)?;
    let path = top().join("modelDescription.xml");
    if fs::read_to_string(&path).is_ok_and(|present| present == xml) {
        println!("{} is up to date", path.display());
        return Ok(());
    }
    fs::write(&path, xml).with_context(|| path.display().to_string())?;
    println!("{} written", path.display());
    Ok(())
}

/// Builds the library in release mode and packs it; returns the FMU's path.
pub fn write_package() -> Result<PathBuf> {
    let library = Library::read(&build_library()?)?;
    let path = top().join("softstop.fmu");
    package::write(&path, &StartValues::DEFAULT, &[library])?;
    let size = fs::metadata(&path)?.len();
    println!("{} ({} KiB)", path.display(), size.div_ceil(1024));
    Ok(path)
}

/// Builds the library and returns where cargo says it is.
fn build_library() -> Result<PathBuf> {
    let output = cargo_command()
        .args(["build", "--release", "--package", "softstop-fmu", "--lib"])
        .arg("--message-format=json-render-diagnostics")
        .stderr(Stdio::inherit())
        .output()
        .context("cannot run cargo")?;
    ensure!(
        output.status.success(),
        "building the library ended with {}",
        output.status
    );
    String::from_utf8(output.stdout)?
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == "softstop_fmu")
        .filter_map(|message| message["filenames"].as_array().cloned())
        .flatten()
        .filter_map(|name| name.as_str().map(PathBuf::from))
        .find(|path| {
            let suffix = std::env::consts::DLL_EXTENSION;
            path.extension()
                .is_some_and(|extension| extension == suffix)
        })
        .context("cargo names no library of softstop-fmu")
}
