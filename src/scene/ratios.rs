//! The paper's dimensionless quantities and their way to SI units.

use serde::{Deserialize, Serialize};

use super::validate::positive;
use super::{Excitation, Piercing, Scene, Stop};
use crate::error::SceneError;

/// Dimensionless parameters as in Peterka 2003, section 3: stiffness ratios in units of k1,
/// lengths in units of the static deflection F0/k1, forces in units of F0.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ratios {
    /// eta = w / Omega with Omega = sqrt(k1/m).
    pub frequency: f64,
    /// rho = r k1 / F0.
    pub clearance: f64,
    /// beta1 = b1 / (2 sqrt(m k1)).
    pub damping: f64,
    /// beta = b / (2 sqrt(m k1)), the whole damping in contact.
    pub contact_damping: f64,
    /// k4/k1 of the stop.
    pub stiffness: f64,
    /// Preload in units of F0. The paper's "10" is a deflection: 10 k4/k1 = 70.
    pub preload: f64,
    /// The strip, or none for the unloaded regime.
    #[serde(default)]
    pub piercing: Option<PiercingRatios>,
}

/// The strip in the paper's ratios.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PiercingRatios {
    /// k2/k1.
    pub stiffness: f64,
    /// k3/k1.
    pub friction: f64,
    /// sigma = s k1 / F0.
    pub thickness: f64,
    /// nu = v k1 / F0.
    pub travel: f64,
}

/// The three units that make the paper's ratios dimensional.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Units {
    /// Mass m in kg.
    pub mass: f64,
    /// Stiffness k1 in N/m.
    pub stiffness: f64,
    /// Force amplitude F0 in N.
    pub force: f64,
}

impl Units {
    /// m = 1 kg, k1 = 1 N/m, F0 = 1 N: SI and dimensionless figures coincide.
    pub const ONE: Self = Self {
        mass: 1.0,
        stiffness: 1.0,
        force: 1.0,
    };
}

impl PiercingRatios {
    /// The paper's strip: k2/k1 = 21, k3/k1 = 23, sigma = 0.4, sigma + nu = 0.9.
    pub const PAPER: Self = Self {
        stiffness: 21.0,
        friction: 23.0,
        thickness: 0.4,
        travel: 0.5,
    };
}

impl Ratios {
    /// The paper's unloaded regime at point A (eta = 1.15, rho = 10).
    pub const fn unloaded() -> Self {
        Self {
            frequency: 1.15,
            clearance: 10.0,
            damping: 0.02,
            contact_damping: 0.09,
            stiffness: 7.0,
            preload: 70.0,
            piercing: None,
        }
    }

    /// The paper's loaded regime at point B (eta = 1.15, rho = 10).
    pub const fn loaded() -> Self {
        let mut ratios = Self::unloaded();
        ratios.piercing = Some(PiercingRatios::PAPER);
        ratios
    }

    /// The scene with m = 1 kg, k1 = 1 N/m, F0 = 1 N.
    ///
    /// # Errors
    /// [`SceneError`] if a ratio is out of range.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        self.dimensional(Units::ONE)
    }

    /// The scene in the given units.
    ///
    /// # Errors
    /// [`SceneError`] if a unit is not positive or a ratio is out of range.
    pub fn dimensional(&self, units: Units) -> Result<Scene, SceneError> {
        positive("mass", units.mass)?;
        positive("stiffness", units.stiffness)?;
        positive("excitation.amplitude", units.force)?;
        let length = units.force / units.stiffness;
        let critical = 2.0 * (units.mass * units.stiffness).sqrt();
        let scene = Scene {
            mass: units.mass,
            stiffness: units.stiffness,
            damping: self.damping * critical,
            excitation: Excitation {
                amplitude: units.force,
                frequency: self.frequency * (units.stiffness / units.mass).sqrt(),
                phase: 0.0,
            },
            clearance: self.clearance * length,
            contact_damping: self.contact_damping * critical,
            stop: Stop::Preloaded {
                stiffness: self.stiffness * units.stiffness,
                preload: self.preload * units.force,
            },
            piercing: self.piercing.map(|strip| Piercing {
                stiffness: strip.stiffness * units.stiffness,
                friction: strip.friction * units.stiffness,
                thickness: strip.thickness * length,
                travel: strip.travel * length,
            }),
        };
        scene.validate()?;
        Ok(scene)
    }
}
