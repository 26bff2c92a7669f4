//! The ways in which a run ends without its result, and their exit codes.

use std::fmt;
use std::path::Path;

use softstop::{MotionError, SceneError};

use crate::{interrupt, signals};

/// Why there is no result.
#[derive(Debug)]
pub enum Failure {
    /// The user's values cannot be used; the message names parameter, value and range.
    Usage(String),
    /// The values are good, but the run could not do the job.
    Run(anyhow::Error),
    /// Ctrl-C or another signal to end.
    Interrupted,
    /// Nobody reads the standard output any more (`softstop … | head`).
    Unread,
}

impl Failure {
    /// A usage failure with this message.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::Usage(message.into())
    }

    /// The same, a usage failure with the name of the file in which the user said so.
    #[must_use]
    pub fn in_file(self, path: &Path) -> Self {
        match self {
            Self::Usage(message) => Self::Usage(format!("{}: {message}", path.display())),
            other => other,
        }
    }

    /// 2 for bad usage (as clap does), 1 for a failed run, 128 and the number of the signal for a run that one ended.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Run(_) => 1,
            Self::Interrupted => interrupt::exit_code(),
            Self::Unread => signals::exit_code(signals::PIPE),
        }
    }
}

/// Ends a run that the user asked to end.
///
/// # Errors
/// [`Failure::Interrupted`] after Ctrl-C.
pub fn check_interrupt() -> Result<(), Failure> {
    match interrupt::requested() {
        true => Err(Failure::Interrupted),
        false => Ok(()),
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message) => write!(
                formatter,
                "error: {message}\n\nFor more information, try '--help'."
            ),
            Self::Run(error) => write!(formatter, "error: {error:#}"),
            Self::Interrupted => formatter.write_str(interrupt::under_way().closing),
            Self::Unread => formatter.write_str("nobody reads the standard output"),
        }
    }
}

impl std::error::Error for Failure {}

// A failure that went through `anyhow` is itself again; what ends after Ctrl-C was interrupted.
impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        match error.downcast() {
            Ok(failure) => failure,
            Err(_) if interrupt::requested() => Self::Interrupted,
            Err(error) => Self::Run(error),
        }
    }
}

// Values that cannot be are the user's, the rest is the run's.
impl From<MotionError> for Failure {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Scene(_)
            | MotionError::NotFinite { .. }
            | MotionError::BeyondStop { .. } => Self::usage(error.to_string()),
            error => Self::Run(error.into()),
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::usage(error.to_string())
    }
}
