//! The response of an arc to changes of its start, its law and its drive: of a linear law by doubling, along a Taylor
//! step by its transition and Gauss's rule.

use nalgebra::{Matrix3x2, Vector3};

use super::arc_solution::{ArcSolution, Form};
use super::gauss_quadrature::gauss_nodes;
use super::series::{Series, ZERO, convolve, product, value};
use super::taylor_step::TaylorStep;
use super::variational_equation::VariationalEquation;

/// Changes at one time of an arc: of position in m, of velocity in m/s, and of the integral of velocity times cos(drive
/// angle) in m, which is proportional to the work that the drive supplies.
pub(crate) type StateAndSupply = Vector3<f64>;

/// The forces per mass along an arc whose sum a change of its law or its drive amounts to.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ForceBasis {
    /// 1.
    Constant,
    /// Position, seen from the departure or, under a power law, from its face.
    Way,
    /// Velocity v.
    Velocity,
    /// Cosine of the drive angle.
    Cosine,
    /// Sine of the drive angle.
    Sine,
    /// The power law d^n (1 + lambda v) itself.
    Power,
    /// d^n v.
    Gripped,
    /// d^n ln d (1 + lambda v).
    Logarithm,
    /// d^(n - 1) (1 + lambda v).
    Steepness,
}

/// The coefficient of each force of [`ForceBasis`].
pub(crate) type ForceCoefficients = [f64; 9];

/// The response of an arc at one time to changes of its start, its law and its drive.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ParameterResponse {
    /// To changes of position and velocity at departure.
    pub free: Matrix3x2<f64>,
    /// From rest, to one of each source.
    pub forced: [StateAndSupply; 9],
    /// Integrals of the course's own velocity times cosine and sine of the drive angle, in m.
    pub travel: (f64, f64),
}

impl ParameterResponse {
    /// The response to a change at departure together with a change of the law or the drive.
    pub fn combined(&self, start: &StateAndSupply, forces: &ForceCoefficients) -> StateAndSupply {
        let carried = self.free * start.xy() + StateAndSupply::new(0.0, 0.0, start.z);
        let pairs = self.forced.iter().zip(forces);
        pairs.fold(carried, |sum, (answer, force)| sum + *force * answer)
    }
}

/// Halvings of the panels of a quadrature towards the face, where d^n ln d is not smooth.
const FACE_HALVINGS: i32 = 16;

impl ArcSolution {
    /// The response, `elapsed` seconds after departure, to changes of start, law and drive; that to d^n ln d only if
    /// `logarithm` asks for it. None where it is not known: in bounces summed, on the slow manifold, under a force that
    /// is not constant.
    pub(crate) fn parameter_response(
        &self,
        elapsed: f64,
        logarithm: bool,
    ) -> Option<ParameterResponse> {
        match &self.form {
            Form::Held => Some(ParameterResponse {
                free: Matrix3x2::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
                forced: [StateAndSupply::zeros(); 9],
                travel: (0.0, 0.0),
            }),
            Form::Particular { .. } | Form::Responses if self.departure.forcing.rate() == 0.0 => {
                Some(
                    self.flow
                        .parameter_response_by_doubling(&self.departure, elapsed),
                )
            }
            Form::TaylorStep(step)
                if step.slow_manifold.is_none() && step.hertz.stiffness > 0.0 =>
            {
                Some(self.parameter_response_of_step(step, step.sigma_after(elapsed), logarithm))
            }
            _ => None,
        }
    }

