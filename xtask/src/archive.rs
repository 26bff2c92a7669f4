//! The archive of the programs for this computer, as a release holds it.

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::explorer;
use crate::library::host;
use crate::manual;
use crate::notices::{PROGRAMS, notices};
use crate::run::{cargo, run, target, top};

/// Builds the programs as they are shipped and packs them with their manual, licences and notices; returns the archive's path.
pub fn write() -> Result<PathBuf> {
    match explorer::is_installed()? {
        true => explorer::build()?,
        false => println!("left out, the page of the explorer: {}", explorer::MISSING),
    }
    cargo("build --profile dist --locked --package softstop --package softstop-lab --bins")?;
    let name = format!("softstop-{}-{}", env!("CARGO_PKG_VERSION"), host()?);
    let parent = target().join("archive");
    if parent.exists() {
        fs::remove_dir_all(&parent)?;
    }
    let folder = parent.join(&name);
    for program in ["softstop", "softstop-lab"] {
        let built = target().join(format!("dist/{program}{EXE_SUFFIX}"));
        copy(&built, &folder)?;
    }
    for text in [
        "optimize/README.md",
        "CHANGELOG.md",
        "LICENSE-APACHE",
        "LICENSE-MIT",
    ] {
        copy(&top().join(text), &folder)?;
    }
    for page in fs::read_dir(manual::write()?)? {
        copy(&page?.path(), &folder.join("manual"))?;
    }
    fs::write(folder.join("NOTICE"), notices(&PROGRAMS)?)?;
    let file = format!("{name}.tar.gz");
    run(Command::new("tar")
        .current_dir(&parent)
        .args(["-czf", &file, &name]))?;
    Ok(parent.join(file))
}

fn copy(file: &Path, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    let name = file.file_name().unwrap_or_default();
    fs::copy(file, folder.join(name)).with_context(|| file.display().to_string())?;
    Ok(())
}
