//! A norm in which a stable linear map contracts.

use nalgebra::{Matrix2, Vector2};

/// How often the number of terms of the sum that gives the norm is doubled: up to 256. Where more would count, the map contracts
/// a little less in the norm.
const SUM_DOUBLINGS: usize = 8;

/// The norm |P y|, with the Euclidean length, in which a stable linear map shortens every vector.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContractionNorm {
    /// P and its inverse.
    to: Matrix2<f64>,
    pub from: Matrix2<f64>,
    /// Norm of the map.
    rate: f64,
}

impl ContractionNorm {
    /// The norm for a map with a spectral radius below 1: with g a little above that radius, P'P is the sum of (M'/g)^k (M/g)^k
    /// over all k (Stein's equation).
    pub fn of_map(map: &Matrix2<f64>) -> Option<Self> {
        let radius = spectral_radius(map.trace(), map.determinant());
        let bound = radius + 0.02 * (1.0 - radius);
        let (mut power, mut sum) = (map / bound, Matrix2::identity());
        for _ in 0..SUM_DOUBLINGS {
            sum += power.transpose() * sum * power;
            power *= power;
        }
        let to = sum.cholesky()?.l().transpose();
        let from = to.try_inverse()?;
        let rate = spectral_norm(&(to * map * from));
        (rate < 1.0).then_some(Self { to, from, rate })
    }

    /// Factor by which the map shortens vectors in the norm, taken for at least 0.25 in bounds on how deviations die out.
    pub fn rate_bound(&self) -> f64 {
        self.rate.max(0.25)
    }

    /// The norm |P y| of a vector.
    pub fn norm_of(&self, vector: &Vector2<f64>) -> f64 {
        (self.to * vector).norm()
    }

    /// The largest norm |P y| of vectors whose entries have at most the sizes of `entries`.
    pub fn largest_norm(&self, entries: &Vector2<f64>) -> f64 {
        (self.to.abs() * entries).norm()
    }

    /// Bound on the Euclidean length of vectors of norm 1.
    pub fn largest_length(&self) -> f64 {
        self.from.norm()
    }
}

/// The larger absolute value of the two eigenvalues of a 2 x 2 matrix such as the return map of a lane, by its trace and determinant.
pub(super) fn spectral_radius(trace: f64, determinant: f64) -> f64 {
    let half = 0.5 * trace.abs();
    let square = half.mul_add(half, -determinant);
    match square >= 0.0 {
        true => half + square.sqrt(),
        false => determinant.sqrt(),
    }
}

/// The largest singular value of a matrix: the largest factor by which it lengthens a vector.
fn spectral_norm(matrix: &Matrix2<f64>) -> f64 {
    let (square, area) = (matrix.norm_squared(), matrix.determinant());
    let spread = (square * square - 4.0 * area * area).max(0.0).sqrt();
    (0.5 * (square + spread)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stable_maps_shorten_every_vector() {
        let maps = [
            Matrix2::new(0.5, -0.7, 0.7, 0.5),
            Matrix2::new(0.9, 40.0, 0.0, 0.3),
            Matrix2::new(0.95, 1.0, 0.0, 0.95),
            Matrix2::new(-0.98, 0.0, 3.0, 0.2),
            Matrix2::zeros(),
        ];
        for map in maps {
            let radius = spectral_radius(map.trace(), map.determinant());
            let norm = ContractionNorm::of_map(&map).expect("stable");
            assert!(radius <= norm.rate * (1.0 + 1e-12), "{map}");
            for angle in 0..32 {
                let (sin, cos) = (0.2 * f64::from(angle)).sin_cos();
                let vector = Vector2::new(cos, sin);
                let mapped = norm.norm_of(&(map * vector));
                assert!(mapped <= norm.rate * norm.norm_of(&vector) * (1.0 + 1e-9));
            }
        }
        let saddle = Matrix2::new(1.01, 0.0, 0.0, 0.5);
        assert!(ContractionNorm::of_map(&saddle).is_none());
    }
}
