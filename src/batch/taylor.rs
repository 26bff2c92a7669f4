//! The motion of all lanes about one instant each.

use pulp::Simd;

use super::lanes::Lanes;
use super::law::Law;

/// Degree of the polynomials: over one window, (rate t)^14 / 14! < 1e-14.
const DEGREE: usize = 13;
/// Coefficients of x(t), constant first.
pub(super) type Series<S> = [Lanes<S>; DEGREE + 1];

const INVERSE_FACTORIALS: [f64; DEGREE + 1] = {
    let mut table = [1.0; DEGREE + 1];
    let mut n = 2;
    while n <= DEGREE {
        table[n] = table[n - 1] / n as f64;
        n += 1;
    }
    table
};

/// The drive A cos(angle) per mass at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drive<S: Simd> {
    /// A.
    pub amplitude: Lanes<S>,
    /// w.
    pub frequency: Lanes<S>,
    /// cos and sin of the angle.
    pub cos: Lanes<S>,
    pub sin: Lanes<S>,
}

impl<S: Simd> Drive<S> {
    /// cos and sin of the angle a time on, with w t at most about one.
    #[inline(always)]
    pub fn turned(&self, t: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
        let angle = self.frequency * t;
        let square = -(angle * angle);
        let (c, s) = (
            alternating::<S, 0>(square),
            angle * alternating::<S, 1>(square),
        );
        (self.cos * c - self.sin * s, self.sin * c + self.cos * s)
    }
}

/// 1 + q / ((k+1)(k+2)) (1 + q / ((k+3)(k+4)) (...)) from k = `ODD` on: the cosine for q = -a^2, or the sine
/// over a.
#[inline(always)]
fn alternating<S: Simd, const ODD: usize>(square: Lanes<S>) -> Lanes<S> {
    let one = square.like(1.0);
    let mut sum = one;
    for n in (0..8).rev() {
        let k = (2 * n + ODD) as f64;
        sum = (square * square.like(1.0 / ((k + 1.0) * (k + 2.0)))).mul_add(sum, one);
    }
    sum
}

/// x(t) about the instant at which it is `x`, its velocity `v`, and the drive stands at `drive`.
#[inline(always)]
pub(super) fn expand<S: Simd>(
    law: &Law<S>,
    drive: &Drive<S>,
    x: Lanes<S>,
    v: Lanes<S>,
) -> Series<S> {
    let turn = -(drive.frequency * drive.frequency);
    let mut even = drive.amplitude * drive.cos;
    let mut odd = -(drive.amplitude * drive.frequency * drive.sin);
    let mut derivatives = [x; DEGREE + 1];
    derivatives[1] = v;
    for n in 0..DEGREE - 1 {
        let push = match n {
            0 => even + law.force,
            _ if n % 2 == 0 => even,
            _ => odd,
        };
        let damped = law.damping.mul_add(derivatives[n + 1], push);
        derivatives[n + 2] = law.stiffness.mul_add(derivatives[n], damped);
        if n % 2 == 0 {
            even = even * turn;
        } else {
            odd = odd * turn;
        }
    }
    for (derivative, factor) in derivatives.iter_mut().zip(INVERSE_FACTORIALS).skip(2) {
        *derivative = *derivative * x.like(factor);
    }
    derivatives
}

/// Value and slope of a series.
#[inline(always)]
pub(super) fn evaluate<S: Simd>(series: &Series<S>, t: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
    let mut value = series[DEGREE];
    let mut slope = value.like(0.0);
    for coefficient in series[..DEGREE].iter().rev() {
        slope = slope.mul_add(t, value);
        value = value.mul_add(t, *coefficient);
    }
    (value, slope)
}

/// The series of the velocity.
#[inline(always)]
pub(super) fn derivative<S: Simd>(series: &Series<S>) -> Series<S> {
    let mut rates = [series[0].like(0.0); DEGREE + 1];
    for n in 1..=DEGREE {
        rates[n - 1] = series[n] * series[n].like(n as f64);
    }
    rates
}

/// The series divided by t, where it begins with zero.
#[inline(always)]
pub(super) fn shifted<S: Simd>(series: &Series<S>) -> Series<S> {
    let mut next = [series[0].like(0.0); DEGREE + 1];
    next[..DEGREE].copy_from_slice(&series[1..]);
    next
}
