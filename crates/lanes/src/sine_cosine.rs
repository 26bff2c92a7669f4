//! Sines and cosines of all lanes by their series, without the mathematical library.

use std::f64::consts::TAU;

use pulp::Simd;

use super::lanes::{Lanes, Pair};

/// Terms of the series: for angles of half a window, 0.6^16 / 16! < 2e-17, for an eighth of a turn, and for a moment,
/// 0.02^8 / 8! < 1e-18.
pub(super) const HALF_WINDOW: usize = 7;
const EIGHTH: usize = 8;
pub(super) const MOMENT: usize = 3;

/// cos and sin of `turns` full turns, of 0 to 1.
#[inline(always)]
pub(super) fn cos_sin<S: Simd, const N: usize>(turns: Lanes<S, N>) -> Pair<S, N> {
    let one = turns.like(1.0);
    let quarter = turns.mul_add(turns.like(4.0), turns.like(0.5)).floor();
    let rest = quarter.mul_add(turns.like(-0.25), turns);
    let angle = rest * turns.like(TAU);
    let square = angle * angle;
    let c = alternating_series::<S, N, EIGHTH>(square, 0);
    let s = angle * alternating_series::<S, N, EIGHTH>(square, 1);
    let second = one + one;
    let odd = (quarter - second).abs().equals(one);
    let (even_c, even_s) = (odd.choose(-s, c), odd.choose(c, s));
    // From the second quarter's beginning to the fourth's: both signs change.
    let turned = one.below(quarter) & quarter.below(second + second);
    (
        turned.choose(-even_c, even_c),
        turned.choose(-even_s, even_s),
    )
}

/// The cosine of a small angle, and the sine over the angle, from its square.
#[inline(always)]
pub(super) fn cos_sinc<S: Simd, const N: usize, const TERMS: usize>(
    square: Lanes<S, N>,
) -> Pair<S, N> {
    (
        alternating_series::<S, N, TERMS>(square, 0),
        alternating_series::<S, N, TERMS>(square, 1),
    )
}

/// 1 - q odd!/(odd + 2)! + q^2 odd!/(odd + 4)! - ..., q = angle^2: the cosine for `odd` = 0, the sine over the
/// angle for 1.
#[inline(always)]
fn alternating_series<S: Simd, const N: usize, const TERMS: usize>(
    square: Lanes<S, N>,
    odd: usize,
) -> Lanes<S, N> {
    let mut sum = square.like(ALTERNATING[odd][TERMS]);
    for n in (0..TERMS).rev() {
        sum = sum.mul_add(square, square.like(ALTERNATING[odd][n]));
    }
    sum
}

/// Coefficients of [`alternating_series`] for the cosine and for the sine.
const ALTERNATING: [[f64; EIGHTH + 1]; 2] = [reciprocal_factorials(0), reciprocal_factorials(1)];

const fn reciprocal_factorials(odd: usize) -> [f64; EIGHTH + 1] {
    let mut table = [1.0; EIGHTH + 1];
    let mut n = 1;
    while n <= EIGHTH {
        let k = 2 * n + odd;
        table[n] = -table[n - 1] / (k * (k - 1)) as f64;
        n += 1;
    }
    table
}
