//! From dimensionless scenes to dimensional ones.

use serde::{Deserialize, Serialize};

use super::{Allowed, Excitation, Piercing, RigidStop, Scene, Slope, Stop};
use crate::error::SceneError;

/// The three units that make dimensionless scenes dimensional.
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

    /// Static deflection F0/k1 in m.
    pub fn length(&self) -> f64 {
        self.force / self.stiffness
    }

    /// Omega = sqrt(k1/m) in rad/s.
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    fn damping(&self) -> f64 {
        (self.mass * self.stiffness).sqrt()
    }
}

impl Scene {
    /// The same scene with every quantity multiplied by its unit.
    ///
    /// # Errors
    /// [`SceneError`] if a unit is not positive or a product leaves its range.
    pub fn in_units(&self, units: Units) -> Result<Self, SceneError> {
        Allowed::Positive.check("mass", units.mass)?;
        Allowed::Positive.check("stiffness", units.stiffness)?;
        Allowed::Positive.check("excitation.amplitude", units.force)?;
        let length = units.length();
        let scene = Self {
            mass: self.mass * units.mass,
            stiffness: self.stiffness * units.stiffness,
            damping: self.damping * units.damping(),
            excitation: Excitation {
                amplitude: self.excitation.amplitude * units.force,
                frequency: self.excitation.frequency * units.frequency(),
                phase: self.excitation.phase,
            },
            clearance: self.clearance * length,
            contact_damping: self.contact_damping * units.damping(),
            stop: self.stop.in_units(units),
            piercing: self.piercing.map(|strip| Piercing {
                stiffness: strip.stiffness * units.stiffness,
                friction: strip.friction * units.stiffness,
                thickness: strip.thickness * length,
                travel: strip.travel * length,
            }),
            rigid: self.rigid.map(|rigid| RigidStop {
                travel: rigid.travel * length,
                ..rigid
            }),
        };
        scene.validate()?;
        Ok(scene)
    }
}

impl Stop {
    fn in_units(&self, units: Units) -> Self {
        let length = units.length();
        let scaled = |slopes: &[Slope]| {
            let scale = |slope: &Slope| Slope {
                from: slope.from * length,
                stiffness: slope.stiffness * units.stiffness,
            };
            slopes.iter().map(scale).collect()
        };
        match self {
            Self::None => Self::None,
            Self::KelvinVoigt { stiffness, release } => Self::KelvinVoigt {
                stiffness: stiffness * units.stiffness,
                release: *release,
            },
            Self::PiecewiseLinear { loading, unloading } => Self::PiecewiseLinear {
                loading: scaled(loading),
                unloading: scaled(unloading),
            },
            Self::Hertz {
                stiffness,
                exponent,
                dissipation,
            } => Self::Hertz {
                stiffness: stiffness * units.force / length.powf(*exponent),
                exponent: *exponent,
                dissipation: dissipation / (length * units.frequency()),
            },
            Self::Preloaded { stiffness, preload } => Self::Preloaded {
                stiffness: stiffness * units.stiffness,
                preload: preload * units.force,
            },
            Self::Rigid { restitution } => Self::Rigid {
                restitution: *restitution,
            },
        }
    }
}
