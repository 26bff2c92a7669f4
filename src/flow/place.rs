//! Where a motion stands.

use serde::{Deserialize, Serialize};

/// A motion's state at one time after departure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// cos and sin of the drive angle.
    pub drive: (f64, f64),
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    pub(super) origin: f64,
    pub(super) windows: u32,
}
