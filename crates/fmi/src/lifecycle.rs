//! Where an instance stands.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Where an instance stands between instantiation and its end (FMI 2.0, 3.2.3 and 4.2.4; FMI 3.0, 2.3, 3.2 and 4.2.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Lifecycle {
    /// Made or reset.
    Instantiated,
    /// Between entering and leaving initialisation.
    Initializing,
    /// Ready for the next step.
    Running,
    /// A defect of this library showed: only reading, resetting and freeing are left.
    Failed,
    /// Ended by the importer.
    Terminated,
    /// At an event that the importer handles.
    Event,
    /// A call has failed (FMI 3.0).
    Erred,
    /// Between events, while the importer integrates.
    Continuous,
    /// At an event within a step, where outputs can be read (FMI 3.0).
    Intermediate,
}

impl Lifecycle {
    /// Whether initialisation is not over.
    pub(crate) const fn is_before_start(self) -> bool {
        matches!(self, Self::Instantiated | Self::Initializing)
    }

    /// Whether initialisation is over and the end is not reached.
    pub(crate) const fn is_under_way(self) -> bool {
        matches!(self, Self::Running | Self::Event | Self::Continuous)
    }
}

impl fmt::Display for Lifecycle {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::Instantiated => "before initialisation",
            Self::Initializing => "during initialisation",
            Self::Running => "after initialisation",
            Self::Event => "in event mode",
            Self::Continuous => "in continuous-time mode",
            Self::Intermediate => "in intermediate update mode",
            Self::Erred => "after fmi3Error",
            Self::Failed => "after an internal error",
            Self::Terminated => "after fmi2Terminate",
        })
    }
}
