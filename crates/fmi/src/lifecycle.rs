//! Where an instance stands.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Where an instance stands between instantiation and its end (FMI 2.0, 4.2.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Lifecycle {
    /// Made or reset.
    Instantiated,
    /// Between entering and leaving initialisation.
    Initializing,
    /// Ready for the next step.
    Running,
    /// A defect of this library showed.
    Failed,
    /// Ended by the importer.
    Terminated,
}

impl fmt::Display for Lifecycle {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::Instantiated => "before initialisation",
            Self::Initializing => "during initialisation",
            Self::Running => "after initialisation",
            Self::Failed => "after an internal error",
            Self::Terminated => "after fmi2Terminate",
        })
    }
}
