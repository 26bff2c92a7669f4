//! Taylor steps in time itself: of a linear law under a force that is not linear in time, and under a power law away from its
//! face, or with n = 2.
//!
//! Of the linear law, with |r| <= rho for both roots, t^k / k! is answered from rest by coefficients of at most (n - k - 1)
//! rho^(n-k-2) / n! for t^n. So the first one that the polynomial leaves out is known beforehand, and the step can be
//! made so short that it is lost in the rounding of the others. What the drive and the free motion leave out is so over
//! one reach of the flow (see [`TaylorPolynomials`]).
//!
//! With w = d^n, d w' = n d' w; the product d' w in it is the one that the dissipation of the power law needs, too.

use super::convergence_reach::{
    dense_convergence_reach, leading_convergence_reach, reach_below_rounding,
};
use super::paired_products::Products;
use super::power_law::PowerLaw;
use super::series::{Series, ZERO};
use super::taylor_polynomials::{DEGREE, RECIPROCALS, TaylorPolynomials, forcing_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

impl TaylorStep {
    /// The Taylor step in time of a linear law; `low` is what rounding took from the position before.
    pub fn of_linear_law(flow: &LinearLaw, from: &Departure, low: f64) -> Self {
        let mut step = Self::linear_in_time(
            flow,
            &PowerLaw::default(),
            from,
            (from.position, from.velocity),
        );
        step.low = low;
        step.end_at(step.reach_under_polynomial_force(flow, from));
        step
    }

    /// The Taylor step in time of a mass that is held while the forcing changes.
    pub fn of_held_mass(flow: &LinearLaw, from: &Departure) -> Self {
        let mut step = Self::without_motion(flow, &PowerLaw::default());
        step.depth[0] = from.position;
        step.forcing = forcing_series(flow, from);
        step.end_at(flow.reach.min(leading_convergence_reach(&step.forcing)));
        step
    }

    /// The Taylor step in time of a linear law from the state `start`, not yet ended.
    pub(super) fn linear_in_time(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        start: (f64, f64),
    ) -> Self {
        let forcing = forcing_series(flow, from);
        let taylor = TaylorPolynomials::expand(flow, start, from.acceleration, forcing);
        let mut step = Self::without_motion(flow, hertz);
        step.depth = taylor.position;
        step.forcing = taylor.forcing;
        step
    }

    /// Time in s over which the series of a step in time hold to rounding, and over which the terms that the external force's
    /// powers of time bring stay below the leading three: a crossing early in a step would drown in the rounding of its end.
    pub(super) fn reach_under_polynomial_force(&self, flow: &LinearLaw, from: &Departure) -> f64 {
        let reach = flow.reach;
        if from.forcing.is_linear() {
            return reach;
        }
        let (depth, velocity) = (&self.depth, &self.velocity_series());
        let left_out = omitted_term_bound(flow, from);
        let order = (DEGREE + 1) as i32;
        reach
            .min(leading_convergence_reach(depth))
            .min(leading_convergence_reach(velocity))
            .min(reach_below_rounding(depth, left_out, order))
            .min(reach_below_rounding(
                velocity,
                f64::from(order) * left_out,
                order - 1,
            ))
    }

    /// The Taylor step in time under a power law from a departure beyond the face, by the deflection in m and its n-th
    /// power; none so close to the face that the coefficients of a fast mass overflow.
    pub(super) fn in_time_under_power_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        (deflection, raised): (f64, f64),
    ) -> Option<Self> {
        let mut step = Self::without_motion(flow, hertz);
        step.forcing = forcing_series(flow, from);
        step.is_pressed = true;
        let start = (deflection, from.velocity, raised);
        let velocity = step.expand_power_law(flow, start);
        if !velocity[DEGREE].is_finite() {
            return None;
        }
        // The series hold to a little beyond the face.
        let ways = 1.25 * deflection / from.velocity.abs();
        step.end_before(flow.reach.min(ways), from, &velocity);
        Some(step)
    }

    /// The Taylor step in time under a power law with n = 2, which is regular at the face, too.
    pub(super) fn in_time_under_square_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let mut step = Self::without_motion(flow, hertz);
        step.forcing = forcing_series(flow, from);
        step.is_pressed = true;
        let velocity = step.expand_square_law(flow, (deflection, from.velocity));
        step.end_before(flow.reach, from, &velocity);
        step
    }

    /// Ends a step in time where its series no longer hold to rounding, or at `limit` s.
    fn end_before(&mut self, limit: f64, from: &Departure, velocity: &Series) {
        // What is below rounding of the velocity is so of the deflection.
        let mut reach = dense_convergence_reach(velocity).min(limit);
        if !from.forcing.is_linear() {
            reach = reach
                .min(leading_convergence_reach(&self.depth))
                .min(leading_convergence_reach(velocity));
        }
        self.end_at(reach);
    }

    /// Computes the series in time of the deflection under a power law with n = 2, and returns that of the velocity.
    fn expand_square_law(
        &mut self,
        flow: &LinearLaw,
        (deflection, velocity): (f64, f64),
    ) -> Series {
        let (kappa, pull) = (self.hertz.factor(), flow.modes.stiffness);
        let grip = kappa * self.hertz.dissipation;
        let mut v = ZERO;
        let (mut d, mut next) = (deflection, velocity);
        // Deflection and velocity against deflection and its square.
        let mut products = Products::ZERO;
        let mut load = self.forcing[0] - pull * self.hertz.origin;
        for k in 0..=DEGREE {
            (self.depth[k], v[k]) = (d, next);
            if k == DEGREE {
                break;
            }
            let [[square, gripped]] = products.next_terms(k, [[d, next]], [[d, 0.0]]);
            products.replace_right(k, [[d, square]]);
            let press = kappa * square + grip * (gripped + velocity * square);
            let rate = RECIPROCALS[k + 1];
            let driven = load - pull * d - press;
            load = self.forcing[k + 1];
            (d, next) = (rate * next, rate * (driven - flow.damping() * next));
        }
        v
    }

    /// Computes the series in time of the deflection under a power law, and returns that of the velocity.
    fn expand_power_law(
        &mut self,
        flow: &LinearLaw,
        (deflection, velocity, raised): (f64, f64, f64),
    ) -> Series {
        let (kappa, pull) = (self.hertz.factor(), flow.modes.stiffness);
        let grip = kappa * self.hertz.dissipation;
        let (inverse, above) = (1.0 / deflection, self.hertz.exponent + 1.0);
        let mut v = ZERO;
        let (mut d, mut newest, mut w) = (deflection, velocity, raised);
        // Velocity and the next of the deflection against the n-th power.
        let mut products = Products::ZERO;
        let mut load = self.forcing[0] - pull * self.hertz.origin;
        for k in 0..=DEGREE {
            (self.depth[k], v[k]) = (d, newest);
            if k == DEGREE {
                break;
            }
            let rate = RECIPROCALS[k + 1];
            let next = rate * newest;
            let [[by_velocity, by_depth]] = products.next_terms(k, [[newest, next]], [[w; 2]]);
            let driven = load - pull * d - grip * by_velocity - flow.damping() * newest;
            load = self.forcing[k + 1];
            (d, newest) = (next, rate * (driven - kappa * w));
            w = inverse * (rate * above * by_velocity - by_depth);
        }
        v
    }
}

/// A bound on the first coefficient left out of the position's series in time, as far as it comes from the curved force.
fn omitted_term_bound(flow: &LinearLaw, from: &Departure) -> f64 {
    let rate = flow.modes.fastest_rate();
    let answer = |k: usize| (DEGREE - k) as f64 * rate.powi((DEGREE - 1 - k) as i32);
    let derivatives = from.forcing.derivatives().iter().enumerate().skip(2);
    let sum: f64 = derivatives.map(|(k, f)| f.abs() * answer(k)).sum();
    (2..=DEGREE + 1).fold(sum, |sum, n| sum / n as f64)
}
