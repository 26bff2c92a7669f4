//! Where a motion starts, and how a machine begins.

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

    /// Refuses a state to start from that is not finite.
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

/// How a machine begins. A [`Start`] is enough: time 0 s and a fed strip go with it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct InitialConditions {
    /// The state.
    pub start: Start,
    /// Absolute time in s; the drive is F0 cos(w t + phi) in absolute time.
    pub time: f64,
    /// Whether a strip is fed: also in the stroke in which the machine begins, if that is beyond the clearance.
    pub fed: bool,
}

impl From<Start> for InitialConditions {
    fn from(start: Start) -> Self {
        Self {
            start,
            time: 0.0,
            fed: true,
        }
    }
}

impl InitialConditions {
    /// These options at another absolute time in s.
    #[must_use]
    pub const fn at_time(self, time: f64) -> Self {
        Self { time, ..self }
    }

    /// These options with a strip or without.
    #[must_use]
    pub const fn fed(self, fed: bool) -> Self {
        Self { fed, ..self }
    }
}
