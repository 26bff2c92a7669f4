//! One Taylor step.
//!
//! The deflection d from the face obeys d'' + 2 a d' + b (d + x0) + kappa d^n (1 + lambda d') = push. At
//! the face d^n has a branch point. For every n that is a multiple of 1/2 it goes away if the root
//! s = sqrt(d) is the unknown and a stretched time sigma, dt = s dsigma, the variable (as Levi-Civita
//! did for collisions, 1920):
//!
//! ```text
//! ds/dsigma = v/2    dv/dsigma = s (push - 2 a v - b (x0 + s^2) - kappa s^(2n) (1 + lambda v))    dt/dsigma = s
//! ```
//!
//! All are power series in sigma whose coefficients follow one from the other (Moore 1966). For
//! other n the steps grow and shrink with the distance from the face; right at the face, while the
//! power law's part of the motion is below rounding, it is left out. So it is on a start from rest at
//! the face, where sigma is time itself; and so it is in slow motion under heavy damping
//! ([`super::creep`]) and where there is no power law ([`super::pushed`]).

use serde::{Deserialize, Serialize};

use super::Flow;
use super::creep::Creep;
use super::gauss::gauss_nodes;
use super::hertz::Hertz;
use super::series::{Series, ZERO, derivative, integral_of_product, power, product, value};
use super::taylor::evaluate;

/// The motion of one step, as series in sigma.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    /// Deflection in m at departure.
    pub(super) departed: f64,
    /// Root of the deflection in sqrt(m); zero where sigma is time itself.
    pub(super) root: Series,
    /// Deflection in m: of a linear law, from position zero.
    pub(super) depth: Series,
    /// What rounding took from the deflection at the start, in m: a linear law's alone carries it.
    pub(super) low: f64,
    /// Velocity in m/s.
    pub(super) velocity: Series,
    /// Time since departure in s.
    pub(super) time: Series,
    /// Push per mass in m/s^2.
    pub(super) push: Series,
    /// d^n.
    pub(super) power: Series,
    /// How far the series hold, in sigma.
    pub(super) reach: f64,
    /// How far the mass stays beyond the face, in sigma: further on time would run back.
    pub(super) contact: f64,
    /// The same in time, in s.
    pub end: f64,
    pub(super) hertz: Hertz,
    pub(super) flow: Flow,
    /// What a slow motion remembers of its start.
    pub(super) creep: Option<Box<Creep>>,
}

/// A position more sharply than by its rounded value: where it counts from a nonlinear face, by the
/// deflection; else by what rounding took from it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Finer {
    /// Deflection in m.
    pub deflection: f64,
    /// Rest in m.
    pub low: f64,
}

/// Integrals along a course, per unit of mass, in m^2/s^2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Power {
    /// Work of the push, without the law's own constant force.
    pub supplied: f64,
    /// Work lost in the phase's damper, the integral of 2 a v^2.
    pub lost: f64,
}

impl Segment {
    /// True if sigma is time itself.
    pub(super) fn is_in_time(&self) -> bool {
        self.time[1] == 1.0 && self.root == ZERO
    }

    /// True if nothing moves.
    pub fn is_still(&self) -> bool {
        self.velocity == ZERO
    }

    /// Sigma at a time: Newton's method on a function that grows, kept inside its bracket.
    pub fn parameter_at(&self, elapsed: f64) -> f64 {
        if elapsed >= self.end {
            return self.contact;
        }
        if self.is_in_time() {
            return elapsed;
        }
        let (mut low, mut high) = (0.0, self.contact);
        let mut at = self.contact * (elapsed / self.end);
        for _ in 0..100 {
            let (time, rate) = evaluate(&self.time, at);
            if time > elapsed {
                high = at;
            } else {
                low = at;
            }
            let newton = at - (time - elapsed) / rate;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let settled = (time - elapsed).abs() <= f64::EPSILON * elapsed;
            if settled || next <= low || next >= high {
                return at;
            }
            at = next;
        }
        at
    }

    /// Position in m and velocity in m/s.
    pub fn state(&self, elapsed: f64) -> (f64, f64) {
        self.state_at(self.parameter_at(elapsed))
    }

    /// The same at sigma.
    pub fn state_at(&self, sigma: f64) -> (f64, f64) {
        let depth = self.depth_at(sigma);
        (self.hertz.origin + depth, value(&self.velocity, sigma))
    }

    fn depth_at(&self, sigma: f64) -> f64 {
        if self.is_in_time() {
            self.split_at(sigma).0
        } else {
            let root = value(&self.root, sigma);
            root * root
        }
    }

