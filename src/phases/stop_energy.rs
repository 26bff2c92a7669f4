//! The energy that a stop keeps and gives back.

use crate::flow::PowerLaw;

/// What a stop stores: by its linear spring and by its power law. Where contact has ceased to press,
/// the stop is still deflected; what it then loses on its way back is dissipated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StopEnergy {
    /// The linear spring.
    pub spring: SpringEnergy,
    /// The power law.
    pub hertz: Option<PowerLaw>,
}

impl StopEnergy {
    /// This energy seen on a side: 1 as it is, -1 with positions counted the other way.
    pub(super) fn on_side(self, side: f64) -> Self {
        let SpringEnergy { origin, force, .. } = self.spring;
        Self {
            spring: SpringEnergy {
                origin: side * origin,
                force: side * force,
                ..self.spring
            },
            hertz: self.hertz.map(|hertz| hertz.on_side(side)),
        }
    }

    /// Energy in J stored at a position.
    pub fn energy_at(&self, position: f64) -> f64 {
        let hertz = self.hertz.map_or(0.0, |hertz| hertz.energy(position));
        self.spring.energy_at(position) + hertz
    }

    /// Elastic force in N at a position, the derivative of the energy.
    pub fn force_at(&self, position: f64) -> f64 {
        let hertz = self.hertz.map_or(0.0, |hertz| hertz.force(position, 0.0));
        let spring = &self.spring;
        spring.force + spring.stiffness * (position - spring.origin) + hertz
    }

    /// The elastic stiffness in N/m of the stop.
    pub fn stiffness_at(&self, position: f64) -> f64 {
        let hertz = self
            .hertz
            .map_or(0.0, |hertz| hertz.force_derivatives(position, 0.0).0);
        self.spring.stiffness + hertz
    }
}

/// A linear spring: E = `energy` + `force` u + `stiffness` u^2 / 2 with u = x - `origin`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpringEnergy {
    /// Position in m where it begins.
    pub origin: f64,
    /// Energy in J stored there.
    pub energy: f64,
    /// Force in N there.
    pub force: f64,
    /// Stiffness in N/m.
    pub stiffness: f64,
}

impl SpringEnergy {
    /// Energy in J stored at a position.
    pub fn energy_at(&self, position: f64) -> f64 {
        let depth = position - self.origin;
        self.energy + depth * (self.force + 0.5 * self.stiffness * depth)
    }
}
