//! Polynomials in all lanes at once.

use pulp::Simd;

use super::lanes::{Lanes, Pair};

/// Value and first derivative of a polynomial with these coefficients, the constant first, at `at`.
#[inline(always)]
pub(super) fn value_and_rate<S: Simd, const N: usize, const T: usize>(
    series: &[Lanes<S, N>; T],
    at: Lanes<S, N>,
) -> Pair<S, N> {
    let mut value = series[T - 1];
    let mut rate = at.like(0.0);
    for k in (0..T - 1).rev() {
        rate = rate.mul_add(at, value);
        value = value.mul_add(at, series[k]);
    }
    (value, rate)
}
