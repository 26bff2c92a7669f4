//! The manual pages of the program, and completions for shells, from its command line.

use std::fs;
use std::path::PathBuf;

use anyhow::Result;
use clap::{CommandFactory, ValueEnum};
use clap_complete::Shell;
use softstop_optimize::CommandLine;

use crate::run::target;

/// Writes a page for each command and a script for each shell; returns their folder.
pub fn write() -> Result<PathBuf> {
    let folder = target().join("manual");
    fs::create_dir_all(&folder)?;
    clap_mangen::generate_to(CommandLine::command(), &folder)?;
    for shell in Shell::value_variants() {
        clap_complete::generate_to(*shell, &mut CommandLine::command(), "softstop", &folder)?;
    }
    Ok(folder)
}
