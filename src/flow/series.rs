//! Truncated power series.

use super::taylor_polynomials::{DEGREE, RECIPROCALS};

/// A truncated power series in the variable sigma of a Taylor step: its coefficients, constant first.
pub(super) type Series = [f64; DEGREE + 1];

/// The series that vanishes.
pub(super) const ZERO: Series = [0.0; DEGREE + 1];

/// A series from its last coefficient to its first, so that a product with another runs along both in memory.
#[derive(Debug, Clone)]
pub(super) struct ReversedSeries(Series);

impl ReversedSeries {
    /// The series that vanishes.
    pub const ZERO: Self = Self(ZERO);

    /// The reversed form of a series.
    pub fn from_series(series: &Series) -> Self {
        let mut turned = *series;
        turned.reverse();
        Self(turned)
    }

    /// Sets the k-th coefficient of the series.
    #[inline(always)]
    pub fn set_coefficient(&mut self, k: usize, coefficient: f64) {
        self.0[DEGREE - k] = coefficient;
    }

    /// The k-th coefficient of the product with another series; the product of the newest coefficients is added last.
    #[inline(always)]
    pub fn times(&self, other: &Series, k: usize) -> f64 {
        let (a, b) = (&other[..=k], &self.0[DEGREE - k..]);
        if k == 0 {
            return a[0] * b[0];
        }
        dot_product(&a[1..k], &b[1..k]) + (a[0] * b[0] + a[k] * b[k])
    }
}

/// The dot product of two slices of one length, as four partial sums.
#[inline(always)]
fn dot_product(a: &[f64], b: &[f64]) -> f64 {
    let (rows_a, rows_b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest = rows_a.remainder().iter().zip(rows_b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in rows_a.zip(rows_b) {
        for lane in 0..4 {
            sums[lane] += a[lane] * b[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// The k-th coefficient of the product of two series.
pub(super) fn convolve(a: &Series, b: &Series, k: usize) -> f64 {
    let pairs = a[..=k].iter().zip(b[..=k].iter().rev());
    pairs.map(|(a, b)| a * b).sum()
}

pub(super) use super::taylor_polynomials::value;

/// The series with the sizes of all coefficients: a bound on a series.
pub(super) fn majorant(series: &Series) -> Series {
    series.map(f64::abs)
}

/// A bound on what a series is, within `span`, without its first two terms.
pub(super) fn curved_part(series: &Series, span: f64) -> f64 {
    let square = span * span;
    let (pairs, _) = series.as_chunks::<2>();
    let mut sums = [0.0; 2];
    for pair in pairs[1..].iter().rev() {
        for lane in 0..2 {
            sums[lane] = (sums[lane] + pair[lane].abs()) * square;
        }
    }
    sums[0] + span * sums[1]
}

/// The recurrence by which a power of a series follows coefficient by coefficient.
#[derive(Debug, Clone)]
pub(super) enum PowerRecurrence {
    /// The zeroth.
    One,
    /// A whole number m > 0: the powers 2 to m.
    Whole(Vec<Series>),
    /// Any exponent of a series that does not begin with zero.
    Any { exponent: f64, series: Series },
    /// A power of a series that begins with zero, which is left out.
    LeftOut,
}

impl PowerRecurrence {
    /// The recurrence of the power of a series that begins with `first` >= 0; whole exponents up to 12 are by products.
    pub fn new(exponent: f64, first: f64) -> Self {
        let start = first.powf(exponent);
        if exponent == 0.0 {
            Self::One
        } else if exponent.fract() == 0.0 && exponent <= 12.0 {
            Self::Whole(vec![ZERO; exponent as usize - 1])
        } else if start > f64::MIN_POSITIVE {
            let mut series = ZERO;
            series[0] = start;
            Self::Any { exponent, series }
        } else {
            Self::LeftOut
        }
    }

    /// The k-th coefficient of the power, from those up to the k-th of `base`, given reversed in `turned` as well. It
    /// is to be called for k = 0, 1, ... in order.
    #[inline]
    pub fn coefficient(&mut self, base: &Series, turned: &ReversedSeries, k: usize) -> f64 {
        match self {
            Self::One if k == 0 => 1.0,
            Self::Whole(powers) => {
                for m in 0..powers.len() {
                    let (lower, upper) = powers.split_at_mut(m);
                    upper[0][k] = turned.times(lower.last().unwrap_or(base), k);
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
            Self::One | Self::LeftOut => 0.0,
        }
    }
}

/// All coefficients of a power of a series.
pub(super) fn power_series(base: &Series, exponent: f64) -> Series {
    let mut power = PowerRecurrence::new(exponent, base[0]);
    let turned = ReversedSeries::from_series(base);
    std::array::from_fn(|k| power.coefficient(base, &turned, k))
}

/// The product of two series.
pub(super) fn product(a: &Series, b: &Series) -> Series {
    let turned = ReversedSeries::from_series(a);
    std::array::from_fn(|k| turned.times(b, k))
}

/// Integral of a series from 0 to `to`.
pub(super) fn integral(series: &Series, to: f64) -> f64 {
    let terms = series.iter().zip(&RECIPROCALS[1..]).rev();
    terms.fold(0.0, |sum, (c, share)| to * (c * share + sum))
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
pub(crate) fn derivative(series: &Series) -> Series {
    std::array::from_fn(|k| series.get(k + 1).map_or(0.0, |c| (k + 1) as f64 * c))
}
