//! Taylor steps under Hertz's law of a sphere, n = 3/2, as series of the square root s of the deflection D.
//!
//! With dt = s dsigma every term of the equation is a product of few series:
//!
//! ```text
//! 2 s'' = s A cos(angle) + (p - b x0) s - 2 a D' - D (b s + kappa D) - kappa lambda D^2 v
//! ```

use super::paired_products::Products;
use super::power_law::PowerLaw;
use super::taylor_polynomials::{DEGREE, RECIPROCALS};
use super::taylor_step::{RegularizedTime, TaylorStep};
use super::{Departure, LinearLaw};

/// True if the contact law is that of Hertz for a sphere, n = 3/2, and the forcing beside the drive is constant.
pub(super) fn is_sphere(hertz: &PowerLaw, from: &Departure) -> bool {
    hertz.exponent == 1.5 && from.forcing.is_constant()
}

impl TaylorStep {
    /// Computes all series of a step under the law of a sphere, in the regularised time sigma; `GRIPS` if the law dissipates.
    pub(super) fn expand_sphere<const GRIPS: bool>(
        &mut self,
        flow: &LinearLaw,
        from: &Departure,
        deflection: f64,
    ) -> Box<RegularizedTime> {
        let (kappa, b, w) = (self.hertz.factor(), flow.modes.stiffness, flow.frequency);
        let grip = kappa * self.hertz.dissipation;
        let constant = from.forcing.value() - b * self.hertz.origin;
        let mut regularized = Box::<RegularizedTime>::default();
        regularized.index = 2.0;
        let start = deflection.sqrt();
        let (mut cos, mut sin) = (
            flow.amplitude * from.drive.cos,
            flow.amplitude * from.drive.sin,
        );
        // The newest of s, the next one, and the newest of D: itself first, not the square of its rounded root.
        let (mut s, mut next, mut deep) = (start, 0.5 * from.velocity, deflection);
        // The drive against s; b s + kappa D and the next s against D and s; D and v against D and D^2.
        let (mut linear, mut squares) = (Products::ZERO, Products::ZERO);
        for k in 0..=DEGREE {
            let (rate, after) = (RECIPROCALS[k + 1], RECIPROCALS[k + 2]);
            let v = 2.0 * (k + 1) as f64 * next;
            (regularized.root[k], regularized.velocity[k]) = (s, v);
            (self.depth[k], self.forcing[k]) = (deep, cos);
            if k == DEGREE {
                break;
            }
            regularized.time[k + 1] = rate * s;
            let [[by_cos, by_sin], [mut press, squared]] = linear.next_terms(
                k,
                [[cos, sin], [b * s + kappa * deep, next]],
                [[s; 2], [deep, s]],
            );
            if GRIPS {
                let [[square, gripped]] = squares.next_terms(k, [[deep, v]], [[deep, 0.0]]);
                squares.replace_right(k, [[deep, square]]);
                press += grip * (gripped + from.velocity * square);
            }
            deep = squared + start * next;
            let driven = rate * (by_cos + constant * s - press) - flow.damping() * deep;
            (s, next) = (next, 0.5 * after * driven);
            (cos, sin) = (-w * rate * by_sin, w * rate * by_cos);
        }
        self.forcing[0] += from.forcing.value();
        self.is_pressed = true;
        regularized
    }
}
