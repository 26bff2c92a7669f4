//! What the programs share: machines of the command line ([`arguments`]) and of [`scene_file`]s, [`progress`],
//! [`interrupt`], what long runs [`keep`] in a [`record_log`], [`failure`], and one [`export`] of every report:
//! [`mod@column`]s and [`record`]s said once, text [`table`]s, [`units`], [`range`]s, and [`output`] that is there whole
//! or not at all.

pub mod arguments;
pub mod budget;
pub mod cell;
pub mod change;
pub mod column;
pub mod export;
pub mod failure;
pub mod interrupt;
pub mod keep;
pub mod lock;
pub mod machine;
pub mod median;
pub mod names;
pub mod number;
pub mod output;
pub mod position;

pub mod progress;
pub mod range;
pub mod record;
pub mod record_log;
pub mod report;
pub mod scene_file;
pub mod schema;
pub mod sheet;
pub mod signals;
pub mod table;
pub mod units;

use std::env;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use failure::Failure;

/// Reads the command line, does what it says, says what went wrong and turns the outcome into an exit code.
pub fn main<C: Parser>(run: impl FnOnce(C) -> Result<(), Failure>) -> ExitCode {
    ExitCode::from(main_of(env::args_os(), run))
}

/// Runs a program with the words of a command line, its name first, and returns its exit code.
pub fn main_of<C: Parser>(
    line: impl IntoIterator<Item = OsString>,
    run: impl FnOnce(C) -> Result<(), Failure>,
) -> u8 {
    interrupt::install();
    let line = line.into_iter().map(without_exponent);
    let outcome = match C::try_parse_from(line) {
        Ok(command) => run(command),
        Err(mut told) => match told.kind() {
            ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => output::written(told.print()),
            kind => {
                if kind == ErrorKind::UnknownArgument {
                    told.insert(
                        ContextKind::Suggested,
                        ContextValue::StyledStrs(vec![SET_TIP.into()]),
                    );
                }
                say(&told.render().to_string());
                return Failure::usage("").exit_code();
            }
        },
    };
    match outcome {
        Ok(()) => 0,
        Err(failure) => {
            if !matches!(failure, Failure::Unread) {
                say(&format!("{failure}\n"));
            }
            failure.exit_code()
        }
    }
}

/// A negative number without its exponent: clap takes those with a negative one for options.
fn without_exponent(word: OsString) -> OsString {
    let text = word.to_str().unwrap_or_default();
    let number = text.parse().ok().filter(|number: &f64| {
        text.starts_with('-') && text.contains(['e', 'E']) && number.is_finite()
    });
    number.map_or(word, |number| number.to_string().into())
}

/// What an unknown argument may have been meant for.
const SET_TIP: &str = "where a command takes a machine, --set KEY=VALUE changes a value of it";

/// Writes to the standard error. A reader that has gone away (`2>&1 | head`) is no reason to panic.
fn say(text: &str) {
    let text = names::escaped(&names::shortened(text));
    let _ = io::stderr().write_all(text.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_numbers_have_any_exponent() {
        #[derive(Parser)]
        #[command(allow_negative_numbers = true)]
        struct Start {
            #[arg(long)]
            velocity: f64,
        }
        for text in [
            "-8e-05", "-8E-05", "-1.5e-3", "-2e5", "-0.25", "-5e-324", "3e-2",
        ] {
            let line = ["simulate", "--velocity", text].map(OsString::from);
            let code = main_of(line, |start: Start| {
                assert_eq!(Ok(start.velocity), text.parse());
                Ok(())
            });
            assert_eq!(code, 0, "{text}");
        }
    }
}
