//! Where a motion stands.

use serde::{Deserialize, Serialize};

use super::Polynomial;

/// Everything a motion starts from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// cos and sin of the drive angle.
    pub drive: (f64, f64),
    /// Force per mass in m/s^2, as it changes from the departure on: the external one and the law's own
    /// constant one.
    pub push: Polynomial,
    /// Acceleration in m/s^2 from rest, where the phase was chosen by it: the arc then starts with
    /// this very number.
    pub acceleration: Option<f64>,
}

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
