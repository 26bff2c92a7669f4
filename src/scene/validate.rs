//! Range checks: a scene that passes them can be simulated.

use super::Scene;
use super::Stop;
use crate::error::SceneError;

const POSITIVE: &str = "finite and > 0";
const NOT_NEGATIVE: &str = "finite and >= 0";
const FINITE: &str = "finite";

/// Refuses a value that is not finite and > 0.
pub(super) fn positive(name: &'static str, value: f64) -> Result<(), SceneError> {
    require(value.is_finite() && value > 0.0, name, value, POSITIVE)
}

fn not_negative(name: &'static str, value: f64) -> Result<(), SceneError> {
    require(value.is_finite() && value >= 0.0, name, value, NOT_NEGATIVE)
}

fn finite(name: &'static str, value: f64) -> Result<(), SceneError> {
    require(value.is_finite(), name, value, FINITE)
}

fn require(
    holds: bool,
    name: &'static str,
    value: f64,
    allowed: &'static str,
) -> Result<(), SceneError> {
    if holds {
        Ok(())
    } else {
        Err(SceneError::OutOfRange {
            name,
            value,
            allowed,
        })
    }
}

impl Scene {
    /// Checks every parameter against its range.
    ///
    /// # Errors
    /// [`SceneError`] naming the first parameter that is out of range.
    pub fn validate(&self) -> Result<(), SceneError> {
        positive("mass", self.mass)?;
        not_negative("stiffness", self.stiffness)?;
        not_negative("damping", self.damping)?;
        not_negative("excitation.amplitude", self.excitation.amplitude)?;
        positive("excitation.frequency", self.excitation.frequency)?;
        finite("excitation.phase", self.excitation.phase)?;
        finite("clearance", self.clearance)?;
        not_negative("contact_damping", self.contact_damping)?;
        self.validate_stop()?;
        self.validate_piercing()
    }

    fn validate_stop(&self) -> Result<(), SceneError> {
        match self.stop {
            Stop::None => Ok(()),
            Stop::Preloaded { stiffness, preload } => {
                not_negative("stop.stiffness", stiffness)?;
                not_negative("stop.preload", preload)
            }
        }
    }

    fn validate_piercing(&self) -> Result<(), SceneError> {
        let Some(strip) = self.piercing else {
            return Ok(());
        };
        not_negative("piercing.stiffness", strip.stiffness)?;
        not_negative("piercing.friction", strip.friction)?;
        not_negative("piercing.thickness", strip.thickness)?;
        not_negative("piercing.travel", strip.travel)?;
        if strip.thickness + strip.travel == 0.0 {
            return Err(SceneError::EmptyPiercing {
                thickness: strip.thickness,
                travel: strip.travel,
            });
        }
        Ok(())
    }
}
