//! The proof that all motions about a limit cycle contract to it, and how far their returns are known from it.

use nalgebra::{Matrix2, Vector2};

use super::contraction_norm::ContractionNorm;
use super::cycle::Cycle;

/// Largest error of the limit, in units of the distance of returns.
const MAX_LIMIT_ERROR: f64 = 4e-12;
/// Largest error of the extrapolated last return, in these units: it adds up what is left out in all returns, as if each bent
/// the motion the same way.
const MAX_END_ERROR: f64 = 2e-10;
/// Most balls about the limit that are tried for the proof.
const MAX_BALLS: usize = 8;
/// Ratio of the radius of a ball to that of the one before, on which the proof failed.
const RADIUS_RATIO: f64 = 0.25;
/// Least norm of the map of returns that is assumed in the bound on how deviations die out.
const MIN_RATE: f64 = 0.25;

/// What is proven of all returns in a ball about the limit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Certificate {
    pub limit: Vector2<f64>,
    pub map: Matrix2<f64>,
    pub norm: ContractionNorm,
    /// Radius of the ball, in the norm.
    pub radius: f64,
    /// The next return deviates by the linear map and at most this times the square of the deviation, in the norm.
    pub curvature: f64,
    /// Distance from the limit of the cycle about which this is proven.
    pub aside: f64,
}

impl Certificate {
    /// Bound on the factor by which deviations from the limit shrink to first order, from one return to the next.
    fn rate(&self) -> f64 {
        self.norm.rate.max(MIN_RATE)
    }

    /// True if the limit is as exact as extrapolation asks.
    pub fn is_exact(&self) -> bool {
        let moved = self.curvature * self.aside * self.aside / (1.0 - self.rate());
        moved * self.norm.largest_length() <= MAX_LIMIT_ERROR
    }

    /// By which factor a deviation from the limit is too large for its ball, or its image after so many returns too inexact:
    /// at most 1 where that may be extrapolated.
    pub fn excess(&self, off: &Vector2<f64>, times: f64) -> f64 {
        let (rate, curvature, aside) = (self.rate(), self.curvature, self.aside);
        let length = self.norm.norm_of(off) + aside;
        // |d_k| <= q rate^k |d_0| with 1/q = 1 - curvature |d_0| / (rate (1 - rate)); what is not linear adds up.
        let q = 1.0 / (1.0 - curvature * length / (rate * (1.0 - rate))).max(0.5);
        let bent = curvature * length * q * (q * length / (1.0 - rate) + 2.0 * times * aside);
        let error = bent * rate.powf(times - 1.0) * self.norm.largest_length();
        ((length + aside) / self.radius).max(error / MAX_END_ERROR)
    }

    /// Returns after which an excess has fallen to 1.
    pub fn returns_until_exact(&self, excess: f64) -> f64 {
        (excess.ln() / -self.rate().ln()).ceil()
    }

    /// The return that is so many returns after a deviation from the limit.
    pub fn return_after(&self, off: &Vector2<f64>, times: f64) -> Vector2<f64> {
        self.limit + self.map.pow(times as u32) * off
    }
}

/// The radius of the largest ball of those tried, not larger than `most`, whose motions all make the crossings of
/// the cycle and contract to the limit, and the curvature in it; none if rounding moves the limit too far.
pub(super) fn find_ball(
    cycle: &Cycle,
    norm: &ContractionNorm,
    inverse: &Matrix2<f64>,
    most: f64,
) -> Option<(f64, f64)> {
    let rate = norm.rate.max(MIN_RATE);
    let mut radius = most;
    for _ in 0..MAX_BALLS {
        let ball = norm.from * radius;
        let Some(remainder) = cycle.remainder(&ball) else {
            radius *= RADIUS_RATIO;
            continue;
        };
        if (inverse.abs() * remainder.rounding).norm() > MAX_LIMIT_ERROR {
            return None;
        }
        let curvature = norm.largest_norm(&remainder.curvature) / (radius * radius);
        let drawn = 0.5 * rate * (1.0 - rate) / curvature;
        if curvature.is_nan() || radius > drawn {
            radius = 0.9 * drawn;
        } else if cycle.ball_is_clear(&ball) {
            return Some((radius, curvature));
        } else {
            radius *= RADIUS_RATIO;
        }
    }
    None
}
