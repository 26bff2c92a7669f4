//! Derivatives by central differences.

use nalgebra::{Matrix2, Vector2};

/// Distance in m and m/s of the states that are compared.
const WIDTH: f64 = 1e-6;

/// d(image)/d(state), off by rounding over 1e-6 and by the square of that.
pub fn differences(
    image: impl Fn(Vector2<f64>) -> Vector2<f64>,
    state: Vector2<f64>,
) -> Matrix2<f64> {
    let column = |direction: Vector2<f64>| {
        (image(state + WIDTH * direction) - image(state - WIDTH * direction)) / (2.0 * WIDTH)
    };
    Matrix2::from_columns(&[column(Vector2::x()), column(Vector2::y())])
}

/// Derivatives of some numbers by central differences of the sixth order, over up to three widths to each side, each with its
/// distance from that of the fourth order; none where the numbers are not to be had.
pub fn differences_of(
    numbers: impl Fn(f64) -> Option<Vec<f64>>,
    width: f64,
) -> Option<Vec<(f64, f64)>> {
    let central = |width: f64| {
        let pairs = numbers(width)?.into_iter().zip(numbers(-width)?);
        Some(pairs.map(move |(high, low)| (high - low) / (2.0 * width)))
    };
    let [narrow, wide, far] = [1.0, 2.0, 3.0].map(|times| central(times * width));
    let each = narrow?.zip(wide?).zip(far?).map(|((narrow, wide), far)| {
        let fourth = (4.0 * narrow - wide) / 3.0;
        let sixth = 1.5 * narrow - 0.6 * wide + 0.1 * far;
        (sixth, (sixth - fourth).abs())
    });
    Some(each.collect())
}
