//! One Taylor step of a nonlinear phase: the motion as a polynomial, with the time over which it is
//! exact to round-off.
//!
//! The deflection d from the face obeys d'' + 2 a d' + b (d + x0) + kappa d^n (1 + lambda d') = push.
//! Its coefficients follow one from the other (Moore 1966); those of w = d^n from d w' = n d' w. At the
//! face d^n has a branch point, so the steps grow and shrink with the distance from it; right at the
//! face, while the power law's part of the motion is below rounding, the motion is that of the linear
//! law.

use nalgebra::Matrix2;

use super::hertz::Hertz;
use super::power::gauss_nodes;
use super::taylor::{DEGREE, Taylor, evaluate, push_series};
use super::{Departure, Flow};

type Series = [f64; DEGREE + 1];

/// The motion of one step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    /// Deflection from the face in m, and the push per mass.
    taylor: Taylor,
    /// d^n.
    power: Series,
    /// Time in s over which it holds.
    pub end: f64,
    hertz: Hertz,
    flow: Flow,
}

/// What the last coefficients may amount to, relative to the first: well below rounding, since a
/// series that ends at its branch point converges slowly.
const TRUNCATION: f64 = f64::EPSILON / 64.0;

impl Segment {
    /// The step from a departure that lies `deflection` m beyond the face.
    pub fn new(flow: &Flow, hertz: &Hertz, from: &Departure, deflection: f64) -> Self {
        let push = push_series(flow, from.drive, (from.constant, from.ramp));
        let mut segment = Self {
            taylor: Taylor {
                position: [0.0; DEGREE + 1],
                push,
            },
            power: [0.0; DEGREE + 1],
            end: 0.0,
            hertz: *hertz,
            flow: *flow,
        };
        let start = (deflection, from.velocity);
        let power = deflection.max(0.0).powf(hertz.exponent);
        if deflection > f64::MIN_POSITIVE && power > f64::MIN_POSITIVE {
            segment.expand(start, power, from.acceleration);
            segment.end = segment.convergence().min(flow.reach);
        } else {
            segment.expand(start, 0.0, from.acceleration);
            segment.end = segment.shell();
        }
        segment
    }

    /// Coefficients from the first two and d^n at the start; without d^n if that is zero.
    fn expand(&mut self, (d, v): (f64, f64), power: f64, acceleration: Option<f64>) {
        let (twice_decay, b) = (2.0 * self.flow.modes.decay, self.flow.modes.stiffness);
        let Hertz {
            exponent,
            dissipation,
            origin,
            ..
        } = self.hertz;
        let kappa = self.hertz.rate();
        let mut x = [0.0; DEGREE + 1];
        let mut w = [0.0; DEGREE + 1];
        (x[0], x[1], w[0]) = (d, v, power);
        for k in 0..DEGREE - 1 {
            if k > 0 && power > 0.0 {
                w[k] = power_coefficient(&x, &w, exponent, k);
            }
            let pull = if k == 0 { b * origin } else { 0.0 };
            let mut press = w[k];
            if dissipation > 0.0 {
                let damped: f64 = (0..=k)
                    .map(|j| w[j] * (k - j + 1) as f64 * x[k - j + 1])
                    .sum();
                press += dissipation * damped;
            }
            let next = (k + 1) as f64;
            let sum = self.taylor.push[k] - pull - b * x[k] - kappa * press;
            x[k + 2] = (sum / next - twice_decay * x[k + 1]) / (next + 1.0);
            if k == 0
                && let Some(acceleration) = acceleration
            {
                x[2] = 0.5 * acceleration;
            }
        }
        self.taylor.position = x;
        self.power = w;
    }

    /// Time over which the last two coefficients stay below rounding (Jorba and Zou 2005).
    fn convergence(&self) -> f64 {
        let c = &self.taylor.position;
        let within = |last: usize| {
            let first = |j: usize| {
                let ratio = TRUNCATION * c[j].abs() / c[last].abs();
                ratio.powf(1.0 / (last - j) as f64)
            };
            if c[last] == 0.0 {
                f64::INFINITY
            } else {
                first(0).max(first(1)).max(first(2))
            }
        };
        within(DEGREE).min(within(DEGREE - 1))
    }

