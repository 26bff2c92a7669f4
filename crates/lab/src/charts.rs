//! `softstop-lab chart`: methods side by side.

use clap::{Args, Subcommand};

use crate::{failures, precision};
use softstop_console::failure::Failure;

/// Arguments of `softstop-lab chart`.
#[derive(Debug, Args)]
pub struct ChartsArguments {
    /// What to chart.
    #[command(subcommand)]
    pub subject: Subject,
}

/// The charts to be had.
#[derive(Debug, Subcommand)]
pub enum Subject {
    /// Speed against accuracy of all methods on one scene
    Precision(precision::PrecisionArguments),
    /// Where fixed-step methods fail: over step and stop stiffness
    Failures(failures::FailuresArguments),
}

/// Draws one chart.
///
/// # Errors
/// [`Failure`] of the chart in question.
pub fn run(arguments: &ChartsArguments) -> Result<(), Failure> {
    match &arguments.subject {
        Subject::Precision(arguments) => precision::run(arguments),
        Subject::Failures(arguments) => failures::run(arguments),
    }
}
