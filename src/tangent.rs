//! The exact Jacobian of a motion: free transitions joined by saltation matrices.

mod frequency_sensitivity;
mod output_sensitivity;
mod parameter_sensitivity;
mod phase_derivatives;

pub use frequency_sensitivity::FrequencySensitivity;
pub use output_sensitivity::{Perturbation, Sensitivity};
pub use parameter_sensitivity::ParameterSensitivity;
pub use phase_derivatives::PhaseDerivatives;

use nalgebra::{Matrix2, Vector2};

use crate::flow::Transition;
use crate::integrator::{Arc, Crossing, CrossingKind, Observer};

/// Watches a motion and gathers d(state now) / d(state at the start).
#[derive(Debug, Clone, PartialEq)]
pub struct Tangent {
    /// The product so far.
    pub matrix: Matrix2<f64>,
    /// Integral of the damping coefficient over time and mass. As long as the mass neither turns nor sticks under dry
    /// friction, det(matrix) = exp(-damping_integral) times R^2 for each rebound from a rigid stop (Liouville).
    pub damping_integral: f64,
    /// Determinant of the product, the product of the determinants of its factors: free of the cancellation between
    /// entries that a weak impact makes large.
    pub determinant: f64,
}

impl Default for Tangent {
    fn default() -> Self {
        Self {
            matrix: Matrix2::identity(),
            damping_integral: 0.0,
            determinant: 1.0,
        }
    }
}

impl Tangent {
    /// Multiplies the tangent by the transition along an arc; `since`: seconds from where the drive angle is held to its start.
    fn extend_along(&mut self, arc: &Arc<'_>, elapsed: f64, since: Option<f64>) -> Transition {
        let transition = match arc.phase {
            Some(_) => arc.course.state_transition(elapsed, since),
            None => {
                self.determinant = 0.0;
                Transition {
                    matrix: Matrix2::new(1.0, 0.0, 0.0, 0.0),
                    damping: 0.0,
                    by_frequency: (!arc.course.is_chattering()).then(Vector2::zeros),
                }
            }
        };
        self.damping_integral += transition.damping;
        self.determinant *= (-transition.damping).exp();
        self.matrix = transition.matrix * self.matrix;
        transition
    }
}

impl Observer for Tangent {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.extend_along(arc, elapsed, None);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let saltation = saltation(crossing);
        self.determinant *= saltation.determinant();
        self.matrix = saltation * self.matrix;
    }
}

/// The saltation matrix S = G + (f+ - G f-) grad h / (grad h . f-) of a crossing, f = (v, a), G the
/// derivative of the reset (Aizerman and Gantmakher 1958; Leine and Nijmeijer 2004, ch. 7).
pub fn saltation(crossing: &Crossing) -> Matrix2<f64> {
    let (v, a) = (crossing.velocity, crossing.acceleration_before);
    let (v_after, a_after) = (crossing.velocity_after, crossing.acceleration_after);
    match crossing.kind {
        // The mass is held: nothing of a perturbation is left.
        CrossingKind::Surface { .. } if v_after == 0.0 => Matrix2::zeros(),
        CrossingKind::Rebound { .. } if v == 0.0 => Matrix2::zeros(),
        CrossingKind::Rest => Matrix2::zeros(),
        CrossingKind::Surface { .. } => Matrix2::new(v_after / v, 0.0, (a_after - a) / v, 1.0),
        CrossingKind::Rebound { .. } => {
            let kept = v_after / v;
            Matrix2::new(kept, 0.0, (a_after - kept * a) / v, kept)
        }
        CrossingKind::Reversal => {
            Matrix2::new(1.0, (v_after - v) / a, 0.0, 1.0 + (a_after - a) / a)
        }
        CrossingKind::Switch | CrossingKind::Release => Matrix2::identity(),
    }
}
