//! One Taylor step of a contact under a power law D^n, n = 3/2, 2 or 5/2: power series of the square root s of the
//! deflection D in a regularised time sigma.
//!
//! With dt = s dsigma; A is the amplitude of the drive per mass, 2 a the damping, b the stiffness, kappa and lambda
//! stiffness and dissipation of the power law, all per mass:
//!
//! ```text
//! 2 s'' = s (A cos(angle) + constant) - 2 a D' - s (b D + kappa D^n (1 + lambda v)),   v = 2 s'
//! s (b D + kappa D^n) = (b s + kappa D) D, (b D + kappa D^2) s, (b s + kappa D^2) D
//! ```

use pulp::Simd;

use super::contact_state::ContactState;
use super::lane_laws::Laws;
use super::lanes::{Lanes, Mask, Pair};
use super::polynomial::value_and_rate;
use softstop::internals::RECIPROCALS;

/// Degree of the power series of a contact in the regularised time sigma; odd.
pub(super) const DEGREE: usize = 25;

/// Most steps of Newton's method for a zero of a contact's series; then the safe engine takes the lane.
const MAX_NEWTON_STEPS: usize = 10;
/// Coefficients of a power series in sigma in every lane, the constant first.
pub(super) type Terms<S, const N: usize> = [Lanes<S, N>; DEGREE + 1];

/// Power series of one Taylor step of a contact: of its state, and of the products in its equation of motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactSeries<S: Simd, const N: usize> {
    /// Square root s of the deflection, and the deflection D = s^2.
    pub root: Terms<S, N>,
    depth: Terms<S, N>,
    /// D^2, and the power of D that s D^n = s^j D^m has as one factor: D or D^2.
    square: Terms<S, N>,
    steep: Terms<S, N>,
    /// The two factors of the force of suspension and power law, times s: (b s + kappa D) D and so on.
    springs: Terms<S, N>,
    other: Terms<S, N>,
    pub cos: Terms<S, N>,
    pub sin: Terms<S, N>,
    velocity: Terms<S, N>,
    /// s D^n.
    pressed: Terms<S, N>,
}

/// Which exponents n the power laws of the lanes have, so that terms that no lane needs are left out.
struct ContactExponents<S: Simd, const N: usize> {
    /// All are 3/2.
    are_halves_of_three: bool,
    is_half_of_three: Mask<S, N>,
    is_two: Mask<S, N>,
    /// Some law dissipates.
    grips: bool,
}

