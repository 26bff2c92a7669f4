//! Taylor steps under a power law in time itself: away from its face, or with n = 2.
//!
//! With w = d^n, d w' = n d' w; the product d' w in it is the one that the dissipation needs, too.

use super::convergence::{dense_convergence_reach, first_span};
use super::paired_products::Products;
use super::power_law::PowerLaw;
use super::series::{Series, ZERO};
use super::taylor::{DEGREE, RECIPROCALS, push_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

/// Ways to the face that a step may be as long as, at the present speed.
const WAYS: f64 = 1.25;

impl TaylorStep {
    /// The step from a departure beyond the face, by the deflection in m and its n-th power; none so close to the
    /// face that the coefficients of a fast mass overflow.
    pub(super) fn in_time_under_power_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        (deflection, raised): (f64, f64),
    ) -> Option<Self> {
        let mut segment = Self::without_motion(flow, hertz);
        segment.push = push_series(flow, from);
        segment.is_pressed = true;
        let start = (deflection, from.velocity, raised);
        let velocity = segment.expand_power_law(flow, start);
        if !velocity[DEGREE].is_finite() {
            return None;
        }
        let ways = WAYS * deflection / from.velocity.abs();
        segment.end_before(flow.reach.min(ways), from, &velocity);
        Some(segment)
    }

    /// The step under a square law, n = 2, which is regular at the face, too.
    pub(super) fn in_time_under_square_law(
        flow: &LinearLaw,
        hertz: &PowerLaw,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let mut segment = Self::without_motion(flow, hertz);
        segment.push = push_series(flow, from);
        segment.is_pressed = true;
        let velocity = segment.expand_square(flow, (deflection, from.velocity));
        segment.end_before(flow.reach, from, &velocity);
        segment
    }

    /// Ends the step where its series no longer hold, or at `limit`.
    fn end_before(&mut self, limit: f64, from: &Departure, velocity: &Series) {
        // What is below rounding of the velocity is so of the deflection.
        let mut reach = dense_convergence_reach(velocity).min(limit);
        if !from.push.is_linear() {
            reach = reach.min(first_span(&self.depth)).min(first_span(velocity));
        }
        self.end_at(reach);
    }

    /// The series of the deflection where n = 2; that of the velocity is returned.
    fn expand_square(&mut self, flow: &LinearLaw, (deflection, velocity): (f64, f64)) -> Series {
        let (kappa, pull) = (self.hertz.factor(), flow.modes.stiffness);
        let grip = kappa * self.hertz.dissipation;
        let mut v = ZERO;
        let (mut d, mut next) = (deflection, velocity);
        // Deflection and velocity against deflection and its square.
        let mut products = Products::ZERO;
        let mut load = self.push[0] - pull * self.hertz.origin;
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
            load = self.push[k + 1];
            (d, next) = (rate * next, rate * (driven - flow.damping() * next));
        }
        v
    }

    /// The series of the deflection; that of the velocity is returned.
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
        let mut load = self.push[0] - pull * self.hertz.origin;
        for k in 0..=DEGREE {
            (self.depth[k], v[k]) = (d, newest);
            if k == DEGREE {
                break;
            }
            let rate = RECIPROCALS[k + 1];
            let next = rate * newest;
            let [[by_velocity, by_depth]] = products.next_terms(k, [[newest, next]], [[w; 2]]);
            let driven = load - pull * d - grip * by_velocity - flow.damping() * newest;
            load = self.push[k + 1];
            (d, newest) = (next, rate * (driven - kappa * w));
            w = inverse * (rate * above * by_velocity - by_depth);
        }
        v
    }
}
