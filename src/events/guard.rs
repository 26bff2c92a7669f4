//! What ends a phase: a linear function of state and forcing that rises through zero.

use crate::flow::{ArcSolution, DEGREE, ScanNode, TaylorPolynomials};

/// The event function that ends a phase: g = `position` x + `velocity` v + `forcing` q - `level`, when it rises through zero.
///
/// q is the forcing per mass, p(t) + A cos(angle): the force that is not the phase's own spring or damper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guard {
    /// Weight of the position, in 1/m.
    pub position: f64,
    /// Weight of the velocity, in s/m.
    pub velocity: f64,
    /// Weight of the forcing, in s^2/m.
    pub forcing: f64,
    /// Level to be crossed.
    pub level: f64,
}

impl Guard {
    /// The guard g = 0, which never rises.
    pub(crate) const NONE: Self = Self {
        position: 0.0,
        velocity: 0.0,
        forcing: 0.0,
        level: 0.0,
    };

    /// The guard that the position rises above `level` m.
    pub const fn rising_to(level: f64) -> Self {
        Self {
            position: 1.0,
            level,
            ..Self::NONE
        }
    }

    /// The guard that the position falls below `level` m.
    pub const fn falling_to(level: f64) -> Self {
        Self {
            position: -1.0,
            level: -level,
            ..Self::NONE
        }
    }

    /// The guard that the velocity turns from negative to positive.
    pub const fn turning_forward() -> Self {
        Self {
            velocity: 1.0,
            ..Self::NONE
        }
    }

    /// The guard that the forcing per mass rises above `level` m/s^2.
    pub const fn forcing_above(level: f64) -> Self {
        Self {
            forcing: 1.0,
            level,
            ..Self::NONE
        }
    }

    /// The guard -g, whose rise is the fall of this one.
    pub(crate) fn negated(&self) -> Self {
        Self {
            position: -self.position,
            velocity: -self.velocity,
            forcing: -self.forcing,
            level: -self.level,
        }
    }

    /// This guard of positions, velocities and forcings that are counted the other way.
    pub(crate) fn mirrored(&self) -> Self {
        Self {
            level: self.level,
            ..self.negated()
        }
    }

    /// The rounding that the guard g may carry in a state under a forcing per mass.
    pub(super) fn rounding_at(&self, position: f64, velocity: f64, forcing: f64) -> f64 {
        let terms = [
            self.position * position,
            self.velocity * velocity,
            self.forcing * forcing,
            self.level,
        ];
        2.0 * f64::EPSILON * terms.iter().map(|term| term.abs()).sum::<f64>() + f64::MIN_POSITIVE
    }

    /// True if the guard g depends on the position alone.
    pub(super) fn is_of_position(&self) -> bool {
        self.velocity == 0.0 && self.forcing == 0.0
    }

    /// The value of g in a state, for a guard that does not depend on the forcing.
    pub fn value_at(&self, position: f64, velocity: f64) -> f64 {
        self.position * position + self.velocity * velocity - self.level
    }

    /// True if bounds on position and forcing from `node` to the end of time prove that the guard g stays below zero.
    pub(crate) fn is_out_of_reach(&self, course: &ArcSolution, node: &ScanNode) -> bool {
        if self.velocity != 0.0 {
            return false;
        }
        let most = |weight: f64, (low, high): (f64, f64)| {
            if weight == 0.0 {
                0.0
            } else if weight > 0.0 {
                weight * high
            } else {
                weight * low
            }
        };
        most(self.position, course.position_range(node))
            + most(self.forcing, course.forcing_range())
            < self.level
    }

    /// Taylor coefficients of the guard g about the instant of these polynomials of position and forcing.
    pub(crate) fn taylor_coefficients(&self, taylor: &TaylorPolynomials) -> [f64; DEGREE + 1] {
        let (x, q) = (&taylor.position, &taylor.forcing);
        let mut g: [f64; DEGREE + 1] =
            std::array::from_fn(|n| self.position * x[n] + self.forcing * q[n]);
        if self.velocity != 0.0 {
            for (n, c) in x.iter().enumerate().skip(1) {
                g[n - 1] += self.velocity * n as f64 * c;
            }
        }
        g[0] -= self.level;
        g
    }
}
