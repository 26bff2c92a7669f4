//! Answers along a course: of a linear law by doubling, along a Taylor step by the transition of its start and Gauss's
//! rule.

use nalgebra::{Matrix3x2, Vector3};

use super::arc_solution::{ArcSolution, Form};
use super::gauss::gauss_nodes;
use super::linearized::Linearized;
use super::parameter_response::{Answer, ParameterResponse};
use super::series::{Series, ZERO, convolve, product, value};
use super::taylor_step::TaylorStep;

/// Halvings of a step towards the face, where d^n ln d is not smooth.
const HALVINGS: i32 = 16;

impl ArcSolution {
    /// The answers `elapsed` seconds after departure, that to d^n ln d only if `logarithm` is asked for. None where
    /// they are not known: in bounces summed, in slow motion under heavy damping, under a force that is not constant.
    pub(crate) fn answers(&self, elapsed: f64, logarithm: bool) -> Option<ParameterResponse> {
        match &self.form {
            Form::Held => Some(ParameterResponse {
                free: Matrix3x2::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
                forced: [Answer::zeros(); 9],
                travel: (0.0, 0.0),
            }),
            Form::Particular { .. } | Form::Responses if self.departure.push.rate() == 0.0 => {
                Some(self.flow.answers(&self.departure, elapsed))
            }
            Form::TaylorStep(segment)
                if segment.creep.is_none() && segment.hertz.stiffness > 0.0 =>
            {
                Some(self.answers_of_step(segment, segment.parameter_at(elapsed), logarithm))
            }
            _ => None,
        }
    }

    /// With Y the transition from the start and J the row of its work, d(end) = (Y, J) d(start) + the integral of
    /// (Y, J) Y(s)^-1 (0, f(s)) - (0, J(s) Y(s)^-1 (0, f(s))).
    fn answers_of_step(&self, step: &TaylorStep, to: f64, logarithm: bool) -> ParameterResponse {
        let law = Linearized::of(step);
        let rate = law.rate;
        let (cos, sin) = self.turning(&rate);
        let against = product(&rate, &cos);
        let [first, second, _] = step.changes(&law, None);
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
        for (sigma, weight) in step.nodes(to, logarithm) {
            let y = free(sigma);
            let determinant = y[(0, 0)] * y[(1, 1)] - y[(0, 1)] * y[(1, 0)];
            let back = [-y[(0, 1)] / determinant, y[(0, 0)] / determinant];
            let time = weight * value(&rate, sigma);
            let work = y[(2, 0)] * back[0] + y[(2, 1)] * back[1];
            let kernel = time * Vector3::new(back[0], back[1], work);
            let moved = step.moved_at(sigma);
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
            forced: sums.map(|sum| free * sum.xy() - Answer::new(0.0, 0.0, sum.z)),
            travel,
        }
    }

    /// Cosine and sine of the drive angle as series in sigma.
    fn turning(&self, rate: &Series) -> (Series, Series) {
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
    /// Nodes and weights of Gauss's rule from 0 to `to`; at a face, if asked for, in pieces halved towards both ends.
    fn nodes(&self, to: f64, halved: bool) -> Vec<(f64, f64)> {
        if !halved || self.stretch.is_none() {
            return gauss_nodes(to).to_vec();
        }
        let mut nodes = Vec::new();
        for level in 1..=HALVINGS {
            let (from, last) = (0.5f64.powi(level + 1), level == HALVINGS);
            let from = if last { 0.0 } else { from };
            for (place, weight) in gauss_nodes(0.5f64.powi(level) - from) {
                nodes.push((to * (from + place), to * weight));
                nodes.push((to * (1.0 - from - place), to * weight));
            }
        }
        nodes
    }
}
