//! The strip in front of the stop.

use serde::{Deserialize, Serialize};

/// The strip in front of the stop, which is pierced from the clearance on (Peterka 2003, eqs. 1-4): phase I forming, II cutting.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Strip {
    /// Stiffness k2 of the forming force in N/m, >= 0.
    pub stiffness: f64,
    /// Stiffness k3 of the dry friction in N/m, >= 0: its force is k3 (x - r) sign x'.
    pub friction: f64,
    /// Thickness s of the strip in m, >= 0: phase I is r < x < r + s.
    pub thickness: f64,
    /// Travel v in m, >= 0: phase II is r + s < x < r + s + v, the stop stands behind it.
    pub travel: f64,
}

impl Strip {
    /// The paper's strip, in its ratios: k2/k1 = 21, k3/k1 = 23, sigma = 0.4, sigma + nu = 0.9.
    pub const PAPER: Self = Self {
        stiffness: 21.0,
        friction: 23.0,
        thickness: 0.4,
        travel: 0.5,
    };

    /// Dry friction force in N of the cut strip, phase II, while the mass moves on (eq. 2).
    pub fn cut_force_forward(&self) -> f64 {
        0.1 * self.thickness * (self.stiffness + self.friction)
    }

    /// Dry friction force in N of the cut strip, phase II, while the mass moves back (eq. 3).
    pub fn cut_force_backward(&self) -> f64 {
        -0.05 * self.thickness * (self.stiffness + self.friction)
    }
}