    /// The parameter response along a Taylor step, up to sigma = `to`. With Y the transition from the start and J the
    /// row of its work, d(end) = (Y, J) d(start) + the integral of (Y, J) Y(s)^-1 (0, f(s)) - (0, J(s) Y(s)^-1 (0, f(s))).
    fn parameter_response_of_step(
        &self,
        step: &TaylorStep,
        to: f64,
        logarithm: bool,
    ) -> ParameterResponse {
        let law = VariationalEquation::along_step(step);
        let rate = law.rate;
        let (cos, sin) = self.drive_series(&rate);
        let against = product(&rate, &cos);
        let [first, second, _] = step.variations(&law, None);
        let columns = [first, second].map(|[y, u]| {
            let work = product(&against, &u);
            let work = std::array::from_fn(|k| match k {
                0 => 0.0,
                _ => work[k - 1] / k as f64,
            });
            [y, u, work]
        });
        let free = |sigma: f64| -> Matrix3x2<f64> {
            let column = |of: &[Series; 3]| Vector3::from(of.each_ref().map(|s| value(s, sigma)));
            Matrix3x2::from_columns(&columns.each_ref().map(column))
        };
        let hertz = &step.hertz;
        let mut sums = [Vector3::zeros(); 9];
        let mut travel = (0.0, 0.0);
        for (sigma, weight) in step.quadrature_nodes(to, logarithm) {
            let y = free(sigma);
            let determinant = y[(0, 0)] * y[(1, 1)] - y[(0, 1)] * y[(1, 0)];
            let back = [-y[(0, 1)] / determinant, y[(0, 0)] / determinant];
            let time = weight * value(&rate, sigma);
            let work = y[(2, 0)] * back[0] + y[(2, 1)] * back[1];
            let kernel = time * Vector3::new(back[0], back[1], work);
            let moved = step.state_on_step_at(sigma);
            let (depth, velocity) = (moved.deflection, moved.velocity);
            let (cos, sin) = (value(&cos, sigma), value(&sin, sigma));
            let grip = 1.0 + hertz.dissipation * velocity;
            let deep = depth.max(0.0);
            let power = step.side() * deep.powf(hertz.exponent);
            let log = if power != 0.0 { deep.ln() } else { 0.0 };
            let sources = [
                1.0,
                step.side() * depth,
                step.side() * velocity,
                cos,
                sin,
                power * grip,
                power * velocity,
                power * log * grip,
                deep.powf(hertz.exponent - 1.0) * grip,
            ];
            for (sum, source) in sums.iter_mut().zip(sources) {
                *sum += source * kernel;
            }
            travel.0 += step.side() * time * cos * velocity;
            travel.1 += step.side() * time * sin * velocity;
        }
        let free = free(to);
        ParameterResponse {
            free,
            forced: sums.map(|sum| free * sum.xy() - StateAndSupply::new(0.0, 0.0, sum.z)),
            travel,
        }
    }

    /// Cosine and sine of the drive angle along a Taylor step, as series in sigma, for the parameter response.
    fn drive_series(&self, rate: &Series) -> (Series, Series) {
        let w = self.flow.frequency;
        let (mut cos, mut sin) = (ZERO, ZERO);
        (cos[0], sin[0]) = (self.departure.drive.cos, self.departure.drive.sin);
        for k in 0..ZERO.len() - 1 {
            let share = w / (k + 1) as f64;
            cos[k + 1] = -share * convolve(rate, &sin, k);
            sin[k + 1] = share * convolve(rate, &cos, k);
        }
        (cos, sin)
    }
}

impl TaylorStep {
    /// Nodes and weights in sigma of the quadrature of a parameter response from 0 to `to`; where the step meets a
    /// face, if `halved`, in panels halved towards both ends.
    fn quadrature_nodes(&self, to: f64, halved: bool) -> Vec<(f64, f64)> {
        if !halved || self.regularized.is_none() {
            return gauss_nodes(to).to_vec();
        }
        let mut nodes = Vec::new();
        for level in 1..=FACE_HALVINGS {
            let (from, last) = (0.5f64.powi(level + 1), level == FACE_HALVINGS);
            let from = if last { 0.0 } else { from };
            for (place, weight) in gauss_nodes(0.5f64.powi(level) - from) {
                nodes.push((to * (from + place), to * weight));
                nodes.push((to * (1.0 - from - place), to * weight));
            }
        }
        nodes
    }
}
