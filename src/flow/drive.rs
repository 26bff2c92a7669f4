//! The phase of the drive.

use serde::{Deserialize, Serialize};

/// Cosine and sine of the drive angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Drive {
    /// The cosine, in phase with the force.
    pub cos: f64,
    /// The sine.
    pub sin: f64,
}

impl Drive {
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
