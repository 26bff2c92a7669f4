//! Slow motion under heavy damping, in steps that are long against the damped modes.
//!
//! Where a mode of the contact dies out within a small part of a step, nothing of it is left after its
//! first few lifetimes, and the motion is the one that needs no such mode: the formal power series whose
//! *last* coefficients are taken as given. Forward recurrence would multiply rounding by the fast rate at
//! each order; instead all coefficients are solved for together, by Newton's method (as Miller's
//! algorithm does for recurrences with a decaying solution).

use nalgebra::{SMatrix, SVector};

use crate::budget;

use super::free_motion::Modes;
use super::power_law::PowerLaw;
use super::series::{Series, convolve, derivative, power_series};
use super::taylor_polynomials::DEGREE;

/// Number of coefficients of the series on the slow manifold, the unknowns of Newton's method.
const ORDER: usize = DEGREE + 1;
/// Most steps of Newton's method for the series on the slow manifold.
const MAX_NEWTON_STEPS: usize = 12;
/// Lifetimes of a mode within a step on the slow manifold after which nothing of the mode is left.
const DECAY_LIFETIMES: f64 = 30.0;

/// The equation of motion in contact on the slow manifold, d'' + `twice_decay` d' + `stiffness` d + kappa d^n (1 +
/// lambda d') = `forcing`, whose solution is a series in time.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlowEquation<'a> {
    pub twice_decay: f64,
    pub stiffness: f64,
    pub hertz: &'a PowerLaw,
    /// The forcing less the pull of the suspension at the face.
    pub forcing: &'a Series,
}

/// A motion on the slow manifold as a series in time, with its derivatives by the start and the forcing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SlowManifold {
    /// Deflection in m.
    pub depth: Series,
    /// d(deflection)/d(deflection at the start); zero where its influence decays within the step.
    pub memory: Series,
    /// d(deflection)/d(velocity at the start), as a multiple of the memory, in s; to first order in the
    /// ratio of the slow rate to the fast one.
    pub echo: f64,
    /// d(deflection)/d(constant forcing per mass), in s^2.
    pub answer: Series,
}

/// The power-law force along a motion, and its derivatives by velocity (damping) and deflection (stiffness), those of the linear
/// law added, as series in time.
struct ForceAlongMotion {
    damping: Series,
    stiffness: Series,
    force: Series,
}

