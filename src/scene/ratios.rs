//! The paper's dimensionless quantities.

use serde::{Deserialize, Serialize};

use super::{RigidStop, Scene, Stop, Strip};
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
    /// The strip, or none for the unloaded regime: k2/k1, k3/k1, sigma = s k1 / F0, nu = v k1 / F0.
    #[serde(default)]
    pub piercing: Option<Strip>,
    /// The rigid stop behind (phase IV), its travel epsilon = e k1 / F0.
    #[serde(default)]
    pub rigid: Option<RigidStop>,
}

impl Ratios {
    /// The ratios of the paper's unloaded regime at point A (eta = 1.15, rho = 10).
    pub const fn unloaded() -> Self {
        Self {
            frequency: 1.15,
            clearance: 10.0,
            damping: 0.02,
            contact_damping: 0.09,
            stiffness: 7.0,
            preload: 70.0,
            piercing: None,
            rigid: None,
        }
    }

    /// The ratios of the paper's loaded regime at point B (eta = 1.15, rho = 10).
    pub const fn loaded() -> Self {
        let mut ratios = Self::unloaded();
        ratios.piercing = Some(Strip::PAPER);
        ratios
    }

    /// These ratios at another frequency eta.
    #[must_use]
    pub const fn at_frequency(self, frequency: f64) -> Self {
        Self { frequency, ..self }
    }

    /// These ratios with another clearance rho.
    #[must_use]
    pub const fn at_clearance(self, clearance: f64) -> Self {
        Self { clearance, ..self }
    }

    /// The scene with m = 1 kg, k1 = 1 N/m, F0 = 1 N.
    ///
    /// # Errors
    /// [`SceneError`] if a ratio is out of range.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let mut scene = Scene {
            damping: 2.0 * self.damping,
            clearance: self.clearance,
            contact_damping: 2.0 * self.contact_damping,
            piercing: self.piercing,
            rigid: self.rigid,
            ..Scene::of_stop(Stop::Preloaded {
                stiffness: self.stiffness,
                preload: self.preload,
            })
        };
        scene.excitation.frequency = self.frequency;
        scene.validate()?;
        Ok(scene)
    }
}
