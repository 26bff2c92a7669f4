//! The derivative of a map by central differences.

use nalgebra::{Matrix2, Vector2};
use softstop_dynamics::orbit::StroboscopicMap;

/// Distance in m and m/s of the states that are compared.
const WIDTH: f64 = 1e-6;

/// d(image)/d(state), off by rounding over [`WIDTH`] and by the square of it.
pub fn differences(map: &StroboscopicMap, state: Vector2<f64>) -> Matrix2<f64> {
    let column = |direction: Vector2<f64>| {
        let plus = map.image(state + WIDTH * direction).expect("bounded");
        let minus = map.image(state - WIDTH * direction).expect("bounded");
        (plus - minus) / (2.0 * WIDTH)
    };
    Matrix2::from_columns(&[column(Vector2::x()), column(Vector2::y())])
}
