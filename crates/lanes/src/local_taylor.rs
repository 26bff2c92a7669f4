//! Taylor polynomials of a motion and of a guard about one instant, and the zero of one nearby.

use pulp::Simd;

use super::lanes::{Lanes, Mask, Pair};
use super::law::Law;
use super::parts::Parts;

/// Taylor coefficients of a function of time, its value first.
pub(super) type Taylor<S, const N: usize> = [Lanes<S, N>; TERMS];

/// Number of Taylor coefficients: over [`MAX_ZERO_ANGLE`], the first one left out adds less than 3e-16.
const TERMS: usize = 7;
/// Longest time from the centre to a zero that is used, times the fastest rate, in rad.
const MAX_ZERO_ANGLE: f64 = 0.02;
/// Longest step of Newton's method that may be the last, in windows.
const MAX_LAST_STEP: f64 = 1e-7;
/// Longest step of Newton's method that is lost in rounding and so need not be made, in windows.
const MAX_OMITTED_STEP: f64 = 4e-16;

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
pub(super) fn guard_taylor<S: Simd, const N: usize, const GUARDED: bool>(
    derivatives: &[Lanes<S, N>; TERMS + 1],
    (position, velocity, level): (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>),
) -> Taylor<S, N> {
    let mut local = [level; TERMS];
    for (n, term) in local.iter_mut().enumerate() {
        let here = derivatives[n];
        let value = if GUARDED {
            velocity.mul_add(derivatives[n + 1], position * here)
        } else {
            here
        };
        *term = match n {
            0 if GUARDED => value - level,
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

/// A zero of a Taylor polynomial: at which time, the slope there, and where it is certain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zero<S: Simd, const N: usize> {
    pub time: Lanes<S, N>,
    pub slope: Lanes<S, N>,
    pub sure: Mask<S, N>,
}

/// The zero of a Taylor polynomial next to its centre, in the lanes `of`: the series reverted to fourth order, then
/// one step of Newton's method, in hard cases two.
#[inline(always)]
pub(super) fn nearby_zero<S: Simd, const N: usize>(
    local: &Taylor<S, N>,
    window: Lanes<S, N>,
    of: Mask<S, N>,
) -> Zero<S, N> {
    let inverse = window.like(1.0) / local[1];
    let first = -(local[0] * inverse);
    let (a, b, c) = (local[2] * inverse, local[3] * inverse, local[4] * inverse);
    let square = a * a;
    let fourth = (a * a.like(5.0)).mul_add(b - square, -c);
    let third = square + (square - b);
    let tail = first.mul_add(first.mul_add(fourth, third), -a);
    let start = (first * first).mul_add(tail, first);
    let (time, slope, step) = newton_step(local, start);
    let reach = window * window.like(MAX_ZERO_ANGLE / super::law::WINDOW_ANGLE);
    let near = time.abs().below(reach);
    let sure = near & is_last_step(step, a, window);
    let open = of & near.and_not(sure);
    if open.any() {
        let (again, slope_again, step) = newton_step(local, time);
        return Zero {
            time: open.choose(again, time),
            slope: open.choose(slope_again, slope),
            sure: sure | (open & is_last_step(step, a, window)),
        };
    }
    Zero { time, slope, sure }
}

/// True where the next step of Newton's method would be lost in rounding, `a` being half the curvature over the slope.
#[inline(always)]
fn is_last_step<S: Simd, const N: usize>(
    step: Lanes<S, N>,
    a: Lanes<S, N>,
    window: Lanes<S, N>,
) -> Mask<S, N> {
    let next = (a * step * step).abs();
    step.abs().below(window * window.like(MAX_LAST_STEP))
        & next.below(window * window.like(MAX_OMITTED_STEP))
}

/// One step of Newton's method: where it leads, the slope there, and the step.
#[inline(always)]
fn newton_step<S: Simd, const N: usize>(
    local: &Taylor<S, N>,
    at: Lanes<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>) {
    let mut value = local[TERMS - 1];
    let mut slope = value.like(0.0);
    for term in local[..TERMS - 1].iter().rev() {
        slope = slope.mul_add(at, value);
        value = value.mul_add(at, *term);
    }
    let step = value / slope;
    (at - step, slope - curvature_at(local, at) * step, step)
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
