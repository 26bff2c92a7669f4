//! Building the FMU.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use softstop_fmi::package::{self, HOST_PLATFORM, Library};
use softstop_fmi::{Imprint, Options, Standard, Unit, description, guid_of};
use softstop_fmu::Machine;
use softstop_units::{Drive, Feeder};

use crate::library::{Artifact, Build, build_daily, host};
use crate::run::{cargo_command, stage, top};
use crate::system;
use crate::targets::{TARGETS, Target, Tools};

/// Writes the model description of the default FMU at the top level, if it has changed.
pub fn write_description() -> Result<()> {
    let imprint = Imprint::<Machine>::library();
    let xml = description::write(&imprint, &guid_of(&imprint));
    let path = top().join("modelDescription.xml");
    if fs::read_to_string(&path).is_ok_and(|present| present == xml) {
        println!("{} is up to date", path.display());
        return Ok(());
    }
    fs::write(&path, xml).with_context(|| path.display().to_string())?;
    println!("{} written", path.display());
    Ok(())
}

/// The standards that units are packed for.
pub const STANDARDS: [Standard; 2] = [Standard::Fmi2, Standard::Fmi3];

/// Packs the libraries that are built for daily work; returns the oscillator's path.
pub fn write_package(standards: &[Standard]) -> Result<PathBuf> {
    write_all(standards, |artifact| Ok(vec![build_daily(artifact)?]))
}

/// Builds the libraries for this machine as they are shipped and packs them; returns the oscillator's path.
pub fn write_shipped(standards: &[Standard]) -> Result<PathBuf> {
    write_all(standards, |artifact| Ok(vec![shipped(artifact)?]))
}

/// Writes the units, and the machine that those of each standard make together.
fn write_all(
    standards: &[Standard],
    build: impl Fn(Artifact) -> Result<Vec<Library>>,
) -> Result<PathBuf> {
    for &standard in standards {
        let drive = build(Artifact::of::<Drive>(standard))?;
        let feeder = build(Artifact::of::<Feeder>(standard))?;
        let press = build(Artifact::of::<Machine>(standard))?;
        write::<Drive>(standard, &drive)?;
        write::<Feeder>(standard, &feeder)?;
        write::<Machine>(standard, &press)?;
        let path = place("piercing-machine", standard, "ssp");
        system::write(&path, standard, [&drive, &feeder, &press])?;
        say(&path)?;
    }
    Ok(place(Machine::about().identifier, Standard::Fmi2, "fmu"))
}

fn shipped(artifact: Artifact) -> Result<Library> {
    let target = TARGETS
        .iter()
        .find(|target| target.platform == HOST_PLATFORM);
    let (library, note) = match target {
        Some(target) => built_or_host(artifact, target, &Tools::new())?,
        None => (host_library(artifact)?, String::new()),
    };
    println!("{}{note}", library.platform);
    Ok(library)
}

/// The library for a platform, and what there is to say of it. Where Zig cannot link for this machine there is still its
/// own linker.
fn built_or_host(artifact: Artifact, target: &Target, tools: &Tools) -> Result<(Library, String)> {
    let built = target
        .prepare(tools)
        .and_then(|()| target.build(artifact, tools));
    built
        .map(|library| (library, String::new()))
        .or_else(|error| {
            let note = format!(", for this machine's C library or a later one: {error:#}");
            Ok((host_library(artifact)?, note))
        })
}

/// Builds the libraries for every platform that can be had here as they are shipped and packs them all.
pub fn write_shipped_for_all(standards: &[Standard]) -> Result<()> {
    let tools = Tools::new();
    write_all(standards, |artifact| shipped_for_all(artifact, &tools)).map(drop)
}

/// Left out are platforms for which something cannot be had; where all is there, a build that fails is an error.
fn shipped_for_all(artifact: Artifact, tools: &Tools) -> Result<Vec<Library>> {
    let mut libraries = Vec::new();
    for target in &TARGETS {
        stage(target.platform);
        let (library, note) = match target.prepare(tools) {
            _ if target.platform == HOST_PLATFORM => built_or_host(artifact, target, tools)?,
            Ok(()) => (target.build(artifact, tools)?, String::new()),
            Err(error) => {
                println!("{:14} skipped: {error:#}", target.platform);
                continue;
            }
        };
        let size = library.bytes.len().div_ceil(1024);
        println!("{:14} {size} KiB{note}", target.platform);
        libraries.push(library);
    }
    Ok(libraries)
}

fn host_library(artifact: Artifact) -> Result<Library> {
    let build = Build {
        artifact,
        command: cargo_command(),
        target: host()?,
        flags: Vec::new(),
    };
    Ok(Library::read(&build.run()?)?)
}

fn write<U: Unit>(standard: Standard, libraries: &[Library]) -> Result<()> {
    let identifier = U::about().identifier;
    let path = place(identifier, standard, "fmu");
    let imprint = Imprint::<U>::library().with_standard(standard);
    package::write(&path, &imprint, libraries)?;
    say(&path)?;
    let with_exchange = imprint.clone().with_options(Options {
        exchange: true,
        ..Options::default()
    });
    if with_exchange.has_exchange() != imprint.has_exchange() {
        let path = top().join(format!("{identifier}-exchange.fmu"));
        package::write(&path, &with_exchange, libraries)?;
        say(&path)?;
    }
    Ok(())
}

/// Where a unit or the machine is written.
fn place(name: &str, standard: Standard, extension: &str) -> PathBuf {
    let version = match standard {
        Standard::Fmi2 => "",
        Standard::Fmi3 => "-fmi3",
    };
    top().join(format!("{name}{version}.{extension}"))
}

fn say(path: &Path) -> Result<()> {
    let size = fs::metadata(path)?.len().div_ceil(1024);
    println!("{} ({size} KiB)", path.display());
    Ok(())
}
