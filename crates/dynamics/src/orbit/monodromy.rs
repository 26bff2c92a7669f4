//! The Jacobian of the map over a period, and what it says of stability.

use std::ops::Deref;

use nalgebra::{Complex, Matrix2};
use serde::{Deserialize, Serialize};

use crate::tolerance::TEST_ROUNDING;
use softstop::Tangent;

/// The Jacobian of the stroboscopic map over a period, with its determinant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Monodromy {
    /// Its entries, saltation included.
    #[serde(with = "columns")]
    pub matrix: Matrix2<f64>,
    determinant: f64,
}

impl Monodromy {
    /// The monodromy matrix of a motion that does not depend on its state: zero.
    pub(crate) const ZERO: Self = Self {
        matrix: Matrix2::new(0.0, 0.0, 0.0, 0.0),
        determinant: 0.0,
    };

    /// A monodromy matrix, or a factor of one over a part of the motion, with its determinant, known without cancellation.
    pub(crate) fn with_determinant(matrix: Matrix2<f64>, determinant: f64) -> Self {
        Self {
            matrix,
            determinant,
        }
    }

    /// The monodromy matrix of a motion as the product of those of its parts, in order of time.
    pub(crate) fn product(parts: &[Self]) -> Self {
        let product = |product, part: &Self| part.matrix * product;
        Self {
            matrix: parts.iter().fold(Matrix2::identity(), product),
            determinant: parts.iter().map(|part| part.determinant).product(),
        }
    }

    /// Determinant of the monodromy matrix, as a product over arcs and resets: free of cancellation at weak impacts.
    pub fn determinant(&self) -> f64 {
        self.determinant
    }

    /// 1 - tr + det, the determinant of 1 - M: zero at a fold, positive on its stable side.
    pub fn fold_test(&self) -> f64 {
        1.0 - self.trace() + self.determinant
    }

    /// The inverse of 1 - M: changes of the fixed point by what the map is moved by; none at a fold.
    pub fn resolvent(&self) -> Option<Matrix2<f64>> {
        let m = &self.matrix;
        let adjugate = Matrix2::new(1.0 - m.m22, m.m12, m.m21, 1.0 - m.m11);
        let inverse = adjugate / self.fold_test();
        inverse
            .iter()
            .all(|entry| entry.is_finite())
            .then_some(inverse)
    }

    /// Floquet multipliers of the monodromy matrix, the roots of mu^2 - trace mu + determinant, the one of larger modulus first.
    pub fn multipliers(&self) -> [Complex<f64>; 2] {
        quadratic_roots(self.trace(), self.determinant)
    }

    /// True if an orbit with this monodromy matrix is stable, by Jury's conditions: 1 - tr + det > 0 (no fold), 1 + tr
    /// + det > 0 (no flip), det < 1; or det = 1 to rounding, as without any damping: neutral.
    pub fn is_stable(&self) -> bool {
        let (trace, determinant) = (self.trace(), self.determinant);
        let spirals_in = determinant < 1.0 + TEST_ROUNDING;
        self.fold_test() > 0.0 && 1.0 + trace + determinant > 0.0 && spirals_in
    }

    /// True if both multipliers of the monodromy matrix lie on the unit circle, as a stable motion's do without any damping.
    pub fn is_neutral(&self) -> bool {
        self.is_stable() && (self.determinant - 1.0).abs() < TEST_ROUNDING
    }
}

impl Deref for Monodromy {
    type Target = Matrix2<f64>;

    fn deref(&self) -> &Matrix2<f64> {
        &self.matrix
    }
}

impl From<&Tangent> for Monodromy {
    fn from(tangent: &Tangent) -> Self {
        Self {
            matrix: tangent.matrix,
            determinant: tangent.determinant,
        }
    }
}

/// Eigenvalues of a 2x2 matrix, the one of larger modulus first.
pub fn multipliers(matrix: &Matrix2<f64>) -> [Complex<f64>; 2] {
    quadratic_roots(matrix.trace(), matrix.determinant())
}

/// The roots of mu^2 - trace mu + determinant, the one of larger modulus first.
fn quadratic_roots(trace: f64, determinant: f64) -> [Complex<f64>; 2] {
    let half = 0.5 * trace;
    let discriminant = half * half - determinant;
    if discriminant < 0.0 {
        let imaginary = (-discriminant).sqrt();
        return [
            Complex::new(half, imaginary),
            Complex::new(half, -imaginary),
        ];
    }
    let large = half + discriminant.sqrt().copysign(half);
    let small = if large == 0.0 {
        0.0
    } else {
        determinant / large
    };
    [Complex::new(large, 0.0), Complex::new(small, 0.0)]
}

/// A matrix as its columns.
mod columns {
    use super::{Deserialize, Matrix2, Serialize};
    use serde::{Deserializer, Serializer};

    pub fn serialize<S: Serializer>(matrix: &Matrix2<f64>, to: S) -> Result<S::Ok, S::Error> {
        <[[f64; 2]; 2]>::from(*matrix).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Matrix2<f64>, D::Error> {
        <[[f64; 2]; 2]>::deserialize(from).map(Matrix2::from)
    }
}
