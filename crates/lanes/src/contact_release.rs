//! Where a mass in contact under a power law leaves the surface: the square root of its deflection, a series in sigma,
//! passes zero there with a slope.

use pulp::Simd;

use super::contact_series::{ContactSeries, DEGREE, Terms, solve_series};
use super::lanes::{Lanes, Mask};
use super::polynomial::value_and_rate;

/// Most halvings of a Taylor step until the release in it is decided; then the safe engine decides.
const MAX_HALVINGS: usize = 6;
/// Bound on the rounding of the sum of a contact's series, relative to its first two terms.
const SUM_ROUNDING: f64 = 1e-14;

/// Whether, and after which sigma, lanes leave a power-law contact within a Taylor step.
pub(super) struct ReleaseSearch<S: Simd, const N: usize> {
    /// Lanes that are decided: they stay in contact up to `sigma`, or leave it there.
    pub decided: Mask<S, N>,
    pub leaves: Mask<S, N>,
    pub sigma: Lanes<S, N>,
}

/// Value of a series at sigma, and whether the sizes of its terms prove that it stays positive, falls, is concave on [0, sigma].
struct SeriesProof<S: Simd, const N: usize> {
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
        // At the surface s / sigma takes the place of s.
        let mut series = self.root;
        for (k, term) in series.iter_mut().enumerate() {
            let next = if k < DEGREE { self.root[k + 1] } else { zero };
            *term = touches.choose(next, *term);
        }
        for _ in 0..=MAX_HALVINGS {
            let bounds = prove_by_terms(&series, release.sigma);
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

/// What the sizes of its terms prove of a contact's series on [0, sigma].
#[inline(always)]
fn prove_by_terms<S: Simd, const N: usize>(
    series: &Terms<S, N>,
    sigma: Lanes<S, N>,
) -> SeriesProof<S, N> {
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
    SeriesProof {
        end: value_and_rate(series, sigma).0,
        stays_positive: tail.mul_add(square, rounding).below(low),
        falls: slopes.mul_add(square, first + rounding).below(zero),
        is_concave: (curves * square)
            .mul_add(sigma, bend + bend + rounding)
            .below(zero),
    }
}
