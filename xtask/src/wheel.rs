//! The Python package as a wheel, and its tests.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::python::{environment, pytest_of};
use crate::run::{run, target, top};

const REQUIREMENTS: &str = "python/tests/requirements.txt";

/// Builds the wheel for this machine with maturin.
pub fn write() -> Result<PathBuf> {
    let python = environment("package", REQUIREMENTS)?;
    let folder = target().join("wheels");
    if folder.exists() {
        fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    run(Command::new(&python)
        .args(["-m", "maturin", "build", "--release", "--locked", "--out"])
        .arg(&folder)
        .arg("--target-dir")
        .arg(target())
        .current_dir(top().join("python")))?;
    let mut wheels = fs::read_dir(&folder)?.collect::<Result<Vec<_>, _>>()?;
    ensure!(
        wheels.len() == 1,
        "{} wheels in {}",
        wheels.len(),
        folder.display()
    );
    Ok(wheels.remove(0).path())
}

/// Installs the wheel into an environment of its own and runs the package's tests there.
pub fn test() -> Result<()> {
    let wheel = write()?;
    let python = environment("package", REQUIREMENTS)?;
    run(Command::new(&python)
        .args(["-m", "pip", "install", "--disable-pip-version-check"])
        .args(["--force-reinstall", "--no-deps"])
        .arg(wheel))?;
    run(&mut pytest_of(&python, "python/tests"))
}
