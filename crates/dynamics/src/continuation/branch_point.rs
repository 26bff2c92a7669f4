//! Points of branches.

use nalgebra::Vector2;

use crate::orbit::Monodromy;

/// A point of a branch: the orbit at one value of the parameter.
#[derive(Debug, Clone)]
pub struct BranchPoint {
    /// Value of the parameter.
    pub parameter: f64,
    /// Position in m at time 0.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Before-impact velocities in m/s over the period, in order of time.
    pub impacts: Vec<f64>,
    /// Jacobian of the map over the period; of an orbit that grazes, that without the touch.
    pub monodromy: Monodromy,
}

impl BranchPoint {
    /// The highest before-impact velocity at this point of a branch in m/s; 0 without any impact.
    pub fn before_impact_velocity(&self) -> f64 {
        self.impacts.iter().copied().fold(0.0, f64::max)
    }

    /// State of the orbit at this point of a branch at time 0, position and velocity.
    pub fn state(&self) -> Vector2<f64> {
        Vector2::new(self.position, self.velocity)
    }

    /// 1 - tr + det of the orbit at this point of a branch: zero at a fold, positive on its stable side.
    pub fn fold_test(&self) -> f64 {
        self.monodromy.fold_test()
    }

    /// True if the orbit at this point of a branch is stable.
    pub fn is_stable(&self) -> bool {
        self.monodromy.is_stable()
    }
}
