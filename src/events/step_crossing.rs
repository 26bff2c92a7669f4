//! The first crossing on one Taylor step.

use super::first_rise::{GuardPolynomial, earliest_rise};
use super::guard::Guard;
use super::{FoundCrossing, NextEvent};
use crate::flow::{DEGREE, ScanNode, TaylorStep, value};

/// The first crossing from `node` to the end of a Taylor step, by the series of each guard, whose coefficients give the
/// bound on the fourth derivative.
pub(super) fn crossing_on_step(step: &TaylorStep, guards: &[Guard], node: ScanNode) -> NextEvent {
    let (from, to) = (step.sigma_after(node.elapsed), step.reach);
    let (position, velocity) = step.last_state();
    let finite = position.is_finite() && velocity.is_finite();
    let held = step.is_still() && !step.forcing_at(to).is_finite();
    if !(to > 0.0 && finite) || held {
        return NextEvent::Unbounded(node);
    }
    let rise = |guard: &Guard| {
        if guard.is_of_position()
            && step.position_guard_stays_below(guard.position, guard.level, to)
        {
            return None;
        }
        let coefficients =
            step.guard_series(guard.position, guard.velocity, guard.forcing, guard.level);
        if series_stays_below(&coefficients, to) {
            return None;
        }
        let candidate = GuardPolynomial {
            coefficients: &coefficients,
            bound: fourth_derivative_bound(&coefficients, to),
            rounding: series_rounding(&coefficients, to),
        };
        candidate.first_rise(candidate.point_at(from), candidate.point_at(to))
    };
    match earliest_rise(guards, rise) {
        None => NextEvent::Ends(step.end),
        Some((guard, sigma)) => {
            let (position, velocity) = step.state_at(sigma);
            NextEvent::Crossing(FoundCrossing {
                elapsed: step.time_at_sigma(sigma),
                guard,
                position,
                velocity,
            })
        }
    }
}

/// True if the series of a guard along a Taylor step is below zero throughout [0, span], as its tangent and the sizes
/// of all other terms show.
fn series_stays_below(coefficients: &[f64; DEGREE + 1], span: f64) -> bool {
    let mut others = coefficients.map(f64::abs);
    (others[0], others[1]) = (0.0, 0.0);
    let tangent = coefficients[0] + (coefficients[1] * span).max(0.0);
    tangent + value(&others, span) < 0.0
}

/// Bound on the fourth derivative of a guard's series along a Taylor step over [0, span].
fn fourth_derivative_bound(coefficients: &[f64; DEGREE + 1], span: f64) -> f64 {
    let falling = |n: usize| (n * (n - 1) * (n - 2) * (n - 3)) as f64;
    coefficients
        .iter()
        .enumerate()
        .skip(4)
        .rev()
        .fold(0.0, |sum, (n, c)| sum * span + falling(n) * c.abs())
}

/// Rounding that a guard's series along a Taylor step may carry on [0, span].
fn series_rounding(coefficients: &[f64; DEGREE + 1], span: f64) -> f64 {
    let majorant = coefficients.map(f64::abs);
    f64::EPSILON * value(&majorant, span) + f64::MIN_POSITIVE
}
