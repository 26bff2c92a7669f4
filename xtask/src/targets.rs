//! The platforms of the package and how the library is linked for each.
//!
//! Zig links for Linux and Windows: it brings the C libraries of both, for Linux in any version,
//! and an unwinder. It comes from PyPI into an environment under the target folder. For macOS the
//! linker of Rust itself is taken ([`crate::darwin`]).

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, anyhow, bail};
use softstop_fmu::package::Library;

use crate::darwin;
use crate::library::{Artifact, Build, sysroot};
use crate::python;
use crate::run::{output, run, target};

/// One platform of the package.
pub struct Target {
    /// Folder in `binaries/`.
    pub platform: &'static str,
    linked: Linked,
}

enum Linked {
    /// By Zig: Rust's name of the target and what cargo-zigbuild wants added to it.
    Zig(&'static str, &'static str),
    /// As one universal library of several targets.
    Darwin(&'static [&'static str]),
}

/// All platforms. Version 2.17 of the C library is that of the oldest Linux that Rust runs on.
pub const TARGETS: [Target; 4] = [
    Target {
        platform: "linux64",
        linked: Linked::Zig("x86_64-unknown-linux-gnu", ".2.17"),
    },
    Target {
        platform: "aarch64-linux",
        linked: Linked::Zig("aarch64-unknown-linux-gnu", ".2.17"),
    },
    Target {
        platform: "win64",
        linked: Linked::Zig("x86_64-pc-windows-gnu", ""),
    },
    Target {
        platform: "darwin64",
        linked: Linked::Darwin(&["x86_64-apple-darwin", "aarch64-apple-darwin"]),
    },
];

/// Rust's names of all targets.
pub fn triples() -> impl Iterator<Item = &'static str> {
    TARGETS
        .iter()
        .flat_map(|target| match &target.linked {
            Linked::Zig(triple, _) => std::slice::from_ref(triple),
            Linked::Darwin(triples) => triples,
        })
        .copied()
}

impl Target {
    /// The target of this folder in `binaries/`.
    pub fn of(platform: &str) -> Result<&'static Self> {
        TARGETS
            .iter()
            .find(|target| target.platform == platform)
            .with_context(|| format!("no target for {platform}"))
    }

    /// Gets what it takes to build for this platform, or says what of it cannot be had.
    pub fn prepare(&self, tools: &Tools) -> Result<()> {
        tools.python()?;
        match &self.linked {
            Linked::Zig(triple, _) => install_standard_library(triple),
            Linked::Darwin(triples) => triples
                .iter()
                .try_for_each(|triple| install_standard_library(triple)),
        }
    }

    /// Builds a unit's library for this platform, for which all is prepared.
    pub fn build(&self, artifact: Artifact, tools: &Tools) -> Result<Library> {
        let bytes = match self.linked {
            Linked::Zig(triple, suffix) => {
                // Zig exports every function from a DLL unless a module definition says which.
                let exports = format!("-Clink-arg={}", artifact.exports());
                let is_windows = triple.contains("windows");
                let build = Build {
                    artifact,
                    command: tools.cargo_zigbuild()?,
                    target: format!("{triple}{suffix}"),
                    flags: is_windows.then_some(exports).into_iter().collect(),
                };
                fs::read(build.run()?)?
            }
            Linked::Darwin(triples) => {
                let kit = darwin::kit(&tools.zig_library()?)?;
                let slices = triples
                    .iter()
                    .map(|triple| Ok(fs::read(darwin::build(artifact, triple, &kit).run()?)?))
                    .collect::<Result<Vec<_>>>()?;
                darwin::universal(&slices)?
            }
        };
        Ok(Library {
            platform: self.platform.to_owned(),
            bytes,
        })
    }
}

/// Makes sure that Rust's standard library for a target is there.
pub fn install_standard_library(triple: &str) -> Result<()> {
    let installed = |root: &Path| root.join("lib/rustlib").join(triple).join("lib").is_dir();
    if installed(&sysroot()?) {
        return Ok(());
    }
    run(Command::new("rustup").args(["target", "add", triple]))
        .with_context(|| format!("Rust's standard library for {triple} cannot be had"))?;
    if !installed(&sysroot()?) {
        bail!("rustup put the standard library for {triple} elsewhere than the compiler is");
    }
    Ok(())
}

/// Zig, cargo-zigbuild and maturin, if they can be had.
pub struct Tools {
    python: Result<PathBuf, String>,
}

impl Tools {
    /// Installs the tools unless they are there.
    pub fn new() -> Self {
        let python = python::environment("tools", "xtask/tools/requirements.txt");
        Self {
            python: python.map_err(|error| format!("no Zig, no maturin: {error:#}")),
        }
    }

    fn python(&self) -> Result<&Path> {
        self.python
            .as_deref()
            .map_err(|reason| anyhow!(reason.clone()))
    }

    /// A cargo that links with Zig.
    pub fn cargo_zigbuild(&self) -> Result<Command> {
        self.program("cargo-zigbuild")
    }

    /// The builder of Python packages.
    pub fn maturin(&self) -> Result<Command> {
        self.program("maturin")
    }

    fn program(&self, name: &str) -> Result<Command> {
        let programs = self.python()?.parent().context("a folder of programs")?;
        let mut path = vec![programs.to_owned()];
        path.extend(env::split_paths(&env::var_os("PATH").unwrap_or_default()));
        let mut command = Command::new(programs.join(name));
        command
            .env("PATH", env::join_paths(path)?)
            .env("CARGO_ZIGBUILD_CACHE_DIR", cache());
        Ok(cached(command))
    }

    /// The C compiler of Zig.
    pub fn zig_cc(&self) -> Result<Command> {
        let mut command = Command::new(self.python()?);
        command.args(["-m", "ziglang", "cc"]);
        Ok(cached(command))
    }

    /// The folder of C libraries that Zig brings.
    pub fn zig_library(&self) -> Result<PathBuf> {
        let show = "import os, ziglang; print(os.path.dirname(ziglang.__file__))";
        let folder = output(Command::new(self.python()?).args(["-c", show]))?;
        Ok(Path::new(folder.trim()).join("lib/libc"))
    }
}

fn cache() -> PathBuf {
    target().join("zig")
}

/// Keeps Zig's cache under the target folder.
fn cached(mut command: Command) -> Command {
    command
        .env("ZIG_GLOBAL_CACHE_DIR", cache())
        .env("ZIG_LOCAL_CACHE_DIR", cache());
    command
}
