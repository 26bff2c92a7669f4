//! Sines and cosines of all lanes by their series, without the mathematical library.

use std::f64::consts::TAU;

use pulp::Simd;

use super::lanes::{Lanes, Pair};

/// Degree in angle^2 of the series of sine and cosine to 0.6 rad, half a window: the next term is 0.6^16 / 16! < 2e-17.
pub(super) const HALF_WINDOW_DEGREE: usize = 7;
/// Degree in angle^2 of the series of sine and cosine to 0.79 rad, an eighth of a turn: the next term is below 3e-18.
const EIGHTH_TURN_DEGREE: usize = 8;
/// Degree in angle^2 of the sine and cosine series over the small drive angle to a nearby zero, at most 0.02 rad: the first term
/// left out is 0.02^8 / 8! < 1e-18.
pub(super) const SMALL_ANGLE_DEGREE: usize = 3;

/// Cosine and sine of an angle of `turns` full turns, 0 <= turns <= 1.
#[inline(always)]
pub(super) fn cos_sin<S: Simd, const N: usize>(turns: Lanes<S, N>) -> Pair<S, N> {
    let one = turns.like(1.0);
    let quarter = turns.mul_add(turns.like(4.0), turns.like(0.5)).floor();
    let rest = quarter.mul_add(turns.like(-0.25), turns);
    let angle = rest * turns.like(TAU);
    let square = angle * angle;
    let c = alternating_series::<S, N, EIGHTH_TURN_DEGREE>(square, 0);
    let s = angle * alternating_series::<S, N, EIGHTH_TURN_DEGREE>(square, 1);
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

/// The cosine of a small angle, and its sine divided by it, from the square of the angle.
#[inline(always)]
pub(super) fn cos_sinc<S: Simd, const N: usize, const DEGREE: usize>(
    square: Lanes<S, N>,
) -> Pair<S, N> {
    (
        alternating_series::<S, N, DEGREE>(square, 0),
        alternating_series::<S, N, DEGREE>(square, 1),
    )
}

/// 1 - q odd!/(odd + 2)! + q^2 odd!/(odd + 4)! - ... with q = angle^2: the cosine for `odd` = 0, the sine over the angle for 1.
#[inline(always)]
fn alternating_series<S: Simd, const N: usize, const DEGREE: usize>(
    square: Lanes<S, N>,
    odd: usize,
) -> Lanes<S, N> {
    let mut sum = square.like(ALTERNATING_COEFFICIENTS[odd][DEGREE]);
    for n in (0..DEGREE).rev() {
        sum = sum.mul_add(square, square.like(ALTERNATING_COEFFICIENTS[odd][n]));
    }
    sum
}

/// Coefficients (-1)^n / (2 n)! and (-1)^n / (2 n + 1)! of [`alternating_series`], for the cosine and for the sine.
const ALTERNATING_COEFFICIENTS: [[f64; EIGHTH_TURN_DEGREE + 1]; 2] =
    [reciprocal_factorials(0), reciprocal_factorials(1)];

const fn reciprocal_factorials(odd: usize) -> [f64; EIGHTH_TURN_DEGREE + 1] {
    let mut table = [1.0; EIGHTH_TURN_DEGREE + 1];
    let mut n = 1;
    while n <= EIGHTH_TURN_DEGREE {
        let k = 2 * n + odd;
        table[n] = -table[n - 1] / (k * (k - 1)) as f64;
        n += 1;
    }
    table
}
