//! The map from one return to the next, close to the one that stays where it is.

use nalgebra::{Matrix2, Vector2};

/// Returns that are looked at together.
pub(super) const TOGETHER: usize = 4;
/// What may be rounding in a return.
pub(super) const ROUNDING: f64 = 1e-14;
/// Sine of the angle between differences below which they do not show both multipliers.
const FLAT: f64 = 1e-4;
/// Least decay in one return.
const SLOWEST: f64 = 1e-3;

/// The return map about its fixed point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Map {
    pub trace: f64,
    pub determinant: f64,
    pub fixed: Vector2<f64>,
    /// (1 - M)^-1, and what rounding may change in M.
    pub inverse: Matrix2<f64>,
    pub error: f64,
    /// True if the returns show both multipliers.
    pub is_known: bool,
}

impl Map {
    /// The map that leads from each point to the next.
    pub fn through(points: &[Vector2<f64>; TOGETHER]) -> Option<Self> {
        let [a, b, c] = [0, 1, 2].map(|k| points[k + 1] - points[k]);
        if b.norm() <= ROUNDING {
            return Some(Self::constant(points[TOGETHER - 1]));
        }
        let area = b.perp(&a);
        let is_known = area.abs() > FLAT * a.norm() * b.norm();
        let (trace, determinant) = match is_known {
            true => (c.perp(&a) / area, c.perp(&b) / area),
            false => (c.dot(&b) / b.norm_squared(), 0.0),
        };
        let way = (c * trace - (c + b) * determinant) / (1.0 - trace + determinant);
        let fixed = points[TOGETHER - 1] + way;
        let [before, after] = [[a, b], [a - b, b - c]].map(|pair| Matrix2::from_columns(&pair));
        let map = Self {
            trace,
            determinant,
            fixed,
            inverse: before * after.try_inverse()?,
            error: ROUNDING * (a.norm() + b.norm()) / area.abs(),
            is_known,
        };
        (fixed.x > 0.0 && fixed.y.is_finite()).then_some(map)
    }

    /// That to one point from all.
    fn constant(fixed: Vector2<f64>) -> Self {
        Self {
            trace: 0.0,
            determinant: 0.0,
            fixed,
            inverse: Matrix2::identity(),
            error: 0.0,
            is_known: true,
        }
    }

    /// The larger multiplier.
    pub fn radius(&self) -> f64 {
        let half = 0.5 * self.trace.abs();
        let square = half.mul_add(half, -self.determinant);
        match square >= 0.0 {
            true => half + square.sqrt(),
            false => self.determinant.sqrt(),
        }
    }

    /// True if motions close to the fixed point come to it.
    pub fn is_stable(&self) -> bool {
        self.radius() < 1.0 - SLOWEST
    }
}
