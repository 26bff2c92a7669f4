//! Where an arc departs from.

use serde::{Deserialize, Serialize};

use super::drive_angle::DriveAngle;
use super::polynomial::Polynomial;

/// What an arc starts from: state, drive angle and forcing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
    /// The drive angle.
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
