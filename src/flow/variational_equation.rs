//! The variational equation along a Taylor step.

use super::paired_products::Products;
use super::series::{Series, ZERO, integral, power_series, product};
use super::taylor_polynomials::{DEGREE, RECIPROCALS};
use super::taylor_step::TaylorStep;

/// The variational equation along a Taylor step, for the change y of the position and u of the velocity, by sigma; r =
/// d(time)/d(sigma), d and v deflection and velocity, 2 a and b linear damping and stiffness, kappa, lambda and n those
/// of the power law:
///
/// ```text
/// y' = r u    u' = force - 2 a r u - kappa lambda d^n r u - (b + kappa n d^(n-1) (1 + lambda v)) r y
/// ```
pub(super) struct VariationalEquation {
    /// r.
    pub rate: Series,
    /// 2 a.
    damping: f64,
    /// kappa lambda d^n r, if the power law dissipates.
    grip: Option<Series>,
    /// (b + kappa n d^(n-1) (1 + lambda v)) r.
    stiffness: Series,
}

impl VariationalEquation {
    pub fn along_step(step: &TaylorStep) -> Self {
        let (rate, hertz) = (step.time_rate_series(), &step.hertz);
        let mut stiffness = rate.map(|rate| step.stiffness * rate);
        let mut grip = None;
        if step.is_pressed {
            let (kappa, n) = (hertz.factor(), hertz.exponent);
            // d^(n-1) r
            let mut steepness = match &step.regularized {
                // Of a sphere it is the deflection.
                Some(regularized) if regularized.index * n - 1.0 == regularized.index => step.depth,
                Some(regularized) => power_series(&regularized.root, regularized.index * n - 1.0),
                None => power_series(&step.depth, n - 1.0),
            };
            if hertz.dissipation > 0.0 {
                let factor = kappa * hertz.dissipation;
                grip = Some(product(&steepness, &step.depth).map(|power| factor * power));
                let damped = product(&steepness, &step.velocity_series());
                for (steepness, damped) in steepness.iter_mut().zip(damped) {
                    *steepness += hertz.dissipation * damped;
                }
            }
            for (sum, steepness) in stiffness.iter_mut().zip(steepness) {
                *sum += kappa * n * steepness;
            }
        }
        Self {
            rate,
            damping: step.damping,
            grip,
            stiffness,
        }
    }

    /// The integral over time of damping over mass, linear and of the contact, up to `time`, where the step has this `sigma`.
    pub fn damping_integral(&self, time: f64, sigma: f64) -> f64 {
        let grip = self.grip.as_ref().map_or(0.0, |grip| integral(grip, sigma));
        self.damping * time + grip
    }

    /// Solutions (y, u) of the variational equation as series in sigma: from (1, 0), from (0, 1) and, if there is a
    /// force, from (0, 0) under it.
    pub fn solve_variations(&self, force: Option<&Series>) -> [[Series; 2]; 3] {
        let mut found = [[ZERO; 2]; 3];
        (found[0][0][0], found[1][1][0]) = (1.0, 1.0);
        let (mut free, mut forced, mut grips) = (Products::ZERO, Products::ZERO, Products::ZERO);
        for k in 0..DEGREE {
            let [[y0, u0], [y1, u1], [y2, u2]] = found.each_ref().map(|[y, u]| [y[k], u[k]]);
            let (rate, stiffness) = (self.rate[k], self.stiffness[k]);
            let [pull, way] = free.next_terms(k, [[stiffness; 2], [rate; 2]], [[y0, y1], [u0, u1]]);
            let [gripped, [gripped2, _]] = match &self.grip {
                Some(grip) => grips.next_terms(k, [[grip[k]; 2]; 2], [[u0, u1], [u2, 0.0]]),
                None => [[0.0; 2]; 2],
            };
            let next = RECIPROCALS[k + 1];
            let mut go_on = |column: usize, way: f64, resisting: f64| {
                let [y, u] = &mut found[column];
                y[k + 1] = next * way;
                u[k + 1] = -next * (self.damping * way + resisting);
            };
            for column in 0..2 {
                go_on(column, way[column], pull[column] + gripped[column]);
            }
            if let Some(force) = force {
                let [[pull, way]] = forced.next_terms(k, [[stiffness, rate]], [[y2, u2]]);
                go_on(2, way, pull + gripped2 - force[k]);
            }
        }
        found
    }
}
