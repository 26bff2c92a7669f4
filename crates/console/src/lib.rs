//! What the programs share: the [`machine`] as the user states it, [`scene_file`]s, [`progress`],
//! [`interrupt`], what long runs [`keep`] in files of [`pieces`], [`failure`], and one [`export`] of every report: [`mod@column`]s and [`record`]s said once, text [`table`]s, [`units`], [`range`]s, and
//! [`output`] that is there whole or not at all.
#![forbid(unsafe_code)]

pub mod arguments;
pub mod budget;
pub mod cell;
pub mod column;
pub mod export;
pub mod failure;
pub mod interrupt;
pub mod keep;
pub mod machine;
pub mod median;
pub mod output;
pub mod pieces;
pub mod progress;
pub mod range;
pub mod record;
pub mod report;
pub mod scene_file;
pub mod schema;
pub mod table;
pub mod units;

use std::io::{self, Write};
use std::process::ExitCode;

use failure::Failure;

/// Runs a program's command; says what went wrong and turns the outcome into an exit code.
pub fn main(command: impl FnOnce() -> Result<(), Failure>) -> ExitCode {
    interrupt::install();
    match command() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // A reader that has gone away (`2>&1 | head`) is no reason to panic.
            let _ = writeln!(io::stderr(), "{failure}");
            failure.exit_code()
        }
    }
}
