//! The first rise of a smooth function through zero on an interval, with a certificate.
//!
//! An interval is decided only when a bound proves what the function does there: it has one sign,
//! or it is monotone, or its curvature has one sign (then at most one extremum, which is located
//! and looked at: that is how a graze is told from a near miss). Otherwise it is halved.

use crate::budget;
use crate::flow::{DEGREE, evaluate};

/// A polynomial on [0, span] with a bound on its fourth derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardPolynomial<'a> {
    /// Coefficients, constant first.
    pub coefficients: &'a [f64; DEGREE + 1],
    /// Bound on |g''''| over the interval.
    pub bound: f64,
    /// Rounding of g: what stays below it cannot be told from zero.
    pub rounding: f64,
}

/// A function at one point: its value and first derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardPoint {
    pub at: f64,
    pub value: f64,
    pub rate: f64,
}

/// What is proven about an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    NoRise,
    /// g is <= 0 at the left and > 0 at the right, and rises through zero once between them.
    Rise,
    /// g falls to a bottom and rises from there on: once through zero if it is <= 0 there.
    RiseFromBottom,
    /// g rises to a top and falls from there on: once through zero if it is > 0 there.
    RiseToTop,
    Unknown,
}

/// Halvings after which an interval is below the resolution of its ends.
const DEEPEST: u32 = 60;

impl GuardPolynomial<'_> {
    /// The first s between two points at which g rises from <= 0 to > 0.
    pub fn first_rise(&self, left: GuardPoint, right: GuardPoint) -> Option<f64> {
        let (low, high) = self.isolate_rise(left, right, 0)?;
        Some(self.rise_between(low, high))
    }

    /// An interval on which g rises through zero once, the first between two points, by halving.
    fn isolate_rise(
        &self,
        left: GuardPoint,
        right: GuardPoint,
        depth: u32,
    ) -> Option<(GuardPoint, GuardPoint)> {
        match judge_interval(left, right, self.bound, self.rounding) {
            Verdict::NoRise => None,
            Verdict::Rise => Some((left, right)),
            Verdict::RiseFromBottom => bracket_of_rise(self.extremum_between(left, right), right),
            Verdict::RiseToTop => bracket_of_rise(left, self.extremum_between(left, right)),
            Verdict::Unknown => {
                let middle = 0.5 * (left.at + right.at);
                let is_smallest = middle <= left.at || middle >= right.at;
                if depth == DEEPEST || is_smallest || !budget::charge(budget::HALVING) {
                    return bracket_of_rise(left, right);
                }
                let middle = self.point_at(middle);
                self.isolate_rise(left, middle, depth + 1)
                    .or_else(|| self.isolate_rise(middle, right, depth + 1))
            }
        }
    }

    /// The point between two others at which g' changes its sign, once.
    fn extremum_between(&self, left: GuardPoint, right: GuardPoint) -> GuardPoint {
        let sign = if left.rate > 0.0 { -1.0 } else { 1.0 };
        let derivative = self.derivative_coefficients();
        let at = bracketed_newton(
            (left.at, sign * left.rate),
            (right.at, sign * right.rate),
            None,
            |s| {
                let (rate, curvature) = evaluate(&derivative, s);
                (sign * rate, sign * curvature)
            },
        );
        self.point_at(at)
    }

    /// The zero through which g rises between two points.
    fn rise_between(&self, low: GuardPoint, high: GuardPoint) -> f64 {
        let mut terms = self.coefficients.iter().enumerate();
        if low.at == 0.0
            && let Some((order, leading)) = terms.find(|(_, c)| **c != 0.0)
            && order > 0
            && *leading > 0.0
        {
            // At once, or the least time at which g is not zero: halving would take a thousand steps there.
            let share = 1.0 / order as f64;
            let leaves = f64::from_bits(1).powf(share) * leading.powf(-share);
            return if order == 1 { 0.0 } else { leaves.min(high.at) };
        }
        let guess = guess_rise(low, high);
        bracketed_newton((low.at, low.value), (high.at, high.value), guess, |s| {
            evaluate(self.coefficients, s)
        })
    }

    fn derivative_coefficients(&self) -> [f64; DEGREE + 1] {
        let mut rates = [0.0; DEGREE + 1];
        for (n, c) in self.coefficients.iter().enumerate().skip(1) {
            rates[n - 1] = n as f64 * c;
        }
        rates
    }

    /// g and its rate at a place.
    pub fn point_at(&self, at: f64) -> GuardPoint {
        let (value, rate) = evaluate(self.coefficients, at);
        GuardPoint { at, value, rate }
    }
}

