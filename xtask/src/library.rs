//! Building the library for one target, with the same bytes wherever the build happens.

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};
use serde_json::Value;
use softstop_fmi::package::Library;
use softstop_fmi::{Standard, Unit};
use softstop_fmu::Machine;

use crate::run::{cargo_command, output, target, top};

/// A unit's library for one standard.
#[derive(Clone, Copy)]
pub struct Artifact {
    /// The `modelIdentifier` of the unit.
    unit: &'static str,
    standard: Standard,
}

impl Artifact {
    /// That of a unit.
    pub fn of<U: Unit>(standard: Standard) -> Self {
        let unit = U::about().identifier;
        Self { unit, standard }
    }

    /// Cargo's name of it.
    fn name(self) -> String {
        format!("{}_{}", self.unit, self.standard.prefix())
    }

    fn is_oscillator(self) -> bool {
        self.unit == Machine::about().identifier
    }

    /// What names it to cargo. A program holds the oscillator's, so that each has a package of its own.
    fn arguments(self) -> [String; 2] {
        match self.is_oscillator() {
            true => [
                format!("--package=softstop-{}", self.standard.prefix()),
                "--lib".to_owned(),
            ],
            false => [
                "--package=softstop-units".to_owned(),
                format!("--example={}", self.name()),
            ],
        }
    }

    /// The list of what it exports, for a linker that wants one.
    pub fn exports(self) -> String {
        format!("fmu/{}/exports.def", self.standard.prefix())
    }
}

/// One way to call cargo.
pub struct Build {
    /// What is built.
    pub artifact: Artifact,
    /// Cargo, or a program that stands in for it.
    pub command: Command,
    /// The target, as the command wants it.
    pub target: String,
    /// Further flags for rustc.
    pub flags: Vec<String>,
}

impl Build {
    /// Builds the library; returns where cargo says it is.
    pub fn run(mut self) -> Result<PathBuf> {
        let mut flags = remaps()?;
        flags.append(&mut self.flags);
        let messages = output(
            self.command
                .args(["rustc", "--profile", "dist"])
                .args(self.artifact.arguments())
                // Not also as a Rust library: only so is it optimized as a whole and left without
                // what it does not use.
                .args(["--crate-type", "cdylib"])
                .args(["--target", &self.target])
                .arg("--message-format=json-render-diagnostics")
                // The linker for Windows writes the time of the build into the library.
                .env("SOURCE_DATE_EPOCH", "0")
                .env_remove("RUSTFLAGS")
                .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}")),
        )?;
        library_in(&messages, self.artifact)
    }
}

/// The shared library among the files that cargo says it made.
fn library_in(messages: &str, artifact: Artifact) -> Result<PathBuf> {
    let name = artifact.name();
    let is_library = |path: &Path| {
        path.extension()
            .and_then(OsStr::to_str)
            .is_some_and(|extension| ["so", "dll", "dylib"].contains(&extension))
    };
    messages
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == *name)
        .filter_map(|message| message["filenames"].as_array().cloned())
        .flatten()
        .filter_map(|name| name.as_str().map(PathBuf::from))
        .find(|path| is_library(path))
        .with_context(|| format!("cargo names no library {name}"))
}

/// Flags that keep the folders of this machine out of the library: panic messages name source
/// files.
pub fn remaps() -> Result<Vec<String>> {
    let sources = sysroot()?.join("lib/rustlib/src/rust");
    let commit = rustc_says("commit-hash")?;
    // Of several that fit the last one holds, so the more special ones follow.
    let mut folders = vec![(top(), "/softstop".to_owned())];
    if let Some(home) = cargo_home() {
        folders.push((home, "/cargo".to_owned()));
    }
    folders.push((target(), "/target".to_owned()));
    folders.push((sources, format!("/rustc/{commit}")));
    Ok(folders
        .into_iter()
        .map(|(from, to)| format!("--remap-path-prefix={}={to}", from.display()))
        .collect())
}

fn cargo_home() -> Option<PathBuf> {
    env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| env::home_dir().map(|home| home.join(".cargo")))
}

fn rustc() -> Command {
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// The folder of the compiler.
pub fn sysroot() -> Result<PathBuf> {
    let text = output(rustc().args(["--print", "sysroot"]))?;
    Ok(PathBuf::from(text.trim()))
}

/// One line of what the compiler says about itself.
fn rustc_says(key: &str) -> Result<String> {
    output(rustc().arg("-vV"))?
        .lines()
        .find_map(|line| line.strip_prefix(key)?.strip_prefix(": "))
        .map(str::to_owned)
        .with_context(|| format!("rustc does not say its {key}"))
}

/// The target of this machine.
pub fn host() -> Result<String> {
    rustc_says("host")
}

/// Builds the library of daily work for this machine, if this program does not hold it.
pub fn build_daily(artifact: Artifact) -> Result<Library> {
    if artifact.is_oscillator() {
        return softstop_optimize::fmu::library(artifact.standard);
    }
    let messages = output(
        cargo_command()
            .args(["build", "--release"])
            .args(artifact.arguments())
            .arg("--message-format=json-render-diagnostics"),
    )?;
    Ok(Library::read(&library_in(&messages, artifact)?)?)
}
