//! The length of a Taylor step in contact: how far its series hold to rounding.

use pulp::Simd;

use super::contact_series::{ContactSeries, ContactState, DEGREE};
use super::lanes::{Lanes, Mask};
use super::law::Law;

/// Largest size of the last terms of the velocity at the end of a step, relative to its first terms.
const MAX_LAST_TERM: f64 = f64::EPSILON / 2.0;
/// Length of a step as a share of the series' radius of convergence, where its last term is of that size.
const SHARE_OF_RADIUS: f64 = 0.2;
/// How many of the last terms are compared: in symmetric cases all but every fifth vanish, or every seventh.
const LAST_TERMS_COMPARED: usize = 7;
/// Least ratio of [`MAX_LAST_TERM`] to the size of the last terms at a length from which the step is computed at once; at
/// longer ones the next guess is a shorter length.
const MIN_RATIO_TO_LAST_TERM: f64 = 1.0 / (1u64 << 24) as f64;

/// Most lengths at which the terms are compared, each within a factor of two of the one before.
const MAX_GUESSES: usize = 64;
/// Exponent e with which the factor of a step's length, ratio^(1 / (DEGREE - 1)), is (32nd root of the ratio)^e.
const ROOT_EXPONENT: f64 = 32.0 / (DEGREE - 1) as f64;

impl<S: Simd, const N: usize> ContactState<S, N> {
    /// The longest step, in sigma, along which the series of drive and suspension converge fast.
    #[inline(always)]
    pub fn longest_step(&self, law: &Law<S, N>) -> Lanes<S, N> {
        let four = law.window.like(4.0);
        let by_speed = (law.window * four / self.velocity.abs()).square_root();
        (law.window / self.root).min(by_speed)
    }
}

impl<S: Simd, const N: usize> ContactSeries<S, N> {
    /// Length of the step over which the series hold in the lanes `of`, from a guess on; the lanes in which that is
    /// certain.
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

    /// Length of the step by the sizes of the terms at the length `near`, and the lanes in which that is near enough.
    #[inline(always)]
    fn step_length_judged_at(&self, near: Lanes<S, N>) -> (Lanes<S, N>, Mask<S, N>) {
        let one = near.like(1.0);
        let later = one.like(SHARE_OF_RADIUS) / near;
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
        let room = first * one.like(MAX_LAST_TERM) / last;
        let enough = one.like(MIN_RATIO_TO_LAST_TERM).below(room);
        let mut root = room
            .min(one.like(1.0 / MIN_RATIO_TO_LAST_TERM))
            .max(one.like(MIN_RATIO_TO_LAST_TERM));
        for _ in 0..5 {
            root = root.square_root();
        }
        // The root that is asked for from the 32nd one, by two terms of the binomial series.
        let off = root - one;
        let second = 0.5 * ROOT_EXPONENT * (ROOT_EXPONENT - 1.0);
        let factor = off.mul_add(off.mul_add(one.like(second), one.like(ROOT_EXPONENT)), one);
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
