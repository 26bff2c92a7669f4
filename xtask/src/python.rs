//! The tests with FMPy, in a Python environment of their own.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::run::{run, top};

/// Runs the tests on this FMU.
pub fn test(package: &Path) -> Result<()> {
    let python = environment()?;
    run(Command::new(python)
        .args(["-m", "pytest", "-p", "no:cacheprovider", "-q", "tests/fmpy"])
        .env("SOFTSTOP_FMU", package))
}

fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| top().join("target"), PathBuf::from)
}

/// The interpreter of the environment, made anew when the requirements have changed.
fn environment() -> Result<PathBuf> {
    let folder = target().join("python");
    let requirements = top().join("tests/fmpy/requirements.txt");
    let wanted =
        fs::read_to_string(&requirements).with_context(|| requirements.display().to_string())?;
    let python = if cfg!(windows) {
        folder.join("Scripts/python.exe")
    } else {
        folder.join("bin/python")
    };
    let installed = folder.join("requirements.txt");
    if python.exists() && fs::read_to_string(&installed).is_ok_and(|text| text == wanted) {
        return Ok(python);
    }
    let system = if cfg!(windows) { "python" } else { "python3" };
    run(Command::new(system)
        .args(["-m", "venv", "--clear"])
        .arg(&folder))
    .context("Python 3 with its venv module is needed")?;
    run(Command::new(&python)
        .args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "-r",
        ])
        .arg(&requirements))?;
    fs::write(&installed, wanted)?;
    Ok(python)
}
