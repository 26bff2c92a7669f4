//! The first crossing on one Taylor step.

use super::isolate::Candidate;
use super::{Found, Guard, Outlook};
use crate::flow::{DEGREE, Node, Segment, evaluate};

/// The first crossing from `node` to the end of the step. Bounds on the fourth derivative follow from
/// the coefficients of the polynomial, which is the motion to round-off.
pub(super) fn first_crossing(segment: &Segment, guards: &[Guard], node: Node) -> Outlook {
    let (from, to) = (segment.parameter_at(node.elapsed), segment.reach());
    let (position, velocity) = segment.state_at(to);
    let push = segment.push_at(to);
    if !(to > 0.0
        && [position, velocity, push]
            .iter()
            .all(|number| number.is_finite()))
    {
        return Outlook::Unbounded(node);
    }
    let mut horizon = f64::INFINITY;
    let mut first = None;
    for (index, guard) in guards.iter().enumerate() {
        let coefficients =
            segment.combination(guard.position, guard.velocity, guard.push, guard.level);
        let candidate = Candidate {
            coefficients: &coefficients,
            bound: fourth_derivative(&coefficients, to),
            rounding: rounding(&coefficients, to),
        };
        if let Some(rise) = candidate
            .first_rise_between(from, to)
            .filter(|rise| *rise < horizon)
        {
            horizon = rise;
            first = Some(index);
        }
    }
    match first {
        None => Outlook::Ends(segment.end),
        Some(guard) => {
            let (position, velocity) = segment.state_at(horizon);
            Outlook::Crossing(Found {
                elapsed: segment.time_at(horizon),
                guard,
                position,
                velocity,
            })
        }
    }
}

/// Bound on |g''''| over [0, span].
fn fourth_derivative(coefficients: &[f64; DEGREE + 1], span: f64) -> f64 {
    let falling = |n: usize| (n * (n - 1) * (n - 2) * (n - 3)) as f64;
    coefficients
        .iter()
        .enumerate()
        .skip(4)
        .rev()
        .fold(0.0, |sum, (n, c)| sum * span + falling(n) * c.abs())
}

/// What g may carry of rounding on [0, span].
fn rounding(coefficients: &[f64; DEGREE + 1], span: f64) -> f64 {
    let majorant = coefficients.map(f64::abs);
    f64::EPSILON * evaluate(&majorant, span).0 + f64::MIN_POSITIVE
}
