//! Where a mass in contact under a power law leaves the face: the root of its deflection passes zero there simply.

use pulp::Simd;

use super::lanes::{Lanes, Mask};
use super::power::{DEGREE, Power, RECIPROCALS, Series};

/// How often a step that is not decided is halved before the safe engine decides.
const MOST_HALVINGS: usize = 6;
/// Steps of Newton's method before a lane is given up.
const MOST_TRIES: usize = 10;
/// Its last step, relative to the whole: the next one would be lost in rounding.
const SHORT: f64 = 1e-8;
/// Rounding of a sum, relative to its terms.
const ROUNDING: f64 = 1e-14;

/// What lies ahead.
pub(super) struct Release<S: Simd, const N: usize> {
    /// Lanes whose way is decided: up to sigma they stay in contact, or leave it there.
    pub decided: Mask<S, N>,
    pub leaves: Mask<S, N>,
    pub sigma: Lanes<S, N>,
}

/// A polynomial and bounds on it from 0 to sigma.
struct Bounds<S: Simd, const N: usize> {
    /// Value at sigma.
    end: Lanes<S, N>,
    stays_positive: Mask<S, N>,
    falls: Mask<S, N>,
    is_concave: Mask<S, N>,
}

impl<S: Simd, const N: usize> Power<S, N> {
    /// Whether the lanes `of` leave contact before sigma. Steps that cannot be decided are shortened.
    #[inline(always)]
    pub fn release(&self, sigma: Lanes<S, N>, of: Mask<S, N>) -> Release<S, N> {
        let zero = sigma.like(0.0);
        let touches = self.root[0].equals(zero);
        let mut release = Release {
            decided: of & self.stays(sigma),
            leaves: of.and_not(of),
            sigma,
        };
        let mut open = of.and_not(release.decided);
        if !open.any() {
            return release;
        }
        // At the face the root over sigma is looked at.
        let mut series = self.root;
        for (k, term) in series.iter_mut().enumerate() {
            let next = if k < DEGREE { self.root[k + 1] } else { zero };
            *term = touches.choose(next, *term);
        }
        for _ in 0..=MOST_HALVINGS {
            let bounds = bounds(&series, release.sigma);
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
            let share = series[0] / (series[0] - value(&series, release.sigma).0);
            let share = touches.choose(share.square_root(), share);
            let (sigma, found) = zero_of(&series, zero, release.sigma, share, release.leaves);
            release.sigma = release.leaves.choose(sigma, release.sigma);
            release.decided = release.decided.and_not(release.leaves.and_not(found));
            release.leaves = release.leaves & found;
        }
        release
    }

    /// True where the root is positive up to sigma.
    #[inline(always)]
    fn stays(&self, sigma: Lanes<S, N>) -> Mask<S, N> {
        let zero = sigma.like(0.0);
        let mut tail = zero;
        for k in (2..=DEGREE).rev() {
            tail = tail.mul_add(sigma, self.root[k].abs());
        }
        let tail = tail * sigma * sigma;
        let first = self.root[1] * sigma;
        let (value, rounding) = (self.root[0], zero.like(ROUNDING));
        let margin = rounding.mul_add(value + first.abs(), tail);
        margin.below(first) | margin.below(value + first.min(zero))
    }

    /// Sigma, of 0 to `sigma`, at which the time has come, and where it was found.
    #[inline(always)]
    pub fn sigma_at(
        &self,
        time: Lanes<S, N>,
        sigma: (Lanes<S, N>, Lanes<S, N>),
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
        zero_of(&series, time, sigma, share, of)
    }
}

/// Newton's method on `series` = `level` from a share of sigma, within 0 to sigma.
#[inline(always)]
fn zero_of<S: Simd, const N: usize>(
    series: &Series<S, N>,
    level: Lanes<S, N>,
    sigma: Lanes<S, N>,
    share: Lanes<S, N>,
    of: Mask<S, N>,
) -> (Lanes<S, N>, Mask<S, N>) {
    let zero = sigma.like(0.0);
    let mut at = sigma * share;
    let mut open = of;
    for _ in 0..MOST_TRIES {
        let (value, rate) = value(series, at);
        let step = (value - level) / rate;
        let next = (at - step).max(zero).min(sigma);
        at = open.choose(next, at);
        open = open.and_not(step.abs().below(sigma * zero.like(SHORT)));
        if !open.any() {
            break;
        }
    }
    (at, of.and_not(open))
}

/// Value and rate of a polynomial.
#[inline(always)]
fn value<S: Simd, const N: usize>(
    series: &Series<S, N>,
    at: Lanes<S, N>,
) -> (Lanes<S, N>, Lanes<S, N>) {
    let mut value = series[DEGREE];
    let mut rate = at.like(0.0);
    for k in (0..DEGREE).rev() {
        rate = rate.mul_add(at, value);
        value = value.mul_add(at, series[k]);
    }
    (value, rate)
}

/// What the sizes of its terms say of a polynomial.
#[inline(always)]
fn bounds<S: Simd, const N: usize>(series: &Series<S, N>, sigma: Lanes<S, N>) -> Bounds<S, N> {
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
    let rounding = zero.like(ROUNDING) * (value.abs() + first.abs());
    let square = sigma * sigma;
    let bend = series[2] * square;
    let low = value + first.min(zero);
    Bounds {
        end: self::value(series, sigma).0,
        stays_positive: tail.mul_add(square, rounding).below(low),
        falls: slopes.mul_add(square, first + rounding).below(zero),
        is_concave: (curves * square)
            .mul_add(sigma, bend + bend + rounding)
            .below(zero),
    }
}