/// What is proven of g between two points, with |g''''| <= `bound`.
pub(super) fn judge_interval(
    left: GuardPoint,
    right: GuardPoint,
    bound: f64,
    rounding: f64,
) -> Verdict {
    let span = right.at - left.at;
    let third = span / 3.0;
    let square = span * span;
    let bernstein = [
        left.value,
        left.value + third * left.rate,
        right.value - third * right.rate,
        right.value,
    ];
    let (low, high) = min_and_max(&bernstein);
    let slack = bound * square * square / 384.0;
    if high + slack < 0.0 || low - slack > 0.0 {
        return Verdict::NoRise;
    }
    let flat = high.max(-low) + slack <= rounding;
    if flat && left.value <= 0.0 && right.value <= 0.0 {
        return Verdict::NoRise;
    }
    if !slack.is_finite() {
        // The motion is about to leave the range of numbers; halving cannot help.
        return rise_by_ends(left, right);
    }
    // Bernstein coefficients of the interpolant's derivative, and its largest error
    // sqrt(3)/216 bound span^3 (Birkhoff and Priver 1967).
    let slopes = [left.rate, (bernstein[2] - bernstein[1]) / third, right.rate];
    let slack = 0.00802 * bound * square * span;
    let (low, high) = min_and_max(&slopes);
    if low - slack > 0.0 {
        return rise_by_ends(left, right);
    }
    if high + slack < 0.0 {
        return Verdict::NoRise;
    }
    judge_by_curvature(left, right, slopes, bound * square / 12.0)
}

/// What the sign of the curvature proves of g between two points, by the slopes of the interpolant and the error of
/// its curvature.
fn judge_by_curvature(
    left: GuardPoint,
    right: GuardPoint,
    slopes: [f64; 3],
    slack: f64,
) -> Verdict {
    let half = 0.5 * (right.at - left.at);
    let curvatures = [
        (slopes[1] - slopes[0]) / half,
        (slopes[2] - slopes[1]) / half,
    ];
    let (low, high) = min_and_max(&curvatures);
    let turns = left.rate * right.rate < 0.0;
    if low - slack > 0.0 {
        // Convex: beyond the bottom there is at most one zero, and g rises through it.
        let rises = right.rate > 0.0 && right.value > 0.0;
        if rises && left.value <= 0.0 {
            Verdict::Rise
        } else if rises && turns {
            Verdict::RiseFromBottom
        } else {
            Verdict::NoRise
        }
    } else if high + slack < 0.0 {
        // Concave: g rises before the top only.
        if right.value > 0.0 || !turns {
            rise_by_ends(left, right)
        } else {
            Verdict::RiseToTop
        }
    } else {
        Verdict::Unknown
    }
}

/// About where g rises through zero between two points, if they tell.
pub(super) fn guess_rise(low: GuardPoint, high: GuardPoint) -> Option<f64> {
    if low.rate > 0.0 {
        zero_by_inverse_hermite(low, high)
    } else {
        zero_of_parabola(low, high)
    }
}

/// Where the cubic through both ends, taken as position over value, passes zero.
fn zero_by_inverse_hermite(low: GuardPoint, high: GuardPoint) -> Option<f64> {
    let rise = high.value - low.value;
    let span = high.at - low.at;
    let u = -low.value / rise;
    let (m0, m1) = (rise / (low.rate * span), rise / (high.rate * span));
    let steep = low.rate > 0.0 && high.rate > 0.0 && m0 < 3.0 && m1 < 3.0;
    let v = 1.0 - u;
    let share = u * u * (3.0 - 2.0 * u) + u * v * v * m0 - u * u * v * m1;
    steep.then_some(low.at + share * span)
}

