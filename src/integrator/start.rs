//! Where a motion starts.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::error::MotionError;

/// A state to start from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
}

impl From<Vector2<f64>> for Start {
    fn from(state: Vector2<f64>) -> Self {
        Self::new(state.x, state.y)
    }
}

impl From<Start> for Vector2<f64> {
    fn from(start: Start) -> Self {
        Self::new(start.position, start.velocity)
    }
}

impl Start {
    /// At rest at position 0.
    pub const REST: Self = Self::new(0.0, 0.0);

    /// The state at this position in m with this velocity in m/s.
    pub const fn new(position: f64, velocity: f64) -> Self {
        Self { position, velocity }
    }

    /// Refuses a state that is not finite.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`] naming the component.
    pub fn validate(&self) -> Result<(), MotionError> {
        for (name, value) in [("position", self.position), ("velocity", self.velocity)] {
            if !value.is_finite() {
                return Err(MotionError::NotFinite { name, value });
            }
        }
        Ok(())
    }
}
