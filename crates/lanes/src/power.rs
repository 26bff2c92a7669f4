//! One Taylor step of a contact under a power law, n = 3/2, 2 or 5/2, along the square root s of the deflection D.
//!
//! The equation is that of the safe engine, in a time sigma with dt = s dsigma:
//!
//! ```text
//! 2 s'' = s (A cos(angle) + constant) - 2 a D' - s (b D + kappa D^n (1 + lambda v)),   v = 2 s'
//! s (b D + kappa D^n) = (b s + kappa D) D, (b D + kappa D^2) s, (b s + kappa D^2) D
//! ```

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::law::Law;

/// Degree of s, odd.
pub(super) const DEGREE: usize = 25;
/// 1/n.
pub(super) const RECIPROCALS: [f64; DEGREE + 2] = {
    let mut table = [0.0; DEGREE + 2];
    let mut n = 1;
    while n < table.len() {
        table[n] = 1.0 / n as f64;
        n += 1;
    }
    table
};

/// Coefficients, constant first.
pub(super) type Series<S, const N: usize> = [Lanes<S, N>; DEGREE + 1];

/// Where lanes stand along sigma.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPlace<S: Simd, const N: usize> {
    pub root: Lanes<S, N>,
    pub velocity: Lanes<S, N>,
    /// cos and sin of the drive angle.
    pub angle: (Lanes<S, N>, Lanes<S, N>),
    /// Time that it takes to come there, in s.
    pub time: Lanes<S, N>,
}

/// The series of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Power<S: Simd, const N: usize> {
    pub root: Series<S, N>,
    depth: Series<S, N>,
    /// D^2, and what of D and D^2 is a factor of s D^n.
    square: Series<S, N>,
    steep: Series<S, N>,
    /// The two factors of the springs' force times s.
    springs: Series<S, N>,
    other: Series<S, N>,
    pub cos: Series<S, N>,
    pub sin: Series<S, N>,
    velocity: Series<S, N>,
    /// s D^n.
    pressed: Series<S, N>,
}

/// Which exponents there are.
struct Exponents<S: Simd, const N: usize> {
    are_halves_of_three: bool,
    is_half_of_three: Mask<S, N>,
    is_two: Mask<S, N>,
    /// Some law dissipates.
    grips: bool,
}

impl<S: Simd, const N: usize> Exponents<S, N> {
    #[inline(always)]
    fn of(law: &Law<S, N>) -> Self {
        let zero = law.press.like(0.0);
        let is_half_of_three = law.exponent.equals(zero.like(1.5));
        Self {
            are_halves_of_three: !zero.below(law.press).and_not(is_half_of_three).any(),
            is_half_of_three,
            is_two: law.exponent.equals(zero.like(2.0)),
            grips: zero.below(law.grip).any(),
        }
    }
}

impl<S: Simd, const N: usize> ContactPlace<S, N> {
    #[inline(always)]
    pub fn choose(mask: Mask<S, N>, yes: &Self, no: &Self) -> Self {
        Self {
            root: mask.choose(yes.root, no.root),
            velocity: mask.choose(yes.velocity, no.velocity),
            angle: (
                mask.choose(yes.angle.0, no.angle.0),
                mask.choose(yes.angle.1, no.angle.1),
            ),
            time: mask.choose(yes.time, no.time),
        }
    }
}

