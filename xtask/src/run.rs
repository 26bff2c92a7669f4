//! Running other programs.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

/// The top folder of the workspace.
pub fn top() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}

/// The folder of what is built.
pub fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| top().join("target"), |dir| top().join(dir))
}

/// Announces a stage.
pub fn stage(name: &str) {
    println!("\n=== {name} ===");
}

/// The command in the folder that it names, or else in the top folder.
fn in_folder(command: &mut Command) -> &mut Command {
    if command.get_current_dir().is_none() {
        command.current_dir(top());
    }
    command
}

/// Runs a command and fails if it fails.
pub fn run(command: &mut Command) -> Result<()> {
    let shown = format!("{command:?}");
    let status = in_folder(command)
        .status()
        .with_context(|| format!("cannot run {shown}"))?;
    ensure!(status.success(), "{shown} ended with {status}");
    Ok(())
}

/// The text that a command writes.
pub fn output(command: &mut Command) -> Result<String> {
    let shown = format!("{command:?}");
    let output = in_folder(command)
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot run {shown}"))?;
    ensure!(
        output.status.success(),
        "{shown} ended with {}",
        output.status
    );
    Ok(String::from_utf8(output.stdout)?)
}

/// The cargo that runs this program.
pub fn cargo_command() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Runs cargo with arguments that hold no space.
pub fn cargo(arguments: &str) -> Result<()> {
    run(cargo_command().args(arguments.split(' ')))
}
