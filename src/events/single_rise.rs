//! A rise through zero that is known to be the only one between two nodes, located without a long polynomial.
//!
//! The jets of the nearer node tell about where it is; a state evaluated there lies so close to it that a
//! short Taylor polynomial is exact.

use super::first_rise::guess_rise;
use super::guard::Guard;
use super::node_derivatives::NodeDerivatives;
use super::rise_verdict::GuardPoint;
use crate::flow::{ArcSolution, ScanNode};

/// Share of the reach of a linear law (see [`LinearLaw`](crate::flow::LinearLaw)) over which a polynomial of degree 5
/// is exact to rounding.
const SHORT_STEP_SHARE: f64 = 1.0 / 512.0;
/// Most states that are evaluated before one is close enough to a single rise.
const MAX_EVALUATIONS: usize = 4;

/// Time since departure, position and velocity where a guard rises through zero between two nodes, where it rises once
/// at most; none if the full search is needed. The guard does not depend on the forcing.
pub(super) fn locate_single_rise(
    course: &ArcSolution,
    guard: &Guard,
    (left, right): (&ScanNode, &ScanNode),
    (low, high): (GuardPoint, GuardPoint),
) -> Option<(f64, f64, f64)> {
    let within = |at: f64| at > low.at && at < high.at;
    let start = left.elapsed;
    let reach = course.flow.reach;
    let outer = if low.rate > 0.0 { low.at } else { high.at };
    let first = guess_rise(low, high).unwrap_or(outer);
    let nearer_right = first > 0.5 * (low.at + high.at);
    let (origin, nearer) = if nearer_right {
        (high.at, right)
    } else {
        (low.at, left)
    };
    let series = NodeDerivatives::new(course, *nearer).guard_series(guard);
    let mut at = origin + zero_by_newton(&series, first - origin, SHORT_STEP_SHARE * reach)?;
    for _ in 0..MAX_EVALUATIONS {
        if !within(at) {
            return None;
        }
        let StateNearRise {
            near,
            series,
            from,
            change,
        } = StateNearRise::new(course, guard, start, at);
        let rest = match zero_by_reversion(&series) {
            Some(rest) => rest,
            None => zero_by_newton(&series, 0.0, 0.25 * f64::EPSILON * near.node.elapsed)?,
        };
        if rest.abs() <= SHORT_STEP_SHARE * reach.min(8.0 * at) {
            let mut further = near.position_series();
            let rate = std::mem::take(&mut further[1]);
            further[0] = 0.0;
            let (way, rise) = quintic_value_and_rate(&further, rest);
            let position = from.0 + (change.0 + (rate * rest + way));
            let velocity = from.1 + (change.1 + rise);
            let elapsed = near.node.elapsed + rest;
            return within(elapsed - start).then_some((elapsed, position, velocity));
        }
        at += rest;
    }
    None
}

/// A state close to a single rise, with the guard as a series about it: soon after the departure as a change since
/// then, so that what is small against the position keeps its digits.
struct StateNearRise {
    near: NodeDerivatives,
    /// The guard there.
    series: [f64; 6],
    /// Position and velocity from which it is told.
    from: (f64, f64),
    /// What they have changed by.
    change: (f64, f64),
}

impl StateNearRise {
    /// The state `at` seconds after `start`, that of the left node.
    fn new(course: &ArcSolution, guard: &Guard, start: f64, at: f64) -> Self {
        if start == 0.0
            && let Some((node, change)) = course.node_near_start(at)
        {
            let near = NodeDerivatives::new(course, node);
            let mut series = near.guard_series(guard);
            let from = (course.departure.position, course.departure.velocity);
            let begin = guard.value_at(from.0, from.1);
            series[0] = begin + (guard.position * change.0 + guard.velocity * change.1);
            return Self {
                near,
                series,
                from,
                change,
            };
        }
        let near = NodeDerivatives::new(course, course.node_at(start + at));
        Self {
            series: near.guard_series(guard),
            from: (near.node.position, near.node.velocity),
            change: (0.0, 0.0),
            near,
        }
    }
}

/// The zero next to 0 through which the series of a guard rises, by reversion of the series, and one step of Newton's
/// method where that is not exact; none if that does not settle it.
fn zero_by_reversion(c: &[f64; 6]) -> Option<f64> {
    let inverse = 1.0 / c[1];
    let [a, b, d] = [c[2], c[3], c[4]].map(|c| c * inverse);
    let s = -c[0] * inverse;
    let (second, third) = (2.0 * a * a - b, 5.0 * a * (b - a * a) - d);
    // What a term of this relative size adds is lost in rounding.
    let lost = f64::EPSILON / 16.0;
    let size = (a * s)
        .abs()
        .max((b * s * s).abs().max((d * s * s * s).abs()));
    if !(c[1] > 0.0 && size.powi(8) <= lost) {
        return None;
    }
    let rest = s - s * s * (a - s * (second + s * third));
    if size.powi(4) <= lost {
        return Some(rest);
    }
    let (value, rate) = quintic_value_and_rate(c, rest);
    Some(rest - value / rate)
}

/// The zero near `at` through which the series of a guard rises, by Newton's method until the next step, foreseen from
/// the last two as for quadratic convergence, is below `grain`; none if it does not converge.
fn zero_by_newton(series: &[f64; 6], mut at: f64, grain: f64) -> Option<f64> {
    let mut last = f64::INFINITY;
    for _ in 0..MAX_NEWTON_STEPS {
        let (value, rate) = quintic_value_and_rate(series, at);
        let step = value / rate;
        at -= step;
        if !(rate > 0.0 && step.abs() < last) {
            return (step == 0.0).then_some(at);
        }
        let foreseen = step.abs() * (step / last) * (step / last);
        if last.is_finite() && foreseen <= grain {
            return Some(at);
        }
        last = step.abs();
    }
    None
}

/// Most steps of Newton's method.
const MAX_NEWTON_STEPS: usize = 8;

/// Value and first derivative at `s` of the series of a guard or a position about a single rise, of degree 5.
#[inline]
fn quintic_value_and_rate(c: &[f64; 6], s: f64) -> (f64, f64) {
    let square = s * s;
    let value = (c[0] + c[1] * s) + square * ((c[2] + c[3] * s) + square * (c[4] + c[5] * s));
    let rate =
        (c[1] + 2.0 * c[2] * s) + square * ((3.0 * c[3] + 4.0 * c[4] * s) + square * (5.0 * c[5]));
    (value, rate)
}
