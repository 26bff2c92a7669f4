//! The zero of a Taylor polynomial next to its centre, in all lanes at once.

use pulp::Simd;

use super::lane_laws::WINDOW_ANGLE;
use super::lanes::{Lanes, Mask};
use super::local_taylor::{LocalTaylor, curvature_at};
use super::polynomial::value_and_rate;

/// Longest time from a Taylor polynomial's centre to a zero that is used, times the fastest rate of the motion, in rad.
const MAX_ZERO_ANGLE: f64 = 0.02;

/// A zero of a Taylor polynomial in each lane: time from the centre, slope there, and whether Newton's method converged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zero<S: Simd, const N: usize> {
    pub time: Lanes<S, N>,
    pub slope: Lanes<S, N>,
    pub sure: Mask<S, N>,
}

/// Finds the zero of a Taylor polynomial near its centre in the lanes `of`: the series reverted to fourth order, then one step of
/// Newton's method, in hard cases two.
#[inline(always)]
pub(super) fn nearby_zero<S: Simd, const N: usize>(
    local: &LocalTaylor<S, N>,
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
    let reach = window * window.like(MAX_ZERO_ANGLE / WINDOW_ANGLE);
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

/// True where another step of Newton's method after `step` is lost in rounding; `a`: half the curvature over the slope.
#[inline(always)]
fn is_last_step<S: Simd, const N: usize>(
    step: Lanes<S, N>,
    a: Lanes<S, N>,
    window: Lanes<S, N>,
) -> Mask<S, N> {
    let next = (a * step * step).abs();
    step.abs().below(window * window.like(1e-7)) & next.below(window * window.like(4e-16))
}

/// A step of Newton's method for a zero of a Taylor polynomial from `at`: the new time, the slope there, and the step.
#[inline(always)]
fn newton_step<S: Simd, const N: usize>(
    local: &LocalTaylor<S, N>,
    at: Lanes<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>, Lanes<S, N>) {
    let (value, slope) = value_and_rate(local, at);
    let step = value / slope;
    (at - step, slope - curvature_at(local, at) * step, step)
}
