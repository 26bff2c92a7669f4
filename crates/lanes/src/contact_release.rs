//! Where a mass in contact under a power law leaves the face: the square root of its deflection, a series in sigma,
//! passes zero there with a slope.

use pulp::Simd;

use super::contact_series::{ContactSeries, DEGREE, RECIPROCALS, Terms};
use super::lanes::{Lanes, Mask, Pair};

/// Most halvings of a Taylor step until the release in it is decided; then the safe engine decides.
const MAX_HALVINGS: usize = 6;
/// Most steps of Newton's method for a zero of a contact's series; then the safe engine takes the lane.
const MAX_NEWTON_STEPS: usize = 10;
/// Bound on the rounding of the sum of a contact's series, relative to its first two terms.
const SUM_ROUNDING: f64 = 1e-14;

/// Whether, and after which sigma, lanes leave a power-law contact within a Taylor step.
pub(super) struct ReleaseSearch<S: Simd, const N: usize> {
    /// Lanes that are decided: they stay in contact up to `sigma`, or leave it there.
    pub decided: Mask<S, N>,
    pub leaves: Mask<S, N>,
    pub sigma: Lanes<S, N>,
}

/// What the sizes of its terms prove of a series on [0, sigma]: its sign, slope and curvature.
struct TermBounds<S: Simd, const N: usize> {
    /// Value at sigma.
    end: Lanes<S, N>,
    stays_positive: Mask<S, N>,
    falls: Mask<S, N>,
    is_concave: Mask<S, N>,
}

impl<S: Simd, const N: usize> ContactSeries<S, N> {
    /// Finds whether and where the lanes `of` leave contact within the step `sigma`; undecided steps are halved.
    #[inline(always)]
    pub fn find_release(&self, sigma: Lanes<S, N>, of: Mask<S, N>) -> ReleaseSearch<S, N> {
        let zero = sigma.like(0.0);
        let touches = self.root[0].equals(zero);
        let mut release = ReleaseSearch {
            decided: of & self.stays_in_contact(sigma),
            leaves: of.and_not(of),
            sigma,
        };
        let mut open = of.and_not(release.decided);
        if !open.any() {
            return release;
        }
        // At the face s / sigma takes the place of s.
        let mut series = self.root;
        for (k, term) in series.iter_mut().enumerate() {
            let next = if k < DEGREE { self.root[k + 1] } else { zero };
            *term = touches.choose(next, *term);
        }
        for _ in 0..=MAX_HALVINGS {
            let bounds = term_bounds(&series, release.sigma);
            let single = bounds.falls | (bounds.is_concave & zero.below(series[0]));
            let leaves = open & single & bounds.end.at_most(zero);
            let stays = open & (bounds.stays_positive | (single & zero.below(bounds.end)));
            release.leaves = release.leaves | leaves;
            release.decided = release.decided | leaves | stays;
            open = open.and_not(release.decided);
            if !open.any() {
                break;
            }
            release.sigma = open.choose(release.sigma * zero.like(0.5), release.sigma);
        }
        if release.leaves.any() {
            let share = series[0] / (series[0] - value_and_rate(&series, release.sigma).0);
            let share = touches.choose(share.square_root(), share);
            let (sigma, found) = solve_series(&series, zero, release.sigma, share, release.leaves);
            release.sigma = release.leaves.choose(sigma, release.sigma);
            release.decided = release.decided.and_not(release.leaves.and_not(found));
            release.leaves = release.leaves & found;
        }
        release
    }

    /// True where the terms of the series prove that the square root of the deflection is positive up to `sigma`.
    #[inline(always)]
    fn stays_in_contact(&self, sigma: Lanes<S, N>) -> Mask<S, N> {
        let zero = sigma.like(0.0);
        let mut tail = zero;
        for k in (2..=DEGREE).rev() {
            tail = tail.mul_add(sigma, self.root[k].abs());
        }
        let tail = tail * sigma * sigma;
        let first = self.root[1] * sigma;
        let (value, rounding) = (self.root[0], zero.like(SUM_ROUNDING));
        let margin = rounding.mul_add(value + first.abs(), tail);
        margin.below(first) | margin.below(value + first.min(zero))
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

    /// True where the terms of the series prove that the velocity towards the stop stays above `level` over a step `sigma`, so
    /// that the law's force does not change sign.
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
}

/// Solves `series` = `level` by Newton's method in the lanes `of`, from `share` of `sigma` on and within 0 to `sigma`; the
/// solution, and the lanes in which it converged.
#[inline(always)]
fn solve_series<S: Simd, const N: usize>(
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

/// Value and first derivative of a series at `at`.
#[inline(always)]
fn value_and_rate<S: Simd, const N: usize>(series: &Terms<S, N>, at: Lanes<S, N>) -> Pair<S, N> {
    let mut value = series[DEGREE];
    let mut rate = at.like(0.0);
    for k in (0..DEGREE).rev() {
        rate = rate.mul_add(at, value);
        value = value.mul_add(at, series[k]);
    }
    (value, rate)
}

/// Bounds a series on [0, sigma] by the sizes of its terms.
#[inline(always)]
fn term_bounds<S: Simd, const N: usize>(
    series: &Terms<S, N>,
    sigma: Lanes<S, N>,
) -> TermBounds<S, N> {
    let zero = sigma.like(0.0);
    let (mut tail, mut slopes, mut curves) = (zero, zero, zero);
    for k in (2..=DEGREE).rev() {
        let term = series[k].abs();
        tail = tail.mul_add(sigma, term);
        slopes = slopes.mul_add(sigma, term * zero.like(k as f64));
        if k > 2 {
            curves = curves.mul_add(sigma, term * zero.like((k * (k - 1)) as f64));
        }
    }
    let (value, first) = (series[0], series[1] * sigma);
    let rounding = zero.like(SUM_ROUNDING) * (value.abs() + first.abs());
    let square = sigma * sigma;
    let bend = series[2] * square;
    let low = value + first.min(zero);
    TermBounds {
        end: value_and_rate(series, sigma).0,
        stays_positive: tail.mul_add(square, rounding).below(low),
        falls: slopes.mul_add(square, first + rounding).below(zero),
        is_concave: (curves * square)
            .mul_add(sigma, bend + bend + rounding)
            .below(zero),
    }
}
