//! Building the FMU.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result};
use softstop_fmu::package::{self, HOST_PLATFORM, Library};
use softstop_fmu::{Imprint, description, guid_of};
use softstop_optimize::fmu::library;

use crate::library::{Build, host};
use crate::run::{cargo_command, stage, top};
use crate::targets::{TARGETS, Target, Tools};

/// Writes the model description of the default FMU at the top level, if it has changed.
pub fn write_description() -> Result<()> {
    let imprint = Imprint::library();
    let xml = description::write(&imprint, &guid_of(&imprint)?)?;
    let path = top().join("modelDescription.xml");
    if fs::read_to_string(&path).is_ok_and(|present| present == xml) {
        println!("{} is up to date", path.display());
        return Ok(());
    }
    fs::write(&path, xml).with_context(|| path.display().to_string())?;
    println!("{} written", path.display());
    Ok(())
}

/// Packs the library that was built along with this program; returns the FMU's path.
pub fn write_package() -> Result<PathBuf> {
    write(&[library()?])
}

/// Builds the library for this machine as it is shipped and packs it; returns the FMU's path.
pub fn write_shipped() -> Result<PathBuf> {
    let target = TARGETS
        .iter()
        .find(|target| target.platform == HOST_PLATFORM);
    let (library, note) = match target {
        Some(target) => built_or_host(target, &Tools::new())?,
        None => (host_library()?, String::new()),
    };
    println!("{}{note}", library.platform);
    write(&[library])
}

/// The library for a platform, and what there is to say of it. Without the tools there is still the
/// linker of this machine.
fn built_or_host(target: &Target, tools: &Tools) -> Result<(Library, String)> {
    target
        .build(tools)
        .map(|library| (library, String::new()))
        .or_else(|error| {
            if target.platform != HOST_PLATFORM {
                return Err(error);
            }
            let note = format!(", for this machine's C library or a later one: {error:#}");
            Ok((host_library()?, note))
        })
}

/// Builds the library for every platform that can be had here as it is shipped and packs them all.
pub fn write_shipped_for_all() -> Result<()> {
    let tools = Tools::new();
    let mut libraries = Vec::new();
    let mut lines = Vec::new();
    for target in &TARGETS {
        stage(target.platform);
        match built_or_host(target, &tools) {
            Ok((library, note)) => {
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
    package::write(&path, &Imprint::library(), libraries)?;
    let size = fs::metadata(&path)?.len().div_ceil(1024);
    println!("{} ({size} KiB)", path.display());
    Ok(path)
}