impl<S: Simd, const N: usize> Power<S, N> {
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let none = [Lanes::splat(simd, 0.0); DEGREE + 1];
        Self {
            root: none,
            depth: none,
            square: none,
            steep: none,
            springs: none,
            other: none,
            cos: none,
            sin: none,
            velocity: none,
            pressed: none,
        }
    }

    /// The series about a place, two orders at a time: what is fetched serves both.
    #[inline(always)]
    pub fn expand(&mut self, law: &Law<S, N>, frequency: Lanes<S, N>, from: &ContactPlace<S, N>) {
        let zero = frequency.like(0.0);
        let exponents = Exponents::of(law);
        (self.root[0], self.depth[0]) = (from.root, from.root * from.root);
        self.root[1] = from.velocity * zero.like(0.5);
        (self.cos[0], self.sin[0]) = from.angle;
        for k in (0..DEGREE - 1).step_by(2) {
            self.pull(law, &exponents, k);
            let (mut last_root, mut last_other) = (self.root[k], self.other[k]);
            let mut even = [
                self.cos[0] * last_root,
                self.sin[0] * last_root,
                self.springs[0] * last_other,
            ];
            let mut odd = [zero; 3];
            for i in 1..=k {
                let (root, other) = (self.root[k - i], self.other[k - i]);
                let (cos, sin, springs) = (self.cos[i], self.sin[i], self.springs[i]);
                even[0] = cos.mul_add(root, even[0]);
                even[1] = sin.mul_add(root, even[1]);
                even[2] = springs.mul_add(other, even[2]);
                odd[0] = cos.mul_add(last_root, odd[0]);
                odd[1] = sin.mul_add(last_root, odd[1]);
                odd[2] = springs.mul_add(last_other, odd[2]);
                (last_root, last_other) = (root, other);
            }
            let squares = self.halves(k);
            let (first, next) = (self.root[0], self.root[k + 1]);
            let depth = first.mul_add(next, squares[0]);
            self.depth[k + 1] = depth + depth;
            self.follow(law, frequency, k, even, exponents.grips);
            self.pull(law, &exponents, k + 1);
            let (middle, next) = (self.root[k / 2 + 1], self.root[k + 2]);
            let depth = first.mul_add(next, squares[1]);
            self.depth[k + 2] = middle.mul_add(middle, depth + depth);
            odd[0] = self.both_ends(&self.cos, &self.root, k + 1, odd[0]);
            odd[1] = self.both_ends(&self.sin, &self.root, k + 1, odd[1]);
            odd[2] = self.both_ends(&self.springs, &self.other, k + 1, odd[2]);
            self.follow(law, frequency, k + 1, odd, exponents.grips);
        }
    }

    /// The factors of the springs' force, of order k.
    #[inline(always)]
    fn pull(&mut self, law: &Law<S, N>, exponents: &Exponents<S, N>, k: usize) {
        let (root, depth) = (self.root[k], self.depth[k]);
        let (mut steep, mut soft, mut other) = (depth, root, depth);
        if !exponents.are_halves_of_three {
            self.square[k] = product(&self.depth, &self.depth, k);
            steep = exponents.is_half_of_three.choose(depth, self.square[k]);
            soft = exponents.is_two.choose(depth, root);
            other = exponents.is_two.choose(root, depth);
        }
        self.springs[k] = law.press.mul_add(steep, -(law.stiffness * soft));
        (self.steep[k], self.other[k]) = (steep, other);
    }

    /// Half of D of the orders k + 1 and k + 2 (k even), without the first terms and that of the middle.
    #[inline(always)]
    fn halves(&self, k: usize) -> [Lanes<S, N>; 2] {
        let mut last = self.root[k + 1];
        let mut sums = [last.like(0.0); 2];
        for i in 1..=k / 2 {
            let (early, late) = (self.root[i], self.root[k + 1 - i]);
            sums[0] = early.mul_add(late, sums[0]);
            sums[1] = early.mul_add(last, sums[1]);
            last = late;
        }
        sums
    }

    /// A coefficient of a product from the sum of its inner terms.
    #[inline(always)]
    fn both_ends(
        &self,
        a: &Series<S, N>,
        b: &Series<S, N>,
        k: usize,
        inner: Lanes<S, N>,
    ) -> Lanes<S, N> {
        a[0].mul_add(b[k], a[k].mul_add(b[0], inner))
    }

    /// The next coefficients from the products of order k: s with cos and sin of the drive, and those of the springs.
    #[inline(always)]
    fn follow(
        &mut self,
        law: &Law<S, N>,
        frequency: Lanes<S, N>,
        k: usize,
        [by_cos, by_sin, mut press]: [Lanes<S, N>; 3],
        grips: bool,
    ) {
        let of = |value: f64| frequency.like(value);
        if grips {
            self.pressed[k] = product(&self.steep, &self.other, k);
            self.velocity[k] = self.root[k + 1] * of((2 * (k + 1)) as f64);
            let gripped = product(&self.velocity, &self.pressed, k);
            press = law.grip.mul_add(gripped, press);
        }
        let (rate, after) = (of(RECIPROCALS[k + 1]), of(0.5 * RECIPROCALS[k + 2]));
        let turn = frequency * rate;
        self.cos[k + 1] = -(turn * by_sin);
        self.sin[k + 1] = turn * by_cos;
        let push = law
            .push
            .mul_add(self.root[k], law.amplitude.mul_add(by_cos, -press));
        let driven = rate.mul_add(push, law.damping * self.depth[k + 1]);
        self.root[k + 2] = after * driven;
    }
}

/// The k-th coefficient of a product.
#[inline(always)]
fn product<S: Simd, const N: usize>(a: &Series<S, N>, b: &Series<S, N>, k: usize) -> Lanes<S, N> {
    let mut sum = a[0] * b[k];
    for i in 1..=k {
        sum = a[i].mul_add(b[k - i], sum);
    }
    sum
}
