//! Truncated power series.

use super::taylor::{DEGREE, evaluate};

/// Coefficients, constant first.
pub(super) type Series = [f64; DEGREE + 1];

/// The series that vanishes.
pub(super) const ZERO: Series = [0.0; DEGREE + 1];

/// The k-th coefficient of a product: several sums side by side, and last what was computed last.
#[inline]
pub(super) fn convolve(a: &Series, b: &Series, k: usize) -> f64 {
    if k == 0 {
        return a[0] * b[0];
    }
    let (forward, backward) = (a[1..k].chunks_exact(4), b[1..k].rchunks_exact(4));
    let ends = forward
        .remainder()
        .iter()
        .zip(backward.remainder().iter().rev());
    let rest: f64 = ends.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in forward.zip(backward) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[3 - lane];
        }
    }
    let inner = (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest;
    inner + (a[0] * b[k] + a[k] * b[0])
}

/// The sum of a series at `at`.
pub(super) fn value(series: &Series, at: f64) -> f64 {
    evaluate(series, at).0
}

/// A series with its coefficients made positive: a bound on it.
pub(super) fn majorant(series: &Series) -> Series {
    series.map(f64::abs)
}

/// A power of a series that is known coefficient by coefficient.
#[derive(Debug, Clone)]
pub(super) enum Power {
    /// A whole number m: the powers 2 to m.
    Whole(Vec<Series>),
    /// Any exponent of a series that does not begin with zero.
    Any { exponent: f64, series: Series },
    /// Of a series that begins with zero: left out.
    LeftOut,
}

/// Largest whole exponent that is built up by products.
const MOST_PRODUCTS: f64 = 12.0;

impl Power {
    /// The power of a series that begins with `first` >= 0.
    pub fn new(exponent: f64, first: f64) -> Self {
        let start = first.powf(exponent);
        if exponent.fract() == 0.0 && exponent <= MOST_PRODUCTS {
            let products = (exponent as usize).saturating_sub(1);
            Self::Whole(vec![ZERO; products])
        } else if start > f64::MIN_POSITIVE {
            let mut series = ZERO;
            series[0] = start;
            Self::Any { exponent, series }
        } else {
            Self::LeftOut
        }
    }

    /// The k-th coefficient, from those of `base` up to the k-th. To be asked for in order.
    pub fn coefficient(&mut self, base: &Series, k: usize) -> f64 {
        match self {
            Self::Whole(powers) => {
                for m in 0..powers.len() {
                    let (lower, upper) = powers.split_at_mut(m);
                    upper[0][k] = convolve(lower.last().unwrap_or(base), base, k);
                }
                powers.last().unwrap_or(base)[k]
            }
            Self::Any { series, .. } if k == 0 => series[0],
            // w = x^n obeys x w' = n x' w.
            Self::Any { exponent, series } => {
                let sum: f64 = (1..=k)
                    .map(|j| (*exponent * j as f64 - (k - j) as f64) * base[j] * series[k - j])
                    .sum();
                series[k] = sum / (k as f64 * base[0]);
                series[k]
            }
            Self::LeftOut => 0.0,
        }
    }
}

/// All coefficients of a power.
pub(super) fn power(base: &Series, exponent: f64) -> Series {
    if exponent == 0.0 {
        let mut one = ZERO;
        one[0] = 1.0;
        return one;
    }
    let mut power = Power::new(exponent, base[0]);
    std::array::from_fn(|k| power.coefficient(base, k))
}

/// The product of two series.
pub(super) fn product(a: &Series, b: &Series) -> Series {
    std::array::from_fn(|k| convolve(a, b, k))
}

/// Integral of the whole product of two series from 0 to `to`.
pub(super) fn integral_of_product(a: &Series, b: &Series, to: f64) -> f64 {
    let against = |i: usize| {
        let terms = b.iter().enumerate().rev();
        terms.fold(0.0, |sum, (j, b)| b / (i + j + 1) as f64 + to * sum)
    };
    let terms = a.iter().enumerate().rev();
    to * terms.fold(0.0, |sum, (i, a)| a * against(i) + to * sum)
}

/// The derivative of a series.
pub(super) fn derivative(series: &Series) -> Series {
    std::array::from_fn(|k| series.get(k + 1).map_or(0.0, |c| (k + 1) as f64 * c))
}
