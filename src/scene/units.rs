//! From dimensionless scenes to dimensional ones, by three units.

use serde::{Deserialize, Serialize};

use super::{Allowed, Dimension, Parameter, Scene, Stop, Ties};
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

    /// The unit of length, the static deflection F0/k1, in m.
    pub fn length(&self) -> f64 {
        self.force / self.stiffness
    }

    /// The unit of frequency, Omega = sqrt(k1/m), in rad/s.
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// A dimensionless quantity with its unit.
    fn with_unit(&self, dimension: Dimension, value: f64) -> f64 {
        match dimension {
            Dimension::Mass => value * self.mass,
            Dimension::Stiffness => value * self.stiffness,
            Dimension::Damping => value * (self.mass * self.stiffness).sqrt(),
            Dimension::Force => value * self.force,
            Dimension::Frequency => value * self.frequency(),
            Dimension::Length => value * self.length(),
            Dimension::Velocity => value * (self.length() * self.frequency()),
            Dimension::Time => value / self.frequency(),
            Dimension::Energy => value * (self.force * self.length()),
            Dimension::Power => value * (self.force * self.length() * self.frequency()),
            Dimension::Slowness => value / (self.length() * self.frequency()),
            Dimension::Angle | Dimension::Number => value,
        }
    }
}

impl Scene {
    /// The scene with every quantity multiplied by its unit. No parameter follows the frequency any more.
    ///
    /// # Errors
    /// [`SceneError`] if a unit is not positive or a product leaves its range.
    pub fn in_units(&self, units: Units) -> Result<Self, SceneError> {
        Allowed::Positive.check("mass", units.mass)?;
        Allowed::Positive.check("stiffness", units.stiffness)?;
        Allowed::Positive.check("excitation.amplitude", units.force)?;
        let mut scene = Self {
            followers: Ties::NONE,
            ..self.clone()
        };
        for parameter in Parameter::ALL {
            if let Some(value) = parameter.get(self) {
                let value = units.with_unit(parameter.about().dimension, value);
                parameter.set(&mut scene, value);
            }
        }
        scene.stop.take_units(&self.stop, units);
        if let (Some(below), Some(bare)) = (&mut scene.below, &self.below) {
            below.stop.take_units(&bare.stop, units);
        }
        scene.validate()?;
        Ok(scene)
    }
}

impl Stop {
    /// Takes the units of what is no parameter, or has a dimension of its own.
    fn take_units(&mut self, bare: &Self, units: Units) {
        match (self, bare) {
            (
                Self::Hertz {
                    stiffness,
                    exponent,
                    ..
                },
                Self::Hertz {
                    stiffness: bare, ..
                },
            ) => *stiffness = bare * units.force / units.length().powf(*exponent),
            (Self::PiecewiseLinear { loading, unloading }, _) => {
                for slope in loading.iter_mut().chain(unloading) {
                    slope.from *= units.length();
                    slope.stiffness *= units.stiffness;
                }
            }
            _ => {}
        }
    }
}
