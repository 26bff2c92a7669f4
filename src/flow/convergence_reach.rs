//! How far a truncated power series holds to rounding, by the sizes of its coefficients.

use super::series::{Series, ZERO};
use super::taylor_polynomials::{DEGREE, RECIPROCALS};

/// Binary logarithm of what the last terms of a series may amount to, relative to the first: 1/64 of rounding.
pub(super) const TRUNCATION: f64 = -58.0;

/// The reach of a series: the argument up to which its last terms are below the rounding of its first ones. It is
/// judged by the whole upper half, since by symmetry many coefficients may vanish.
pub(super) fn convergence_reach(series: &Series) -> f64 {
    reach_judged_from(TRUNCATION, series, DEGREE.div_ceil(2))
}

/// The reach of a series, judged by its last coefficients alone, of which no more than every other one vanishes.
pub(super) fn dense_convergence_reach(series: &Series) -> f64 {
    reach_judged_from(TRUNCATION, series, FIRST_JUDGED)
}

/// The reach of the series of the velocity under the law of a sphere, of which at least every fifth coefficient does
/// not vanish; the terms left out sum to an eighth of rounding.
pub(super) fn sphere_convergence_reach(series: &Series) -> f64 {
    reach_judged_from(-54.0, series, FIRST_JUDGED)
}

/// Order of the first of the last coefficients by which the reach of a series is judged where few of them vanish.
const FIRST_JUDGED: usize = DEGREE - 5;

/// The reach of a series whose coefficients from order `lower` on may amount to 2^`truncation` of its first.
fn reach_judged_from(truncation: f64, series: &Series, lower: usize) -> f64 {
    reach_below_margin(series, lower, |j| truncation * RECIPROCALS[DEGREE - j])
}

/// The argument up to which the leading terms of a series are larger than all others.
pub(super) fn leading_convergence_reach(series: &Series) -> f64 {
    reach_below_margin(
        series,
        leading_coefficient(series) + LEADING_COEFFICIENTS,
        |_| 0.0,
    )
}

/// Number of leading coefficients that the others of a series are measured against.
const LEADING_COEFFICIENTS: usize = 3;

/// The order of the leading coefficient of a series: 0, unless it begins with many zeros.
fn leading_coefficient(series: &Series) -> usize {
    let zeros = series.iter().take_while(|c| **c == 0.0).count();
    if zeros < LEADING_COEFFICIENTS {
        0
    } else {
        zeros
    }
}

/// The argument up to which every term of a series from order `lower` on is below one of the leading terms: below the
/// `j`-th times 2^`margin(j)` for each further order.
fn reach_below_margin(series: &Series, lower: usize, margin: impl Fn(usize) -> f64) -> f64 {
    let leading = leading_coefficient(series);
    let lower = lower.max(leading + LEADING_COEFFICIENTS);
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

/// The binary logarithm of the size of a coefficient of a series, at most a tenth too small; far below all others for zero.
fn binary_logarithm(coefficient: f64) -> f64 {
    const ONE: i64 = 1.0f64.to_bits() as i64;
    let bits = coefficient.abs().to_bits() as i64;
    (bits - ONE) as f64 * (1.0 / (1u64 << 52) as f64)
}

/// The argument up to which the first term left out of a series, `left_out` t^`order`, is below the rounding of a lower one.
pub(super) fn reach_below_rounding(series: &Series, left_out: f64, order: i32) -> f64 {
    if left_out == 0.0 || series == &ZERO {
        return f64::INFINITY;
    }
    let size = left_out.log2();
    let reach = |(j, coefficient): (usize, &f64)| {
        (coefficient.abs().log2() - size + TRUNCATION) / f64::from(order - j as i32)
    };
    let lower = series[..DEGREE.div_ceil(2)].iter().enumerate();
    // Comparisons pass over what is not a number: zero against zero.
    lower.map(reach).fold(f64::NEG_INFINITY, f64::max).exp2()
}
