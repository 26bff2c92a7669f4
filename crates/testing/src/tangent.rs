//! The derivative of a map by central differences.

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
