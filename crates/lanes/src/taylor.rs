//! The motion of all lanes about one instant each.

use std::f64::consts::TAU;

use pulp::Simd;

use super::lanes::Lanes;
use super::law::Law;
use super::parts::Parts;

/// Degree of the polynomials: over one window, (rate t)^16 / 16! < 2e-17.
const DEGREE: usize = 15;
/// Coefficients of x(t), constant first.
pub(super) type Series<S, const N: usize> = [Lanes<S, N>; DEGREE + 1];

const INVERSE_FACTORIALS: [f64; DEGREE + 1] = {
    let mut table = [1.0; DEGREE + 1];
    let mut n = 2;
    while n <= DEGREE {
        table[n] = table[n - 1] / n as f64;
        n += 1;
    }
    table
};

/// cos and sin of `turns` full turns, of 0 to 1.
#[inline(always)]
pub(super) fn cos_sin<S: Simd, const N: usize>(turns: Lanes<S, N>) -> (Lanes<S, N>, Lanes<S, N>) {
    let one = turns.like(1.0);
    let quarter = turns.mul_add(turns.like(4.0), turns.like(0.5)).floor();
    let rest = quarter.mul_add(turns.like(-0.25), turns);
    let angle = rest * turns.like(TAU);
    let square = -(angle * angle);
    let (c, s) = (
        alternating::<S, N, 0>(square),
        angle * alternating::<S, N, 1>(square),
    );
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

/// 1 + q / ((k+1)(k+2)) (1 + q / ((k+3)(k+4)) (...)) from k = `ODD` on: the cosine for q = -a^2, or the sine
/// over a.
#[inline(always)]
fn alternating<S: Simd, const N: usize, const ODD: usize>(square: Lanes<S, N>) -> Lanes<S, N> {
    let one = square.like(1.0);
    let mut sum = one;
    for n in (0..8).rev() {
        let k = (2 * n + ODD) as f64;
        sum = (square * square.like(1.0 / ((k + 1.0) * (k + 2.0)))).mul_add(sum, one);
    }
    sum
}

/// Series of the sum of a free motion and a steady one.
#[inline(always)]
pub(super) fn expand<S: Simd, const N: usize>(
    law: &Law<S, N>,
    frequency: Lanes<S, N>,
    parts: &Parts<S, N>,
) -> Series<S, N> {
    let turn = -(frequency * frequency);
    let mut series = [parts.y + parts.p; DEGREE + 1];
    series[1] = parts.u + parts.q;
    let (mut free, mut rate) = (parts.y, parts.u);
    let mut steady = [parts.p, parts.q];
    for n in 2..=DEGREE {
        let next = law.stiffness.mul_add(free, law.damping * rate);
        (free, rate) = (rate, next);
        steady[n % 2] = steady[n % 2] * turn;
        series[n] = (rate + steady[n % 2]) * turn.like(INVERSE_FACTORIALS[n]);
    }
    series
}

/// Value and slope of a series.
#[inline(always)]
pub(super) fn evaluate<S: Simd, const N: usize>(
    series: &Series<S, N>,
    t: Lanes<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>) {
    let mut value = series[DEGREE];
    let mut slope = value.like(0.0);
    for coefficient in series[..DEGREE].iter().rev() {
        slope = slope.mul_add(t, value);
        value = value.mul_add(t, *coefficient);
    }
    (value, slope)
}

/// Value, slope and half the curvature.
#[inline(always)]
pub(super) fn evaluate_twice<S: Simd, const N: usize>(
    series: &Series<S, N>,
    t: Lanes<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>) {
    let mut value = series[DEGREE];
    let mut slope = value.like(0.0);
    let mut bend = slope;
    for coefficient in series[..DEGREE].iter().rev() {
        bend = bend.mul_add(t, slope);
        slope = slope.mul_add(t, value);
        value = value.mul_add(t, *coefficient);
    }
    (value, slope, bend)
}

/// The series of the velocity.
#[inline(always)]
pub(super) fn derivative<S: Simd, const N: usize>(series: &Series<S, N>) -> Series<S, N> {
    let mut rates = [series[0].like(0.0); DEGREE + 1];
    for n in 1..=DEGREE {
        rates[n - 1] = series[n] * series[n].like(n as f64);
    }
    rates
}

/// The series divided by t, where it begins with zero.
#[inline(always)]
pub(super) fn shifted<S: Simd, const N: usize>(series: &Series<S, N>) -> Series<S, N> {
    let mut next = [series[0].like(0.0); DEGREE + 1];
    next[..DEGREE].copy_from_slice(&series[1..]);
    next
}