/// A rise if the values at the ends have opposite signs, where at most one is possible.
fn rise_by_ends(left: GuardPoint, right: GuardPoint) -> Verdict {
    if bracket_of_rise(left, right).is_some() {
        Verdict::Rise
    } else {
        Verdict::NoRise
    }
}

/// Both points, if g rises from <= 0 to > 0 between them.
fn bracket_of_rise(left: GuardPoint, right: GuardPoint) -> Option<(GuardPoint, GuardPoint)> {
    (left.value <= 0.0 && right.value > 0.0).then_some((left, right))
}

fn min_and_max(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(*v), high.max(*v))
        })
}

/// The later zero of the parabola through both values with the first slope.
fn zero_of_parabola(low: GuardPoint, high: GuardPoint) -> Option<f64> {
    let span = high.at - low.at;
    let curvature = (high.value - low.value - low.rate * span) / (span * span);
    let root = (low.rate * low.rate - 4.0 * curvature * low.value).sqrt();
    (curvature > 0.0).then(|| low.at + (root - low.rate) / (2.0 * curvature))
}

/// The zero of a function that rises from <= 0 at `low` to > 0 at `high` (position, value): Newton,
/// kept inside the bracket by bisection. It ends when the next step, foreseen from the last two as
/// for quadratic convergence, would be lost in rounding.
fn bracketed_newton(
    (mut low, f_low): (f64, f64),
    (mut high, f_high): (f64, f64),
    guess: Option<f64>,
    f: impl Fn(f64) -> (f64, f64),
) -> f64 {
    let secant = low - f_low * (high - low) / (f_high - f_low);
    let guess = guess.unwrap_or(secant);
    let mut at = if guess > low && guess < high {
        guess
    } else {
        0.5 * (low + high)
    };
    let mut last_step: Option<f64> = None;
    loop {
        let (value, rate) = f(at);
        if value > 0.0 {
            high = at;
        } else {
            low = at;
        }
        let step = value / rate;
        let next = at - step;
        let shrinks = step.abs() < 0.5 * last_step.unwrap_or(2.0 * (high - low)).abs();
        let converges = shrinks && next >= low && next <= high;
        if converges && let Some(last) = last_step {
            let foreseen = step.abs() * (step / last) * (step / last);
            if foreseen <= 0.25 * f64::EPSILON * next.abs() {
                return next;
            }
        }
        let target = if converges {
            next
        } else {
            // A thousand in a row where the bounces are as small as the least numbers.
            budget::charge(budget::HALVING);
            0.5 * (low + high)
        };
        if target <= low || target >= high {
            return target.clamp(low, high);
        }
        last_step = converges.then_some(step);
        at = target;
    }
}

#[cfg(test)]
mod tests {
    use super::GuardPolynomial;
    use crate::flow::DEGREE;

    #[test]
    fn a_rise_may_begin_at_a_zero() {
        let rise = |first: [f64; 3]| {
            let mut coefficients = [0.0; DEGREE + 1];
            coefficients[..3].copy_from_slice(&first);
            let candidate = GuardPolynomial {
                coefficients: &coefficients,
                bound: 0.0,
                rounding: 0.0,
            };
            candidate.first_rise(candidate.point_at(0.0), candidate.point_at(1.0))
        };
        assert_eq!(rise([0.0, 1.0, 0.0]), Some(0.0));
        assert!(rise([0.0, 0.0, 2.0]).is_some_and(|leaves| leaves > 0.0 && leaves < 1e-160));
        assert!(rise([0.0, -1.0, 2.0]).is_some_and(|later| (later - 0.5).abs() < 1e-15));
        assert_eq!(rise([0.0, -1.0, 0.0]), None);
    }
}
