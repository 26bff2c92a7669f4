//! A parameter in the unit of a key.

use super::{Parameter, Scene};

/// A parameter in the unit of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    pub parameter: Parameter,
    /// In SI units; none for a preload as a deflection of the stop.
    pub unit: Option<f64>,
}

impl Quantity {
    /// The unit of the quantity in a scene, in SI units: that of a preload as a deflection is the stiffness of the stop.
    pub fn unit_in(self, scene: &Scene) -> f64 {
        let stiffness = || Parameter::StopStiffness.get(scene).unwrap_or(f64::NAN);
        self.unit.unwrap_or_else(stiffness)
    }

    /// The value of the quantity in a scene; not a number if the scene lacks it.
    pub fn value_in(self, scene: &Scene) -> f64 {
        self.parameter.get(scene).unwrap_or(f64::NAN) / self.unit_in(scene)
    }

    /// Sets the quantity in a scene, to a value in its unit.
    pub fn set_in(self, scene: &mut Scene, value: f64) {
        self.parameter.set(scene, value * self.unit_in(scene));
    }
}
