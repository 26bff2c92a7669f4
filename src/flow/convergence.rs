//! How far a truncated power series holds to rounding, by the sizes of its coefficients.

use super::series::Series;
use super::taylor::{DEGREE, RECIPROCALS};

/// Binary logarithm of what the last coefficients may amount to, relative to the first: 1/64 of rounding.
pub(super) const TRUNCATION: f64 = -58.0;

/// The truncation bound for a sphere, where the terms left out sum to an eighth of rounding.
const OF_SPHERE: f64 = -54.0;

/// The reach of a series: where its terms from the last one on are below rounding of its first ones, judged by the
/// whole upper half, since by symmetry many coefficients may vanish.
pub(super) fn convergence_reach(series: &Series) -> f64 {
    reach_judged_from(TRUNCATION, series, DEGREE.div_ceil(2))
}

/// The reach of a series of which no more than every other coefficient vanishes.
pub(super) fn dense_convergence_reach(series: &Series) -> f64 {
    reach_judged_from(TRUNCATION, series, LAST)
}

/// The reach of the series of the velocity on a sphere, of which at least every fifth coefficient does not vanish.
pub(super) fn sphere_convergence_reach(series: &Series) -> f64 {
    reach_judged_from(OF_SPHERE, series, LAST)
}

/// First of the last coefficients, which are judged where few vanish.
const LAST: usize = DEGREE - 5;

/// The reach of a series with this bound, judged by its coefficients from `lower` on.
fn reach_judged_from(truncation: f64, series: &Series, lower: usize) -> f64 {
    reach_below_margin(series, lower, |j| truncation * RECIPROCALS[DEGREE - j])
}

/// Up to where the first terms of a series are larger than all others.
pub(super) fn first_span(series: &Series) -> f64 {
    reach_below_margin(series, first_measure(series) + FIRST, |_| 0.0)
}

/// Number of first coefficients that the others are measured against.
const FIRST: usize = 3;

/// The first coefficient to measure against: the very first one, unless the series begins with many zeros.
fn first_measure(series: &Series) -> usize {
    let zeros = series.iter().take_while(|c| **c == 0.0).count();
    if zeros < FIRST { 0 } else { zeros }
}

/// Where the terms from `lower` on are still below one of the first, the `j`-th, times the binary power `margin`(j)
/// for each further order.
fn reach_below_margin(series: &Series, lower: usize, margin: impl Fn(usize) -> f64) -> f64 {
    let leading = first_measure(series);
    let lower = lower.max(leading + FIRST);
    if lower > DEGREE {
        return f64::INFINITY;
    }
    let first = [0, 1, 2].map(|offset| {
        let j = leading + offset;
        (j, binary_logarithm(series[j]), margin(j))
    });
    let mut reach = f64::INFINITY;
    for (last, coefficient) in (lower..).zip(&series[lower..]) {
        let size = binary_logarithm(*coefficient);
        let mut within = f64::NEG_INFINITY;
        for (j, first, margin) in first {
            let against = (first - size) * RECIPROCALS[last - j] + margin;
            within = if against > within { against } else { within };
        }
        reach = if within < reach { within } else { reach };
    }
    reach.exp2()
}

/// The binary logarithm of a coefficient's size, at most a tenth too small; far below all others for zero.
fn binary_logarithm(coefficient: f64) -> f64 {
    const ONE: i64 = 1.0f64.to_bits() as i64;
    let bits = coefficient.abs().to_bits() as i64;
    (bits - ONE) as f64 * (1.0 / (1u64 << 52) as f64)
}
