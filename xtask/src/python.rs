//! Python environments under the target folder, each with what one kind of tests or the tools need.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::run::{run, target, top};

/// Runs the tests with FMPy on this FMU and the units beside it.
pub fn test(package: &Path) -> Result<()> {
    let python = environment("python", "tests/fmpy/requirements.txt")?;
    pytest(&python, "tests/fmpy", package)
}

/// Runs the tests with other importers on this FMU. Not every one of them installs on every machine:
/// if they do not, the tests are left out with a message.
pub fn test_importers(package: &Path) -> Result<()> {
    match environment("importers", "tests/importers/requirements.txt") {
        Ok(python) => pytest(&python, "tests/importers", package),
        Err(error) => {
            println!("left out, the importers do not install here: {error:#}");
            Ok(())
        }
    }
}

/// Runs the tests of pages in a headless Chromium, which are left out with a message where none is installed.
pub fn test_pages() -> Result<()> {
    let python = environment("page", "tests/page/requirements.txt")?;
    run(pytest_of(&python, "tests/page").arg("-rs"))
}

fn pytest(python: &Path, folder: &str, package: &Path) -> Result<()> {
    run(pytest_of(python, folder).env("SOFTSTOP_FMU", package))
}

/// The tests of a folder.
pub fn pytest_of(python: &Path, folder: &str) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "pytest", "-p", "no:cacheprovider", "-q", folder]);
    command
}

/// The interpreter of an environment, made anew when the requirements have changed.
pub fn environment(name: &str, requirements: &str) -> Result<PathBuf> {
    let folder = target().join(name);
    let requirements = top().join(requirements);
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
        .args(["-m", "pip", "install", "--quiet"])
        .args(["--disable-pip-version-check", "-r"])
        .arg(&requirements))?;
    fs::write(&installed, wanted)?;
    Ok(python)
}
