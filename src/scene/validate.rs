//! Range checks: a scene that passes them can be simulated.

use super::{Scene, Slope, Stop, force_of};
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

fn share(name: &'static str, value: f64) -> Result<(), SceneError> {
    require((0.0..=1.0).contains(&value), name, value, "in [0, 1]")
}

/// Refuses slopes out of order, and a way back that would give more than the way forward took.
fn slopes(loading: &[Slope], unloading: &[Slope]) -> Result<(), SceneError> {
    if loading.is_empty() {
        return Err(SceneError::NoSlope);
    }
    in_order("stop.loading", loading)?;
    in_order("stop.unloading", unloading)?;
    if unloading.is_empty() {
        return Ok(());
    }
    let ends = loading.iter().chain(unloading).map(|slope| slope.from);
    let last = ends.clone().fold(0.0, f64::max);
    for deflection in ends.chain([2.0 * last + 1.0]) {
        let (taken, given) = (
            force_of(loading, deflection),
            force_of(unloading, deflection),
        );
        // Curves that coincide may differ by rounding.
        if given > taken * (1.0 + 1e-12) {
            return Err(SceneError::GivesEnergy {
                deflection,
                given,
                taken,
            });
        }
    }
    Ok(())
}

fn in_order(list: &'static str, slopes: &[Slope]) -> Result<(), SceneError> {
    for (index, slope) in slopes.iter().enumerate() {
        let fits = match index.checked_sub(1) {
            None => slope.from == 0.0,
            Some(previous) => slope.from.is_finite() && slope.from > slopes[previous].from,
        };
        if !(fits && slope.stiffness.is_finite() && slope.stiffness >= 0.0) {
            return Err(SceneError::Slope {
                list,
                index,
                from: slope.from,
                stiffness: slope.stiffness,
            });
        }
    }
    Ok(())
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
        if let Some(rigid) = self.rigid {
            not_negative("rigid.travel", rigid.travel)?;
            share("rigid.restitution", rigid.restitution)?;
        }
        match &self.stop {
            Stop::None => Ok(()),
            Stop::KelvinVoigt { stiffness, .. } => not_negative("stop.stiffness", *stiffness),
            Stop::PiecewiseLinear { loading, unloading } => slopes(loading, unloading),
            Stop::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => {
                not_negative("stop.stiffness", *stiffness)?;
                require(
                    exponent.is_finite() && *exponent >= 1.0,
                    "stop.exponent",
                    *exponent,
                    "finite and >= 1",
                )?;
                not_negative("stop.dissipation", *dissipation)
            }
            Stop::Preloaded { stiffness, preload } => {
                not_negative("stop.stiffness", *stiffness)?;
                not_negative("stop.preload", *preload)
            }
            Stop::Rigid { restitution } => share("stop.restitution", *restitution),
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
