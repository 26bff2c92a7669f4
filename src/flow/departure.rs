//! Where an arc departs from, a state on it (node), and the angle of the drive there.

use serde::{Deserialize, Serialize};

use super::Polynomial;

/// The state that an arc starts from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// Where the drive stands.
    pub drive: DriveAngle,
    /// Force per mass in m/s^2, as it changes from the departure on: the external one and the law's own constant one.
    #[serde(rename = "push")]
    pub forcing: Polynomial,
    /// Acceleration in m/s^2 from rest, where the phase was chosen by it: the arc then starts with this very number.
    pub acceleration: Option<f64>,
}

impl Departure {
    /// This departure seen from the other side, positions counted downwards.
    pub(super) fn mirrored(&self) -> Self {
        Self {
            position: -self.position,
            velocity: -self.velocity,
            drive: DriveAngle {
                cos: -self.drive.cos,
                sin: -self.drive.sin,
            },
            forcing: self.forcing.mirrored(),
            acceleration: self.acceleration.map(|acceleration| -acceleration),
        }
    }
}

/// A motion's state at one time after departure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ScanNode {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// Where the drive stands.
    pub drive: DriveAngle,
    pub(super) deviation: (f64, f64),
    /// Scan windows are counted from here, so that their times do not drift.
    pub(super) origin: f64,
    pub(super) windows: u32,
}

/// Cosine and sine of the drive angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DriveAngle {
    /// The cosine, in phase with the force.
    pub cos: f64,
    /// The sine.
    pub sin: f64,
}

impl DriveAngle {
    /// The drive at an angle in rad.
    #[inline]
    pub fn at(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { cos, sin }
    }

    /// The drive turned on by another angle.
    #[inline]
    pub(super) fn turned(self, by: Self) -> Self {
        Self {
            cos: self.cos * by.cos - self.sin * by.sin,
            sin: self.sin * by.cos + self.cos * by.sin,
        }
    }
}
