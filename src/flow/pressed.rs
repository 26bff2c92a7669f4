//! Taylor steps in time under a power law: away from its face, or with n = 2.
//!
//! With w = d^n, d w' = n d' w; the product d' w in it is the one that the dissipation needs, too.

use super::expansion::{converges_densely, outgrown};
use super::hertz::Hertz;
use super::pairs::Products;
use super::series::{Series, ZERO};
use super::taylor::{DEGREE, RECIPROCALS, push_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

/// Ways to the face that a step may be as long as, at the present speed.
const WAYS: f64 = 1.25;

impl TaylorStep {
    /// The step from a departure beyond the face, by the deflection in m and its n-th power; none so close to the
    /// face that the coefficients of a fast mass overflow.
    pub(super) fn pressed(
        flow: &LinearLaw,
        hertz: &Hertz,
        from: &Departure,
        (deflection, raised): (f64, f64),
    ) -> Option<Self> {
        let mut segment = Self::blank(flow, hertz);
        segment.push = push_series(flow, from);
        segment.is_pressed = true;
        let start = (deflection, from.velocity, raised);
        let velocity = segment.press(flow, start);
        if !velocity[DEGREE].is_finite() {
            return None;
        }
        let ways = WAYS * deflection / from.velocity.abs();
        segment.ends_before(flow.reach.min(ways), from, &velocity);
        Some(segment)
    }

    /// The step where n = 2: the law is regular at the face, too.
    pub(super) fn squared(
        flow: &LinearLaw,
        hertz: &Hertz,
        from: &Departure,
        deflection: f64,
    ) -> Self {
        let mut segment = Self::blank(flow, hertz);
        segment.push = push_series(flow, from);
        segment.is_pressed = true;
        let velocity = segment.press_squared(flow, (deflection, from.velocity));
        segment.ends_before(flow.reach, from, &velocity);
        segment
    }

    /// Ends the step where its series no longer hold, or at `limit`.
    fn ends_before(&mut self, limit: f64, from: &Departure, velocity: &Series) {
        // What is below rounding of the velocity is so of the deflection.
        let mut reach = converges_densely(velocity).min(limit);
        if !from.push.is_linear() {
            reach = reach.min(outgrown(&self.depth)).min(outgrown(velocity));
        }
        self.ends_at(reach);
    }

    /// The series of the deflection where n = 2; that of the velocity is returned.
    fn press_squared(&mut self, flow: &LinearLaw, (deflection, velocity): (f64, f64)) -> Series {
        let (kappa, pull) = (self.hertz.rate(), flow.modes.stiffness);
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
            let [[square, gripped]] = products.next(k, [[d, next]], [[d, 0.0]]);
            products.amend(k, [[d, square]]);
            let press = kappa * square + grip * (gripped + velocity * square);
            let rate = RECIPROCALS[k + 1];
            let driven = load - pull * d - press;
            load = self.push[k + 1];
            (d, next) = (rate * next, rate * (driven - flow.damping() * next));
        }
        v
    }

    /// The series of the deflection; that of the velocity is returned.
    fn press(
        &mut self,
        flow: &LinearLaw,
        (deflection, velocity, raised): (f64, f64, f64),
    ) -> Series {
        let (kappa, pull) = (self.hertz.rate(), flow.modes.stiffness);
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
            let [[by_velocity, by_depth]] = products.next(k, [[newest, next]], [[w; 2]]);
            let driven = load - pull * d - grip * by_velocity - flow.damping() * newest;
            load = self.push[k + 1];
            (d, newest) = (next, rate * (driven - kappa * w));
            w = inverse * (rate * above * by_velocity - by_depth);
        }
        v
    }
}
