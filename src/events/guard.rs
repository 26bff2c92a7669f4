//! What ends a phase: a linear function of state and forcing that rises through zero.

use crate::flow::{ArcSolution, DEGREE, ScanNode, TaylorPolynomials};

/// g = `position` x + `velocity` v + `forcing` q - `level`; the event is g rising through zero.
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
    /// g = 0.
    pub(crate) const NONE: Self = Self {
        position: 0.0,
        velocity: 0.0,
        forcing: 0.0,
        level: 0.0,
    };

    /// The position rises above `level` m.
    pub const fn rising_to(level: f64) -> Self {
        Self {
            position: 1.0,
            level,
            ..Self::NONE
        }
    }

    /// The position falls below `level` m.
    pub const fn falling_to(level: f64) -> Self {
        Self {
            position: -1.0,
            level: -level,
            ..Self::NONE
        }
    }

    /// The velocity turns from positive to negative.
    pub const fn turning_back() -> Self {
        Self {
            velocity: -1.0,
            ..Self::NONE
        }
    }

    /// The velocity turns from negative to positive.
    pub const fn turning_forward() -> Self {
        Self {
            velocity: 1.0,
            ..Self::NONE
        }
    }

    /// The forcing per mass rises above `level` m/s^2.
    pub const fn forcing_above(level: f64) -> Self {
        Self {
            forcing: 1.0,
            level,
            ..Self::NONE
        }
    }

    /// The forcing per mass falls below `level` m/s^2.
    pub const fn forcing_below(level: f64) -> Self {
        Self {
            forcing: -1.0,
            level: -level,
            ..Self::NONE
        }
    }

    /// The guard -g.
    pub(crate) fn negated(&self) -> Self {
        Self {
            position: -self.position,
            velocity: -self.velocity,
            forcing: -self.forcing,
            level: -self.level,
        }
    }

    /// g of positions, velocities and forcings that are counted the other way.
    pub(crate) fn mirrored(&self) -> Self {
        Self {
            level: self.level,
            ..self.negated()
        }
    }

    /// The rounding that g may carry at a state under a forcing.
    pub(super) fn rounding_at(&self, position: f64, velocity: f64, forcing: f64) -> f64 {
        let terms = [
            self.position * position,
            self.velocity * velocity,
            self.forcing * forcing,
            self.level,
        ];
        2.0 * f64::EPSILON * terms.iter().map(|term| term.abs()).sum::<f64>() + f64::MIN_POSITIVE
    }

    /// True if neither velocity nor forcing matters.
    pub(super) fn asks_for_position(&self) -> bool {
        self.velocity == 0.0 && self.forcing == 0.0
    }

    /// g at a state, for a guard that does not ask for the forcing.
    pub fn value_at(&self, position: f64, velocity: f64) -> f64 {
        self.position * position + self.velocity * velocity - self.level
    }

    /// True if g stays below zero for ever after `node`.
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

    /// Taylor coefficients of g about the expansion point.
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

/// Which of the guards rises first, by the time of the rise of each, and when; of two at once the first.
pub(super) fn earliest_rise(
    guards: &[Guard],
    rise: impl Fn(&Guard) -> Option<f64>,
) -> Option<(usize, f64)> {
    let rises = guards.iter().map(rise).enumerate();
    rises
        .filter_map(|(index, rise)| Some((index, rise?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}
