//! A linear spring with the energy and force at its origin.

/// A linear spring: E = `energy` + `force` u + `stiffness` u^2 / 2 with u = x - `origin`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spring {
    /// Position in m where it begins.
    pub origin: f64,
    /// Energy in J stored there.
    pub energy: f64,
    /// Force in N there.
    pub force: f64,
    /// Stiffness in N/m.
    pub stiffness: f64,
}

impl Spring {
    /// Energy in J stored at a position.
    pub fn energy_at(&self, position: f64) -> f64 {
        let depth = position - self.origin;
        self.energy + depth * (self.force + 0.5 * self.stiffness * depth)
    }
}
