//! Taylor polynomials of a motion and of a guard about one instant.

use pulp::Simd;

use super::lanes::{Lanes, Pair};
use super::law::Law;
use super::parts::Parts;

/// Taylor coefficients of a function of time, its value first.
pub(super) type Taylor<S, const N: usize> = [Lanes<S, N>; TERMS];

/// Number of Taylor coefficients: up to a nearby zero, 0.02 rad, the first one left out adds less than 3e-16.
pub(super) const TERMS: usize = 7;

/// 1/n! for n from 0 to [`TERMS`].
const RECIPROCAL_FACTORIALS: [f64; TERMS + 1] = {
    let mut table = [1.0; TERMS + 1];
    let mut n = 2;
    while n <= TERMS {
        table[n] = table[n - 1] / n as f64;
        n += 1;
    }
    table
};

/// Derivatives of x - offset - edge, from order 0 to one more than a [`Taylor`] has.
#[inline(always)]
pub(super) fn motion_derivatives<S: Simd, const N: usize>(
    law: &Law<S, N>,
    frequency: Lanes<S, N>,
    parts: &Parts<S, N>,
) -> [Lanes<S, N>; TERMS + 1] {
    let turn = -(frequency * frequency);
    let Parts { y, u, p, q } = *parts;
    let second = law.differentiate_free((y, u));
    let third = law.differentiate_free(second);
    let fourth = law.differentiate_free(third);
    let fifth = law.differentiate_free(fourth);
    let sixth = law.differentiate_free(fifth);
    let seventh = law.differentiate_free(sixth);
    let square = turn * turn;
    let cube = turn * square;
    [
        y + (p - law.edge),
        u + q,
        turn.mul_add(p, second.1),
        turn.mul_add(q, third.1),
        square.mul_add(p, fourth.1),
        square.mul_add(q, fifth.1),
        cube.mul_add(p, sixth.1),
        cube.mul_add(q, seventh.1),
    ]
}

/// Taylor coefficients of the guard position x + velocity v - level.
#[inline(always)]
pub(super) fn guard_taylor<S: Simd, const N: usize, const HAS_OTHER_ENDS: bool>(
    derivatives: &[Lanes<S, N>; TERMS + 1],
    (position, velocity, level): (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>),
) -> Taylor<S, N> {
    let mut local = [level; TERMS];
    for (n, term) in local.iter_mut().enumerate() {
        let here = derivatives[n];
        let value = if HAS_OTHER_ENDS {
            velocity.mul_add(derivatives[n + 1], position * here)
        } else {
            here
        };
        *term = match n {
            0 if HAS_OTHER_ENDS => value - level,
            0 | 1 => value,
            _ => value * here.like(RECIPROCAL_FACTORIALS[n]),
        };
    }
    local
}

/// Taylor coefficients of the negative first derivative of a function.
#[inline(always)]
pub(super) fn negated_rate<S: Simd, const N: usize>(local: &Taylor<S, N>) -> Taylor<S, N> {
    let mut rate = [local[0].like(0.0); TERMS];
    for n in 1..TERMS {
        rate[n - 1] = local[n] * local[n].like(-(n as f64));
    }
    rate
}

/// Second derivative of a function a time `at` from the centre, to the digits that a short step needs.
#[inline(always)]
pub(super) fn curvature_at<S: Simd, const N: usize>(
    local: &Taylor<S, N>,
    at: Lanes<S, N>,
) -> Lanes<S, N> {
    let fifth = (at * local[5]).mul_add(at.like(20.0), local[4] * at.like(12.0));
    let third = at.mul_add(fifth, local[3] * at.like(6.0));
    at.mul_add(third, local[2] + local[2])
}

/// Value of a function a time `at` from the centre.
#[inline(always)]
pub(super) fn eval<S: Simd, const N: usize>(local: &Taylor<S, N>, at: Lanes<S, N>) -> Lanes<S, N> {
    let mut value = local[TERMS - 1];
    for term in local[..TERMS - 1].iter().rev() {
        value = value.mul_add(at, *term);
    }
    value
}

/// Position and velocity a time `moment` from the centre.
#[inline(always)]
pub(super) fn position_and_velocity_at<S: Simd, const N: usize>(
    derivatives: &[Lanes<S, N>; TERMS + 1],
    moment: Lanes<S, N>,
) -> Pair<S, N> {
    let (mut position, mut velocity) = (derivatives[TERMS], derivatives[TERMS]);
    for n in (0..TERMS).rev() {
        let step = moment * moment.like(1.0 / (n + 1) as f64);
        position = position.mul_add(step, derivatives[n]);
        if n > 0 {
            let step = moment * moment.like(1.0 / n as f64);
            velocity = velocity.mul_add(step, derivatives[n]);
        }
    }
    (position, velocity)
}
