//! The proof that all motions about a limit cycle contract to it, and how far their returns are known from it.

use nalgebra::{Matrix2, Vector2};

use super::contraction_norm::ContractionNorm;
use super::cycle::Cycle;

/// Largest error of the limit point, as a length in the plane of return points (velocity over the first one, drive angle in rad).
const MAX_LIMIT_ERROR: f64 = 4e-12;
/// Most balls about the limit that are tried for the proof.
const MAX_BALLS: usize = 8;

/// Proof that all returns in a ball about the limit of a lane's returns to an impact contract to it, with the linear map by which
/// later returns are extrapolated.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContractionCertificate {
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

impl ContractionCertificate {
    /// True if the limit of the certificate is known within the error that extrapolation allows.
    pub fn is_exact(&self) -> bool {
        let moved = self.curvature * self.aside * self.aside / (1.0 - self.norm.rate_bound());
        moved * self.norm.largest_length() <= MAX_LIMIT_ERROR
    }

    /// By which factor a deviation `off` from the limit is too large for its ball, or the return `times` returns later is known
    /// too inexactly by the linear map: at most 1 where it may be extrapolated.
    pub fn excess(&self, off: &Vector2<f64>, times: f64) -> f64 {
        let (rate, curvature, aside) = (self.norm.rate_bound(), self.curvature, self.aside);
        let length = self.norm.norm_of(off) + aside;
        // |d_k| <= q rate^k |d_0| with 1/q = 1 - curvature |d_0| / (rate (1 - rate)); what is not linear adds up.
        let q = 1.0 / (1.0 - curvature * length / (rate * (1.0 - rate))).max(0.5);
        let bent = curvature * length * q * (q * length / (1.0 - rate) + 2.0 * times * aside);
        let error = bent * rate.powf(times - 1.0) * self.norm.largest_length();
        // What is left out in all returns adds up as if each bent the motion the same way: an error of 2e-10 is allowed.
        ((length + aside) / self.radius).max(error / 2e-10)
    }

    /// Number of returns after which an `excess` above 1 has fallen to 1.
    pub fn returns_until_exact(&self, excess: f64) -> f64 {
        (excess.ln() / -self.norm.rate_bound().ln()).ceil()
    }

    /// The return (velocity, drive angle) `times` returns after one that deviates from the limit by `off`, by the linear map.
    pub fn return_after(&self, off: &Vector2<f64>, times: f64) -> Vector2<f64> {
        self.limit + self.map.pow(times as u32) * off
    }
}

/// Radius of the largest ball of those tried about the limit, at most `most`, whose motions all make the crossings of the cycle
/// and contract to the limit, and the curvature of the return map in it; none if no ball is proven, or rounding moves the limit
/// too far.
pub(super) fn find_ball(
    cycle: &Cycle,
    norm: &ContractionNorm,
    inverse: &Matrix2<f64>,
    most: f64,
) -> Option<(f64, f64)> {
    let rate = norm.rate_bound();
    let (mut radius, shrink) = (most, 0.25);
    for _ in 0..MAX_BALLS {
        let ball = norm.from * radius;
        let Some(remainder) = cycle.remainder(&ball) else {
            radius *= shrink;
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
            radius *= shrink;
        }
    }
    None
}