    /// The deflection in time, rounded, and what rounding took from it.
    fn split_at(&self, sigma: f64) -> (f64, f64) {
        let start = self.depth[0];
        let mut way = self.depth;
        way[0] = self.low;
        let way = value(&way, sigma);
        // The sum without error of Knuth (1969, 4.2.2, theorem B).
        let sum = start + way;
        let taken = sum - start;
        (sum, (start - (sum - taken)) + (way - taken))
    }

    /// What it was told of its start beyond the rounded position.
    pub fn finer_start(&self) -> Finer {
        Finer {
            deflection: self.departed,
            low: self.low,
        }
    }

    /// What the step knows of its end beyond the rounded position.
    pub fn finer(&self, elapsed: f64) -> Finer {
        let sigma = self.parameter_at(elapsed);
        Finer {
            deflection: self.depth_at(sigma),
            low: self.split_at(sigma).1,
        }
    }

    /// Push per mass in m/s^2 at sigma.
    pub fn push_at(&self, sigma: f64) -> f64 {
        value(&self.push, sigma)
    }

    /// Time since departure at sigma, in s.
    pub fn time_at(&self, sigma: f64) -> f64 {
        value(&self.time, sigma)
    }

    /// How far the series hold, in sigma.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// `position` x + `velocity` v + `push` q - `level` as a series in sigma; where it is the distance
    /// from the face itself, that of the root, which has the same sign.
    pub fn combination(&self, position: f64, velocity: f64, push: f64, level: f64) -> Series {
        // Seen from the face, a surface at the face is at zero exactly.
        let level = level - position * self.hertz.origin;
        let at_face = level == 0.0 && velocity == 0.0 && push == 0.0;
        let moved = if at_face && !self.is_in_time() {
            &self.root
        } else {
            &self.depth
        };
        let mut sum: Series = std::array::from_fn(|k| {
            position * moved[k] + velocity * self.velocity[k] + push * self.push[k]
        });
        sum[0] -= level;
        sum[0] += position * self.low;
        sum
    }

    /// Work up to `elapsed`; `law` is the part of the constant push that is the phase's own force.
    pub fn work(&self, elapsed: f64, law: f64) -> Power {
        if self.is_in_time() && self.power == ZERO {
            return self.work_in_time(elapsed, law);
        }
        let kappa = self.hertz.rate() * self.hertz.dissipation;
        let (mut supplied, mut lost) = (0.0, 0.0);
        for (sigma, weight) in gauss_nodes(self.parameter_at(elapsed)) {
            let velocity = value(&self.velocity, sigma);
            let travel = weight * evaluate(&self.time, sigma).1 * velocity;
            let mut damping = 2.0 * self.flow.modes.decay;
            if kappa > 0.0 {
                damping += kappa * value(&self.power, sigma);
            }
            supplied += travel * (value(&self.push, sigma) - law);
            lost += travel * damping * velocity;
        }
        Power { supplied, lost }
    }

    /// The same of a linear law: the integrals of the very polynomials, whatever their degree.
    fn work_in_time(&self, elapsed: f64, law: f64) -> Power {
        let mut force = self.push;
        force[0] -= law;
        let supplied = integral_of_product(&force, &self.velocity, elapsed);
        let square = integral_of_product(&self.velocity, &self.velocity, elapsed);
        let lost = 2.0 * self.flow.modes.decay * square;
        Power { supplied, lost }
    }

    /// 2 a + kappa lambda d^n.
    pub fn damping(&self) -> Series {
        let factor = self.hertz.rate() * self.hertz.dissipation;
        let mut damping = self.power.map(|w| factor * w);
        damping[0] += 2.0 * self.flow.modes.decay;
        damping
    }

    /// Its integral over time.
    pub(super) fn damping_integral(&self, sigma: f64) -> f64 {
        product(&derivative(&self.time), &self.damping())
            .iter()
            .enumerate()
            .rev()
            .fold(0.0, |sum, (k, c)| sigma * (c / (k + 1) as f64 + sum))
    }

    /// b + kappa n d^(n-1) (1 + lambda v).
    pub(super) fn stiffness(&self) -> Series {
        let mut sum = ZERO;
        if self.power != ZERO {
            let factor = self.hertz.rate() * self.hertz.exponent;
            let steepness = power(&self.root, 2.0 * self.hertz.exponent - 2.0);
            let damped = product(&steepness, &self.velocity);
            sum = std::array::from_fn(|k| {
                factor * (steepness[k] + self.hertz.dissipation * damped[k])
            });
        }
        sum[0] += self.flow.modes.stiffness;
        sum
    }
}