impl<S: Simd, const N: usize> ContactExponents<S, N> {
    #[inline(always)]
    fn of_laws(law: &Laws<S, N>) -> Self {
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

impl<S: Simd, const N: usize> ContactSeries<S, N> {
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

    /// Computes all series about the state `from` by their recurrence, two orders at a time: one fetch from memory serves both.
    #[inline(always)]
    pub fn expand(&mut self, law: &Laws<S, N>, frequency: Lanes<S, N>, from: &ContactState<S, N>) {
        let zero = frequency.like(0.0);
        let exponents = ContactExponents::of_laws(law);
        (self.root[0], self.depth[0]) = (from.root, from.root * from.root);
        self.root[1] = from.velocity * zero.like(0.5);
        (self.cos[0], self.sin[0]) = from.angle;
        for k in (0..DEGREE - 1).step_by(2) {
            self.set_spring_factors(law, &exponents, k);
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
            let squares = self.half_square_sums(k);
            let (first, next) = (self.root[0], self.root[k + 1]);
            let depth = first.mul_add(next, squares[0]);
            self.depth[k + 1] = depth + depth;
            self.set_next_coefficients(law, frequency, k, even, exponents.grips);
            self.set_spring_factors(law, &exponents, k + 1);
            let (middle, next) = (self.root[k / 2 + 1], self.root[k + 2]);
            let depth = first.mul_add(next, squares[1]);
            self.depth[k + 2] = middle.mul_add(middle, depth + depth);
            odd[0] = self.add_ends(&self.cos, &self.root, k + 1, odd[0]);
            odd[1] = self.add_ends(&self.sin, &self.root, k + 1, odd[1]);
            odd[2] = self.add_ends(&self.springs, &self.other, k + 1, odd[2]);
            self.set_next_coefficients(law, frequency, k + 1, odd, exponents.grips);
        }
    }

    /// Sets the coefficients `k` of the two series whose product is s times the force of suspension and power law.
    #[inline(always)]
    fn set_spring_factors(
        &mut self,
        law: &Laws<S, N>,
        exponents: &ContactExponents<S, N>,
        k: usize,
    ) {
        let (root, depth) = (self.root[k], self.depth[k]);
        let (mut steep, mut soft, mut other) = (depth, root, depth);
        if !exponents.are_halves_of_three {
            self.square[k] = convolve(&self.depth, &self.depth, k);
            steep = exponents.is_half_of_three.choose(depth, self.square[k]);
            soft = exponents.is_two.choose(depth, root);
            other = exponents.is_two.choose(root, depth);
        }
        self.springs[k] = law.press.mul_add(steep, -(law.stiffness * soft));
        (self.steep[k], self.other[k]) = (steep, other);
    }

    /// Sums of s_i s_j over i < j, i >= 1 with i + j = k + 1 and with i + j = k + 2, k even: half of the coefficients of D = s^2
    /// of these orders, without the terms with s_0 and the middle square.
    #[inline(always)]
    fn half_square_sums(&self, k: usize) -> [Lanes<S, N>; 2] {
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

    /// Coefficient k of the product of two series, from the sum `inner` of its inner terms: adds a_0 b_k + a_k b_0.
    #[inline(always)]
    fn add_ends(
        &self,
        a: &Terms<S, N>,
        b: &Terms<S, N>,
        k: usize,
        inner: Lanes<S, N>,
    ) -> Lanes<S, N> {
        a[0].mul_add(b[k], a[k].mul_add(b[0], inner))
    }

    /// Sets coefficient k + 2 of s and coefficients k + 1 of cos and sin from the products of order k: s cos, s sin and s times
    /// the force of the springs; `grips`: some law dissipates.
    #[inline(always)]
    fn set_next_coefficients(
        &mut self,
        law: &Laws<S, N>,
        frequency: Lanes<S, N>,
        k: usize,
        [by_cos, by_sin, mut press]: [Lanes<S, N>; 3],
        grips: bool,
    ) {
        let of = |value: f64| frequency.like(value);
        if grips {
            self.pressed[k] = convolve(&self.steep, &self.other, k);
            self.velocity[k] = self.root[k + 1] * of((2 * (k + 1)) as f64);
            let gripped = convolve(&self.velocity, &self.pressed, k);
            press = law.grip.mul_add(gripped, press);
        }
        let (rate, after) = (of(RECIPROCALS[k + 1]), of(0.5 * RECIPROCALS[k + 2]));
        let turn = frequency * rate;
        self.cos[k + 1] = -(turn * by_sin);
        self.sin[k + 1] = turn * by_cos;
        let forcing = law
            .forcing
            .mul_add(self.root[k], law.amplitude.mul_add(by_cos, -press));
        let driven = rate.mul_add(forcing, law.damping * self.depth[k + 1]);
        self.root[k + 2] = after * driven;
    }

    /// State of the contact a step `sigma` after the state `from` about which the series are.
    #[inline(always)]
    pub fn state_at(&self, from: &ContactState<S, N>, sigma: Lanes<S, N>) -> ContactState<S, N> {
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
        ContactState {
            root: way.mul_add(sigma, from.root),
            velocity: rise.mul_add(sigma, from.velocity),
            angle: (
                cos.mul_add(sigma, from.angle.0),
                sin.mul_add(sigma, from.angle.1),
            ),
            time: time.mul_add(sigma, from.root).mul_add(sigma, from.time),
        }
    }

    /// The sigma at which `time` has passed since the beginning of the step, for steps that a period ends before a release; and
    /// the lanes in which Newton's method found it. The pair `sigma`: a step that is longer, and its time.
    #[inline(always)]
    pub fn sigma_at_time(
        &self,
        time: Lanes<S, N>,
        sigma: Pair<S, N>,
        of: Mask<S, N>,
    ) -> (Lanes<S, N>, Mask<S, N>) {
        let (sigma, whole) = sigma;
        let zero = time.like(0.0);
        let mut series = [zero; DEGREE + 1];
        for (k, term) in series.iter_mut().enumerate().skip(1) {
            *term = self.root[k - 1] * zero.like(RECIPROCALS[k]);
        }
        let touches = self.root[0].equals(zero);
        let share = time / whole;
        let share = touches.choose(share.square_root(), share);
        solve_series(&series, time, sigma, share, of)
    }
}

/// Solves `series` = `level` by Newton's method in the lanes `of`, from `share` of `sigma` on and within 0 to `sigma`; the
/// solution, and the lanes in which it converged.
#[inline(always)]
pub(super) fn solve_series<S: Simd, const N: usize>(
    series: &Terms<S, N>,
    level: Lanes<S, N>,
    sigma: Lanes<S, N>,
    share: Lanes<S, N>,
    of: Mask<S, N>,
) -> (Lanes<S, N>, Mask<S, N>) {
    let zero = sigma.like(0.0);
    let mut at = sigma * share;
    let mut open = of;
    for _ in 0..MAX_NEWTON_STEPS {
        let (value, rate) = value_and_rate(series, at);
        let step = (value - level) / rate;
        let next = (at - step).max(zero).min(sigma);
        at = open.choose(next, at);
        // After a step of 1e-8 of the Taylor step the next one would be lost in rounding.
        open = open.and_not(step.abs().below(sigma * zero.like(1e-8)));
        if !open.any() {
            break;
        }
    }
    (at, of.and_not(open))
}

/// Coefficient k of the product of two power series.
#[inline(always)]
fn convolve<S: Simd, const N: usize>(a: &Terms<S, N>, b: &Terms<S, N>, k: usize) -> Lanes<S, N> {
    let mut sum = a[0] * b[k];
    for i in 1..=k {
        sum = a[i].mul_add(b[k - i], sum);
    }
    sum
}