    /// Time over which the power law's part of the motion, at most kappa d^n (1 + lambda v) t^2 / 2,
    /// stays below rounding.
    fn shell(&self) -> f64 {
        let majorant: Series = self.taylor.position.map(f64::abs);
        let mut span = self.flow.reach;
        for _ in 0..2000 {
            let (depth, speed) = evaluate(&majorant, span);
            let grip = 1.0 + self.hertz.dissipation * speed;
            let press = self.hertz.rate() * depth.powf(self.hertz.exponent - 1.0) * grip;
            if press * span * span <= TRUNCATION {
                break;
            }
            span *= 0.5;
        }
        span
    }

    /// Position in m and velocity in m/s.
    pub fn state(&self, elapsed: f64) -> (f64, f64) {
        let (depth, velocity) = self.taylor.state(elapsed);
        (self.hertz.origin + depth, velocity)
    }

    /// Deflection in m.
    pub fn deflection(&self, elapsed: f64) -> f64 {
        self.taylor.state(elapsed).0
    }

    /// Deflection and push as polynomials, and where the deflection is zero.
    pub fn polynomials(&self) -> (&Taylor, f64) {
        (&self.taylor, self.hertz.origin)
    }

    /// Work of the push and work lost, per unit of mass, up to `elapsed`.
    pub fn power(&self, elapsed: f64) -> (f64, f64) {
        let kappa = self.hertz.rate() * self.hertz.dissipation;
        let pressed = self.power[0] != 0.0;
        let (mut supplied, mut lost) = (0.0, 0.0);
        for (s, weight) in gauss_nodes(elapsed) {
            let (depth, velocity) = self.taylor.state(s);
            let mut damping = 2.0 * self.flow.modes.decay;
            if pressed && kappa > 0.0 {
                damping += kappa * depth.max(0.0).powf(self.hertz.exponent);
            }
            supplied += weight * self.taylor.push(s) * velocity;
            lost += weight * damping * velocity * velocity;
        }
        (supplied, lost)
    }

    /// d(state)/d(state at the start) after `elapsed`, and the integral of damping over mass.
    pub fn transition(&self, elapsed: f64) -> (Matrix2<f64>, f64) {
        let kappa = self.hertz.rate();
        let damping: Series = {
            let mut damping = self.power.map(|w| kappa * self.hertz.dissipation * w);
            damping[0] += 2.0 * self.flow.modes.decay;
            damping
        };
        let stiffness = self.stiffness_series();
        let column = |start: (f64, f64)| {
            let mut y = [0.0; DEGREE + 1];
            (y[0], y[1]) = start;
            for k in 0..DEGREE - 1 {
                let sum: f64 = (0..=k)
                    .map(|j| {
                        stiffness[j] * y[k - j] + damping[j] * (k - j + 1) as f64 * y[k - j + 1]
                    })
                    .sum();
                y[k + 2] = -sum / ((k + 1) * (k + 2)) as f64;
            }
            evaluate(&y, elapsed)
        };
        let (first, second) = (column((1.0, 0.0)), column((0.0, 1.0)));
        let integral = damping
            .iter()
            .enumerate()
            .rev()
            .fold(0.0, |sum, (k, c)| elapsed * (c / (k + 1) as f64 + sum));
        (Matrix2::new(first.0, second.0, first.1, second.1), integral)
    }

    /// b + kappa n d^(n-1) (1 + lambda d').
    fn stiffness_series(&self) -> Series {
        let mut sum = [0.0; DEGREE + 1];
        sum[0] = self.flow.modes.stiffness;
        let x = &self.taylor.position;
        if self.power[0] == 0.0 {
            return sum;
        }
        let Hertz {
            exponent,
            dissipation,
            ..
        } = self.hertz;
        let factor = self.hertz.rate() * exponent;
        let mut u = [0.0; DEGREE + 1];
        u[0] = x[0].powf(exponent - 1.0);
        for k in 0..DEGREE - 1 {
            if k > 0 {
                u[k] = power_coefficient(x, &u, exponent - 1.0, k);
            }
            let damped: f64 = (0..=k)
                .map(|j| u[j] * (k - j + 1) as f64 * x[k - j + 1])
                .sum();
            sum[k] += factor * (u[k] + dissipation * damped);
        }
        sum
    }
}

/// The k-th coefficient, k >= 1, of w = x^n from those before it: x w' = n x' w.
fn power_coefficient(x: &Series, w: &Series, n: f64, k: usize) -> f64 {
    if n == 1.0 {
        return x[k];
    }
    let sum: f64 = (1..=k)
        .map(|j| (n * j as f64 - (k - j) as f64) * x[j] * w[k - j])
        .sum();
    sum / (k as f64 * x[0])
}
