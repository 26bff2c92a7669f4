//! The nodes of a scan for crossings, and the windows between them.

use serde::{Deserialize, Serialize};

use super::drive_angle::DriveAngle;

/// A state on an arc at one of the times between which a scan for crossings proceeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ScanNode {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// The drive angle.
    pub drive: DriveAngle,
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    pub(super) origin: f64,
    pub(super) windows: u32,
}

/// A scan window: the nodes at its ends, with a bound on the fourth derivative of the position between them.
pub(crate) struct ScanWindow<'a> {
    pub left: &'a ScanNode,
    pub right: &'a ScanNode,
    /// Bound on the fourth derivative of the position, in m/s^4.
    pub bound: f64,
}
