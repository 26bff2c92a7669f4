//! The limit of the returns of a motion, extrapolated from four of them.

use nalgebra::Vector2;

use super::contraction_norm::spectral_radius;

/// Number of returns of the motion from which their limit is extrapolated.
pub(super) const RETURNS_PER_GUESS: usize = 4;
/// Least difference between 1 and the spectral radius of the return map with which a limit is extrapolated: deviations decay by
/// at least so much in one return.
pub(super) const MIN_DECAY: f64 = 1e-3;

/// The limit of a sequence of returns and the spectral radius with which they approach it, by minimal polynomial extrapolation
/// (Cabay and Jackson 1976): differences of successive returns obey d'' = trace d' - determinant d. None if they converge slowly.
pub(super) fn extrapolate_limit(
    points: &[Vector2<f64>; RETURNS_PER_GUESS],
) -> Option<(Vector2<f64>, f64)> {
    let [a, b, c] = [0, 1, 2].map(|k| points[k + 1] - points[k]);
    let last = points[RETURNS_PER_GUESS - 1];
    // Returns as close as that have settled.
    if c.norm() < 1e-8 {
        return Some((last, 0.0));
    }
    let area = b.perp(&a);
    let (trace, determinant) = match area.abs() > 1e-4 * a.norm() * b.norm() {
        true => (c.perp(&a) / area, c.perp(&b) / area),
        false => (c.dot(&b) / b.norm_squared(), 0.0),
    };
    let radius = spectral_radius(trace, determinant);
    let way = (c * trace - (c + b) * determinant) / (1.0 - trace + determinant);
    let is_like = way.norm() * (1.0 - radius) < 2.0 * c.norm();
    let limit = last + way;
    (radius < 1.0 - MIN_DECAY && is_like && limit.x > 0.0).then_some((limit, radius))
}
