//! An impact as a running machine shows it.

use serde::{Deserialize, Serialize};

/// An impact, its time counted from the start of the simulation.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Impact {
    /// Time in s.
    pub time: f64,
    /// Before-impact velocity in m/s.
    pub velocity: f64,
}
