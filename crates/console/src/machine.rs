//! The paper's machines by their names.

use std::path::Path;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use softstop::Ratios;

/// The paper's two regimes (its Figs. 6 and 7, a and b).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PaperMachine {
    /// No strip: the preloaded stop stands at the clearance (point A).
    Unloaded,
    /// A strip is pierced before the stop is met (point B).
    Loaded,
}

impl PaperMachine {
    /// Its machine, at that point.
    pub const fn ratios(self) -> Ratios {
        match self {
            Self::Unloaded => Ratios::unloaded(),
            Self::Loaded => Ratios::loaded(),
        }
    }

    /// The paper's name of its point in this regime (Fig. 7).
    pub const fn point(self) -> &'static str {
        match self {
            Self::Unloaded => "A",
            Self::Loaded => "B",
        }
    }

    /// The one of a machine that is called by the name of its regime or of its point.
    pub fn called(machine: &Path) -> Option<Self> {
        let mut all = Self::value_variants().iter().copied();
        all.find(|it| machine == Path::new(it.name()) || machine == Path::new(it.point()))
    }

    /// As on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unloaded => "unloaded",
            Self::Loaded => "loaded",
        }
    }
}
