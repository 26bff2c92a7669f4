//! Taylor polynomials of a motion and of a guard about one instant.

use pulp::Simd;

use super::free_and_steady_parts::Parts;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Pair};

/// Coefficients of a Taylor polynomial in time about one instant, in every lane, the value first.
pub(super) type LocalTaylor<S, const N: usize> = [Lanes<S, N>; TERMS];

/// Number of coefficients of a [`LocalTaylor`]: up to a zero 0.02 rad away the first one left out adds less than 3e-16.
pub(super) const TERMS: usize = 7;

/// Factors 1/n! of Taylor coefficients, for n from 0 to [`TERMS`].
const RECIPROCAL_FACTORIALS: [f64; TERMS + 1] = {
    let mut table = [1.0; TERMS + 1];
    let mut n = 2;
    while n <= TERMS {
        table[n] = table[n - 1] / n as f64;
        n += 1;
    }
    table
};

/// Derivatives of the signed distance from the guard's edge at one instant, from order 0 to [`TERMS`].
#[inline(always)]
pub(super) fn motion_derivatives<S: Simd, const N: usize>(
    law: &Laws<S, N>,
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

/// Taylor polynomial of the guard position x + velocity v - level about an instant, from the derivatives of the motion there.
#[inline(always)]
pub(super) fn guard_taylor<S: Simd, const N: usize, const HAS_OTHER_ENDS: bool>(
    derivatives: &[Lanes<S, N>; TERMS + 1],
    (position, velocity, level): (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>),
) -> LocalTaylor<S, N> {
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

/// Taylor polynomial of minus the first derivative of a function: it rises through zero where the function has a maximum.
#[inline(always)]
pub(super) fn negated_rate<S: Simd, const N: usize>(
    local: &LocalTaylor<S, N>,
) -> LocalTaylor<S, N> {
    let mut rate = [local[0].like(0.0); TERMS];
    for n in 1..TERMS {
        rate[n - 1] = local[n] * local[n].like(-(n as f64));
    }
    rate
}

/// Second derivative of a Taylor polynomial a time `at` from its centre, to the digits that Newton's method needs.
#[inline(always)]
pub(super) fn curvature_at<S: Simd, const N: usize>(
    local: &LocalTaylor<S, N>,
    at: Lanes<S, N>,
) -> Lanes<S, N> {
    let fifth = (at * local[5]).mul_add(at.like(20.0), local[4] * at.like(12.0));
    let third = at.mul_add(fifth, local[3] * at.like(6.0));
    at.mul_add(third, local[2] + local[2])
}

/// Position and velocity a time `moment` after the instant at which the derivatives of the motion are given.
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
