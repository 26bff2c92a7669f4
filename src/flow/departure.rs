//! Where an arc departs from, and a state on it (node).

use serde::{Deserialize, Serialize};

use super::Polynomial;
use super::drive::Drive;

/// The state that an arc starts from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// Where the drive stands.
    pub drive: Drive,
    /// Force per mass in m/s^2, as it changes from the departure on: the external one and the law's own constant one.
    pub push: Polynomial,
    /// Acceleration in m/s^2 from rest, where the phase was chosen by it: the arc then starts with this very number.
    pub acceleration: Option<f64>,
}

impl Departure {
    /// This departure seen from the other side, positions counted downwards.
    pub(super) fn mirrored(&self) -> Self {
        Self {
            position: -self.position,
            velocity: -self.velocity,
            drive: Drive {
                cos: -self.drive.cos,
                sin: -self.drive.sin,
            },
            push: self.push.mirrored(),
            acceleration: self.acceleration.map(|acceleration| -acceleration),
        }
    }
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
    /// Where the drive stands.
    pub drive: Drive,
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    pub(super) origin: f64,
    pub(super) windows: u32,
}
