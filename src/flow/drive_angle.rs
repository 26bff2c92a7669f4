//! The angle of the drive, by its cosine and sine.

use serde::{Deserialize, Serialize};

/// The drive angle w t + phi, by its cosine and sine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DriveAngle {
    /// The cosine, in phase with the force.
    pub cos: f64,
    /// The sine.
    pub sin: f64,
}

impl DriveAngle {
    /// The drive angle of this value in rad.
    #[inline]
    pub fn at(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { cos, sin }
    }

    /// The sum of two drive angles.
    #[inline]
    pub(super) fn turned(self, by: Self) -> Self {
        Self {
            cos: self.cos * by.cos - self.sin * by.sin,
            sin: self.sin * by.cos + self.cos * by.sin,
        }
    }
}
