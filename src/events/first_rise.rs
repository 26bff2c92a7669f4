//! The first rise of a smooth function through zero on an interval, with a certificate.
//!
//! An interval is decided only when a bound proves what the function does there: it has one sign,
//! or it is monotone, or its curvature has one sign (then at most one extremum, which is located
//! and looked at: that is how a graze is told from a near miss). Otherwise it is halved.

use super::guard::Guard;
use super::rise_verdict::{GuardPoint, RiseVerdict, bracket_of_rise, judge_interval};
use crate::budget;
use crate::flow::{DEGREE, derivative, value_and_rate};
use crate::root_finding::bracketed_newton;

/// A guard as a polynomial on [0, span], with a bound on its fourth derivative and its rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct GuardPolynomial<'a> {
    /// Coefficients, constant first.
    pub coefficients: &'a [f64; DEGREE + 1],
    /// Bound on |g''''| over the interval.
    pub bound: f64,
    /// Rounding of g: what stays below it cannot be told from zero.
    pub rounding: f64,
}

/// Most halvings of an interval in the search for a first rise: then it is below the resolution of its ends.
const MAX_HALVINGS: u32 = 60;

impl GuardPolynomial<'_> {
    /// The first place between two points at which the guard rises from <= 0 to > 0; none if it does not.
    pub fn first_rise(&self, left: GuardPoint, right: GuardPoint) -> Option<f64> {
        let (low, high) = self.isolate_rise(left, right, 0)?;
        Some(self.rise_between(low, high))
    }

    /// Halves an interval until it has the first rise of the guard alone; none if it has no rise.
    fn isolate_rise(
        &self,
        left: GuardPoint,
        right: GuardPoint,
        depth: u32,
    ) -> Option<(GuardPoint, GuardPoint)> {
        match judge_interval(left, right, self.bound, self.rounding) {
            RiseVerdict::NoRise => None,
            RiseVerdict::Rise => Some((left, right)),
            RiseVerdict::RiseFromBottom => {
                bracket_of_rise(self.extremum_between(left, right), right)
            }
            RiseVerdict::RiseToTop => bracket_of_rise(left, self.extremum_between(left, right)),
            RiseVerdict::Unknown => {
                let middle = 0.5 * (left.at + right.at);
                let is_smallest = middle <= left.at || middle >= right.at;
                if depth == MAX_HALVINGS || is_smallest || !budget::charge(budget::HALVING) {
                    return bracket_of_rise(left, right);
                }
                let middle = self.point_at(middle);
                self.isolate_rise(left, middle, depth + 1)
                    .or_else(|| self.isolate_rise(middle, right, depth + 1))
            }
        }
    }

    /// The one extremum of the guard between two points: the zero of its derivative, by bracketed Newton.
    fn extremum_between(&self, left: GuardPoint, right: GuardPoint) -> GuardPoint {
        let sign = if left.rate > 0.0 { -1.0 } else { 1.0 };
        let derivative = derivative(self.coefficients);
        let at = bracketed_newton(
            (left.at, sign * left.rate),
            (right.at, sign * right.rate),
            None,
            |s| {
                let (rate, curvature) = value_and_rate(&derivative, s);
                (sign * rate, sign * curvature)
            },
        );
        self.point_at(at)
    }

    /// The one zero through which the guard rises between two points, by bracketed Newton.
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
            value_and_rate(self.coefficients, s)
        })
    }

    /// Value and derivative of the guard polynomial at a time in s since its centre.
    pub fn point_at(&self, at: f64) -> GuardPoint {
        let (value, rate) = value_and_rate(self.coefficients, at);
        GuardPoint { at, value, rate }
    }
}

/// A guess of the place of the first rise between two points, by inverse interpolation or a parabola; none if their
/// values and slopes do not tell.
pub(super) fn guess_rise(low: GuardPoint, high: GuardPoint) -> Option<f64> {
    if low.rate > 0.0 {
        zero_by_inverse_hermite(low, high)
    } else {
        zero_of_parabola(low, high)
    }
}

/// A guess of a rise: where the inverse cubic Hermite interpolant, place over value, of two points has the value zero.
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

/// A guess of a rise: the later zero of the parabola through both points with the slope of the first.
fn zero_of_parabola(low: GuardPoint, high: GuardPoint) -> Option<f64> {
    let span = high.at - low.at;
    let curvature = (high.value - low.value - low.rate * span) / (span * span);
    let root = (low.rate * low.rate - 4.0 * curvature * low.value).sqrt();
    (curvature > 0.0).then(|| low.at + (root - low.rate) / (2.0 * curvature))
}

/// The index of the guard that rises first, and when, `rise` telling the time of the first rise of each; of two at once
/// the one of lower index.
pub(super) fn earliest_rise(
    guards: &[Guard],
    rise: impl Fn(&Guard) -> Option<f64>,
) -> Option<(usize, f64)> {
    let rises = guards.iter().map(rise).enumerate();
    rises
        .filter_map(|(index, rise)| Some((index, rise?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
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
