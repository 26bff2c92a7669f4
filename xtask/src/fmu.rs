//! Building the FMU.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use softstop_fmu::package::{self, HOST_PLATFORM, Library};
use softstop_fmu::{StartValues, guid_of, model_description};

use crate::library::{Build, host};
use crate::run::{cargo_command, stage, top};
use crate::targets::{TARGETS, Tools};

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

/// Builds the library for this machine in release mode and packs it; returns the FMU's path.
pub fn write_package() -> Result<PathBuf> {
    write(&[host_library()?])
}

/// Builds the library for every platform that can be had here and packs them all.
pub fn write_package_for_all() -> Result<()> {
    let tools = Tools::new();
    let mut libraries = Vec::new();
    let mut lines = Vec::new();
    for target in &TARGETS {
        stage(target.platform);
        let mut note = String::new();
        let built = target.build(&tools).or_else(|error| {
            // Without the tools there is still the linker of this machine.
            if target.platform == HOST_PLATFORM {
                note = format!(", for this machine's C library or a later one: {error:#}");
                host_library()
            } else {
                Err(error)
            }
        });
        match built {
            Ok(library) => {
                let size = library.bytes.len().div_ceil(1024);
                lines.push(format!("{:14} packed, {size} KiB{note}", target.platform));
                libraries.push(library);
            }
            Err(error) => lines.push(format!("{:14} skipped: {error:#}", target.platform)),
        }
    }
    stage("package");
    write(&libraries)?;
    lines.iter().for_each(|line| println!("{line}"));
    Ok(())
}

fn host_library() -> Result<Library> {
    let build = Build {
        command: cargo_command(),
        target: host()?,
        flags: Vec::new(),
    };
    Ok(Library::read(&build.run()?)?)
}

fn write(libraries: &[Library]) -> Result<PathBuf> {
    let path = top().join("softstop.fmu");
    package::write(&path, &StartValues::DEFAULT, libraries)?;
    println!("{} ({} KiB)", path.display(), kilobytes(&path)?);
    Ok(path)
}

fn kilobytes(path: &Path) -> Result<u64> {
    Ok(fs::metadata(path)?.len().div_ceil(1024))
}