impl SlowEquation<'_> {
    /// The motion on the slow manifold through a start (deflection, velocity); none unless the start lies on it and
    /// steps of length `span` are long against the modes that die out.
    pub fn slow_motion(&self, (d, v): (f64, f64), span: f64) -> Option<SlowManifold> {
        let hertz = self.hertz;
        let press = hertz.factor() * d.powf(hertz.exponent);
        let damping = self.twice_decay + press * hertz.dissipation;
        let grip = 1.0 + hertz.dissipation * v;
        let stiffness = self.stiffness + hertz.exponent * press / d * grip;
        let modes = Modes::new(0.5 * damping, stiffness);
        let (slow, fast) = modes.decay_rates();
        let decays = slow * span >= DECAY_LIFETIMES;
        // A mode that is remembered must be resolved.
        let span = if decays { span } else { span.min(1.0 / slow) };
        if fast * span < DECAY_LIFETIMES {
            return None;
        }
        let depth = self.solve_series(d, span, decays)?;
        // A start lies on the manifold within 64 roundings.
        let tolerance = |value: f64, scale: f64| 64.0 * f64::EPSILON * (value.abs() + scale);
        let speed = tolerance(v, (self.forcing[0] / damping).abs());
        let near = (depth[0] - d).abs() <= tolerance(d, 0.0) && (depth[1] - v).abs() <= speed;
        near.then(|| self.manifold_with_derivatives(depth, span, decays))
    }

    /// The force and its derivatives along a motion with this series of its deflection.
    fn force_and_derivatives(&self, depth: &Series) -> ForceAlongMotion {
        let velocity = derivative(depth);
        let (kappa, lambda, n) = (
            self.hertz.factor(),
            self.hertz.dissipation,
            self.hertz.exponent,
        );
        let w = power_series(depth, n);
        let steep = power_series(depth, n - 1.0);
        let mut along_motion = ForceAlongMotion {
            damping: w.map(|w| kappa * lambda * w),
            stiffness: std::array::from_fn(|k| {
                kappa * n * (steep[k] + lambda * convolve(&steep, &velocity, k))
            }),
            force: std::array::from_fn(|k| kappa * (w[k] + lambda * convolve(&w, &velocity, k))),
        };
        along_motion.damping[0] += self.twice_decay;
        along_motion.stiffness[0] += self.stiffness;
        along_motion
    }

    /// The series of the deflection on the slow manifold, all coefficients together by Newton's method, scaled by
    /// powers of `span`; none if that does not converge. Unless the influence of the start `decays` within the span,
    /// its deflection `d` is kept.
    fn solve_series(&self, d: f64, span: f64, decays: bool) -> Option<Series> {
        let mut depth = [0.0; ORDER];
        depth[0] = d;
        let mut last = f64::INFINITY;
        for _ in 0..MAX_NEWTON_STEPS {
            budget::charge(budget::SLOW_MANIFOLD_STEP);
            let along_motion = self.force_and_derivatives(&depth);
            let matrix = residual_jacobian(&along_motion, span, decays);
            let residual = self.residual(&depth, &along_motion, span, decays);
            let step = matrix.lu().solve(&residual)?;
            let mut size: f64 = 0.0;
            for k in 0..ORDER {
                let change = step[k] / span.powi(k as i32);
                depth[k] -= change;
                size = size.max(step[k].abs());
            }
            if !(size.is_finite() && depth[0] > 0.0) {
                return None;
            }
            if size <= f64::EPSILON * depth[0] || (size >= last && size <= 1e-12 * depth[0]) {
                return Some(depth);
            }
            last = size;
        }
        None
    }

    /// The coefficients of the left side of the slow equation less its right side, scaled by powers of `span`, as the
    /// rows of [`residual_jacobian`].
    fn residual(
        &self,
        depth: &Series,
        along_motion: &ForceAlongMotion,
        span: f64,
        decays: bool,
    ) -> SVector<f64, ORDER> {
        let at = |k: usize| depth.get(k).copied().unwrap_or(0.0);
        let row = |k: usize| {
            let (first, second) = ((k + 1) as f64, (k + 2) as f64);
            let inertia = second * first * at(k + 2) + self.twice_decay * first * at(k + 1);
            inertia + self.stiffness * depth[k] + along_motion.force[k] - self.forcing[k]
        };
        SVector::from_fn(|index, _| match (decays, index) {
            (true, k) => row(k) * span.powi(k as i32),
            (false, 0) => 0.0,
            (false, k) => row(k - 1) * span.powi(k as i32 - 1),
        })
    }

    /// The motion on the slow manifold with this series of its deflection, and its derivatives.
    fn manifold_with_derivatives(&self, depth: Series, span: f64, decays: bool) -> SlowManifold {
        let along_motion = self.force_and_derivatives(&depth);
        let matrix = residual_jacobian(&along_motion, span, decays).lu();
        let solve = |row: usize| -> Series {
            let mut unit = SVector::<f64, ORDER>::zeros();
            unit[row] = 1.0;
            matrix.solve(&unit).map_or([0.0; ORDER], |solution| {
                std::array::from_fn(|k| solution[k] / span.powi(k as i32))
            })
        };
        let (memory, mut answer) = if decays {
            ([0.0; ORDER], solve(0))
        } else {
            (solve(0), solve(1))
        };
        // The slow part of (0, 1) is (1, s) / (s - f), with f + s = -damping.
        let echo = 1.0 / (along_motion.damping[0] + 2.0 * memory[1]);
        // An answer from rest lacks the velocity that the slow one begins with.
        let lacks = echo * answer[1];
        for (answer, memory) in answer.iter_mut().zip(memory) {
            *answer -= lacks * memory;
        }
        SlowManifold {
            depth,
            memory,
            echo,
            answer,
        }
    }
}

/// Derivative of the residual of the slow equation by the scaled coefficients of the deflection; unless the influence
/// of the start `decays`, its first row keeps the deflection at the start.
fn residual_jacobian(
    along_motion: &ForceAlongMotion,
    span: f64,
    decays: bool,
) -> SMatrix<f64, ORDER, ORDER> {
    let entry = |k: usize, j: usize| {
        let mut entry = 0.0;
        if j == k + 2 {
            entry += (j * (j - 1)) as f64;
        }
        if j >= 1 && j <= k + 1 {
            entry += along_motion.damping[k + 1 - j] * j as f64;
        }
        if j <= k {
            entry += along_motion.stiffness[k - j];
        }
        entry * span.powi(k as i32 - j as i32)
    };
    SMatrix::from_fn(|index, j| match (decays, index) {
        (true, k) => entry(k, j),
        (false, 0) => f64::from(u8::from(j == 0)),
        (false, k) => entry(k - 1, j),
    })
}
