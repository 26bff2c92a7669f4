//! The length of a Taylor step in contact: how far its series hold to rounding.

use pulp::Simd;

use super::contact_series::{ContactSeries, DEGREE};
use super::lanes::{Lanes, Mask};

/// How many last terms of a series are compared with its first: in symmetric cases all but every fifth or seventh vanish.
const LAST_TERMS_COMPARED: usize = 7;
/// Least ratio of the size that the last terms may have to the one that they have at a guessed step length, from which the step
/// length is computed at once; at longer guesses the next guess is shorter.
const MIN_RATIO_TO_LAST_TERM: f64 = 1.0 / (1u64 << 24) as f64;

/// Most guesses of a step length, each within a factor of two of the one before.
const MAX_GUESSES: usize = 64;

impl<S: Simd, const N: usize> ContactSeries<S, N> {
    /// Length in sigma, from a `guess` on, over which the series hold to rounding in the lanes `of`; and where one is found.
    #[inline(always)]
    pub fn step_length(&self, guess: Lanes<S, N>, of: Mask<S, N>) -> (Lanes<S, N>, Mask<S, N>) {
        let mut reach = guess;
        let mut open = of;
        for _ in 0..MAX_GUESSES {
            let (next, near) = self.step_length_judged_at(reach);
            reach = open.choose(next, reach);
            open = open.and_not(near);
            if !open.any() {
                break;
            }
        }
        (reach, of.and_not(open))
    }

    /// Step length by the sizes of the terms at the length `near`, and the lanes in which `near` is close enough for that.
    #[inline(always)]
    fn step_length_judged_at(&self, near: Lanes<S, N>) -> (Lanes<S, N>, Mask<S, N>) {
        let one = near.like(1.0);
        // Where the last term is half an ulp, the step is a fifth of the radius of convergence: ratio of two terms there.
        let later = one.like(0.2) / near;
        let mut last = near.like(0.0);
        for k in DEGREE + 1 - LAST_TERMS_COMPARED..=DEGREE {
            let term = self.root[k].abs() * one.like(k as f64);
            last = term.max(last * later);
        }
        // The first terms, up to the second power of the length, that the last ones are 21 orders above.
        let first = self.root[1].abs();
        let first = first.max((near + near) * self.root[2].abs());
        let first = first.max(near * near * self.root[3].abs() * one.like(3.0));
        let last = integer_power(near, DEGREE - 1) * last;
        let room = first * one.like(f64::EPSILON / 2.0) / last;
        let enough = one.like(MIN_RATIO_TO_LAST_TERM).below(room);
        let mut root = room
            .min(one.like(1.0 / MIN_RATIO_TO_LAST_TERM))
            .max(one.like(MIN_RATIO_TO_LAST_TERM));
        for _ in 0..5 {
            root = root.square_root();
        }
        // The factor room^(1 / (DEGREE - 1)) from the 32nd root, by two terms of the binomial series.
        let exponent = 32.0 / (DEGREE - 1) as f64;
        let off = root - one;
        let second = 0.5 * exponent * (exponent - 1.0);
        let factor = off.mul_add(off.mul_add(one.like(second), one.like(exponent)), one);
        (near * factor, enough)
    }
}

/// base^exponent by repeated squaring.
#[inline(always)]
fn integer_power<S: Simd, const N: usize>(base: Lanes<S, N>, exponent: usize) -> Lanes<S, N> {
    let (mut power, mut square, mut left) = (base.like(1.0), base, exponent);
    while left > 0 {
        if left % 2 == 1 {
            power = power * square;
        }
        square = square * square;
        left /= 2;
    }
    power
}
