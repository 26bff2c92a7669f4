//! How far the series of a step hold, and where the lanes come to along them.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::power::{ContactPlace, DEGREE, Power, RECIPROCALS};

/// What the last term of the velocity may amount to, relative to its first.
const SMALLEST: f64 = f64::EPSILON / 2.0;
/// Share of the series' radius that a step covers when its last term is that small.
const SHARE: f64 = 0.2;
/// How many of the last terms are looked at: at the face all but every fifth may vanish, or every seventh.
const LAST: usize = 7;
/// The terms at the length where series are judged are within this factor, at most, of what they are to be.
const FARTHEST: f64 = 1.0 / (1u64 << 24) as f64;

/// How often a length is guessed, each within a factor of two of the one before.
const MOST_GUESSES: usize = 64;
/// How many 32nd roots are the root that the step goes by, and the next coefficient of its binomial series.
const ROOTS: f64 = 32.0 / (DEGREE - 1) as f64;
const BINOMIAL: f64 = 0.5 * ROOTS * (ROOTS - 1.0);

impl<S: Simd, const N: usize> Power<S, N> {
    /// How far the series hold in the lanes `of`, and where that is certain; from a first guess on.
    #[inline(always)]
    pub fn reach(&self, guess: Lanes<S, N>, of: Mask<S, N>) -> (Lanes<S, N>, Mask<S, N>) {
        let mut reach = guess;
        let mut open = of;
        for _ in 0..MOST_GUESSES {
            let (next, near) = self.reach_about(reach);
            reach = open.choose(next, reach);
            open = open.and_not(near);
            if !open.any() {
                break;
            }
        }
        (reach, of.and_not(open))
    }

    /// The reach judged at a length `near`, and where that is near enough.
    #[inline(always)]
    fn reach_about(&self, near: Lanes<S, N>) -> (Lanes<S, N>, Mask<S, N>) {
        let one = near.like(1.0);
        let later = one.like(SHARE) / near;
        let mut last = near.like(0.0);
        for k in DEGREE + 1 - LAST..=DEGREE {
            let term = self.root[k].abs() * one.like(k as f64);
            last = term.max(last * later);
        }
        // The first terms, up to the second power of the length, that the last ones are 21 orders above.
        let first = self.root[1].abs();
        let first = first.max((near + near) * self.root[2].abs());
        let first = first.max(near * near * self.root[3].abs() * one.like(3.0));
        let last = power(near, DEGREE - 1) * last;
        let room = first * one.like(SMALLEST) / last;
        let enough = one.like(FARTHEST).below(room);
        let mut root = room.min(one.like(1.0 / FARTHEST)).max(one.like(FARTHEST));
        for _ in 0..5 {
            root = root.square_root();
        }
        // The root that is asked for from the 32nd one, by two terms of the binomial series.
        let off = root - one;
        let factor = off.mul_add(off.mul_add(one.like(BINOMIAL), one.like(ROOTS)), one);
        (near * factor, enough)
    }

    /// True where the velocity stays above a level up to sigma.
    #[inline(always)]
    pub fn stays_faster(&self, level: Lanes<S, N>, sigma: Lanes<S, N>) -> Mask<S, N> {
        let mut change = sigma.like(0.0);
        for k in (2..=DEGREE).rev() {
            let term = self.root[k].abs() * sigma.like((2 * k) as f64);
            change = change.mul_add(sigma, term);
        }
        let velocity = self.root[1] + self.root[1];
        level.below(velocity - change * sigma)
    }

    /// Where the lanes come to after sigma.
    #[inline(always)]
    pub fn at(&self, from: &ContactPlace<S, N>, sigma: Lanes<S, N>) -> ContactPlace<S, N> {
        let zero = sigma.like(0.0);
        let (mut way, mut rise, mut time) = (zero, zero, zero);
        let (mut cos, mut sin) = (zero, zero);
        for k in (1..=DEGREE).rev() {
            let root = self.root[k];
            way = way.mul_add(sigma, root);
            time = time.mul_add(sigma, root * zero.like(RECIPROCALS[k + 1]));
            if k < DEGREE {
                rise = rise.mul_add(sigma, self.root[k + 1] * zero.like((2 * (k + 1)) as f64));
                cos = cos.mul_add(sigma, self.cos[k]);
                sin = sin.mul_add(sigma, self.sin[k]);
            }
        }
        ContactPlace {
            root: way.mul_add(sigma, from.root),
            velocity: rise.mul_add(sigma, from.velocity),
            angle: (
                cos.mul_add(sigma, from.angle.0),
                sin.mul_add(sigma, from.angle.1),
            ),
            time: time.mul_add(sigma, from.root).mul_add(sigma, from.time),
        }
    }
}

/// A power of a number.
#[inline(always)]
fn power<S: Simd, const N: usize>(base: Lanes<S, N>, exponent: usize) -> Lanes<S, N> {
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
