//! Typical lengths and rates of a machine and of its motions.

use nalgebra::{Matrix2, Vector2};

use super::Scene;

/// A typical length and a typical rate: the measure of states and of maps between them, so that a
/// machine in other units behaves the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Length in m.
    pub length: f64,
    /// Rate in rad/s.
    pub rate: f64,
}

/// Least stiffness of a suspension that serves as a scale, in units of m w^2: the static deflection of a softer one is so large
/// that a motion told from it loses its digits.
pub const MIN_SCALE_STIFFNESS: f64 = 0.01;

impl Scene {
    /// The scales of the machine, the units of [`Ratios`](super::Ratios): the static deflection F0/k1 and Omega =
    /// sqrt(k1/m). A suspension far softer than m w^2 is replaced by that.
    #[doc(hidden)]
    pub fn scales(&self) -> Scales {
        let w = self.excitation.frequency;
        let stiffness = self.stiffness.max(MIN_SCALE_STIFFNESS * self.mass * w * w);
        Scales {
            length: or_one(self.excitation.amplitude / stiffness, self.clearance),
            rate: (stiffness / self.mass).sqrt(),
        }
    }

    /// The scales of its motions under this drive: the larger clearance or the amplitude F0/(m w^2) of a free mass,
    /// whichever is larger, and w.
    #[doc(hidden)]
    pub fn motion_scales(&self) -> Scales {
        let w = self.excitation.frequency;
        let free = self.excitation.amplitude / self.mass / (w * w);
        let below = self.below.as_ref().map_or(0.0, |below| below.clearance);
        let clearance = self.clearance.abs().max(below.abs());
        Scales {
            length: or_one(clearance.max(free), 0.0),
            rate: w,
        }
    }
}

/// A length, or another one where it vanishes.
fn or_one(length: f64, other: f64) -> f64 {
    let mut lengths = [length, other.abs()].into_iter();
    lengths.find(|length| *length > 0.0).unwrap_or(1.0)
}

impl Scales {
    /// The scale of velocities, length times rate, in m/s.
    pub fn speed(&self) -> f64 {
        self.length * self.rate
    }

    /// A state in these scales.
    pub fn state(&self, state: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(state.x / self.length, state.y / self.speed())
    }

    /// The Jacobian of a map of states in these scales.
    pub fn jacobian(&self, jacobian: &Matrix2<f64>) -> Matrix2<f64> {
        let [[xx, vx], [xv, vv]] = jacobian.data.0;
        Matrix2::new(xx, xv * self.rate, vx / self.rate, vv)
    }

    /// What rounding alone may leave of P(s) - s in these scales: that of the state, as the map stretches it.
    pub fn map_rounding(&self, state: &Vector2<f64>, jacobian: &Matrix2<f64>) -> f64 {
        1e-13 * (1.0 + self.state(state).norm()) * (1.0 + self.jacobian(jacobian).norm())
    }
}
