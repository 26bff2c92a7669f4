//! Test functions of the monodromy matrix for folds, flips and Neimark-Sacker points, and coefficients of normal forms.

use nalgebra::{Matrix2, Vector2};

use crate::orbit::{Monodromy, OrbitError, StroboscopicMap};
use crate::tolerance::{NEAR, TEST_ROUNDING};
use softstop::CheckedScene;

/// A function of the monodromy matrix that vanishes at a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TestFunction {
    /// 1 - tr + det: a multiplier is 1.
    Fold,
    /// 1 + tr + det: a multiplier is -1.
    Flip,
    /// det - 1 between two complex multipliers. Never where there is any damping: det = exp(-integral of damping over
    /// mass) times R^2 for each rebound, and a scene's damping is not negative.
    NeimarkSacker,
}

impl TestFunction {
    /// All tests.
    pub const ALL: [Self; 3] = [Self::Fold, Self::Flip, Self::NeimarkSacker];

    /// The value of the test, scaled by the size of trace and determinant: bounded also where they grow beyond all
    /// bounds, at grazing.
    pub fn scaled_value(self, monodromy: &Monodromy) -> f64 {
        self.weighted_value(monodromy, 1.0)
    }

    /// The value of a weight times the test, scaled by the size of the weight times trace and determinant: smooth down
    /// to weight 0 where trace and determinant grow as its reciprocal.
    pub(crate) fn weighted_value(self, monodromy: &Monodromy, weight: f64) -> f64 {
        let (trace, determinant) = (monodromy.trace(), monodromy.determinant());
        let size = 1.0f64.hypot(weight * trace).hypot(weight * determinant);
        let test = match self {
            Self::Fold => 1.0 - trace + determinant,
            Self::Flip => 1.0 + trace + determinant,
            Self::NeimarkSacker => determinant - 1.0,
        };
        weight * test / size
    }

    /// True if the test does not vanish at a point where its sign changes to the last digit of the parameter: multipliers jump there,
    /// as where a touch comes or goes.
    pub fn jumps_at(self, monodromy: &Monodromy) -> bool {
        self.scaled_value(monodromy).abs() > NEAR
    }

    /// True if no test changes by more than `most` between two orbits.
    pub(crate) fn change_little(from: &Monodromy, to: &Monodromy, most: f64) -> bool {
        let change = |test: &Self| (test.scaled_value(from) - test.scaled_value(to)).abs();
        Self::ALL.iter().all(|test| change(test) < most)
    }

    /// True if the test passes zero between two orbits. Without damping the determinant is 1 to rounding all along:
    /// nothing passes there.
    pub(crate) fn passes_zero(self, from: &Monodromy, to: &Monodromy) -> bool {
        let (a, b) = (self.scaled_value(from), self.scaled_value(to));
        let changes = (a > 0.0) != (b > 0.0);
        match self {
            Self::Fold | Self::Flip => changes,
            Self::NeimarkSacker => {
                let rotates = |monodromy: &Monodromy| monodromy.trace().abs() < 2.0;
                let moves = (a - b).abs() > TEST_ROUNDING;
                changes && moves && rotates(from) && rotates(to)
            }
        }
    }
}

/// Distances along the critical eigenvector, in the map's scales, over which the Jacobian is differenced.
const FORM_DISTANCES: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// The coefficient of the normal form of a fixed point's map: a of u + a u^2 at a fold, c of -u + c u^3 at a flip, for the
/// coordinate u along the critical eigenvector of length 1 in units of [`Scene::scales`](softstop::Scene::scales). A flip with
/// c > 0 is supercritical: the orbits of twice the period begin stable, where the orbit is unstable. (Reduction to the centre
/// manifold, Kuznetsov, *Elements of Applied Bifurcation Theory*, section 5.4; second and third derivatives are differences of the
/// exact Jacobian.)
///
/// None where there is no such form: for a Neimark-Sacker point, and where the orbit grazes too near.
///
/// # Errors
/// [`OrbitError`] if the motion of the state does not go on.
pub fn normal_form_coefficient(
    scene: &CheckedScene,
    periods: u64,
    test: TestFunction,
    state: Vector2<f64>,
) -> Result<Option<f64>, OrbitError> {
    let multiplier = match test {
        TestFunction::Fold => 1.0,
        TestFunction::Flip => -1.0,
        TestFunction::NeimarkSacker => return Ok(None),
    };
    let map = StroboscopicMap::new(scene, periods);
    let scales = scene.scales();
    let units = Matrix2::from_diagonal(&Vector2::new(scales.length, scales.speed()));
    let bare = Matrix2::from_diagonal(&Vector2::new(scales.length, scales.speed()).map(f64::recip));
    let here = map.apply(state)?;
    let jacobian = bare * here.monodromy.matrix * units;
    let critical = jacobian - multiplier * Matrix2::identity();
    let right = null_vector(&critical);
    let left = null_vector(&critical.transpose());
    let left = left / left.dot(&right);
    let resolvent = here.monodromy.resolvent().map(|it| bare * it * units);
    // The Jacobian so far along the eigenvector, if the motion has the same impacts there.
    let beside = |distance: f64| {
        let passage = map.apply(state + units * right * distance).ok()?;
        let same = passage.impacts.len() == here.impacts.len();
        same.then(|| bare * passage.monodromy.matrix * units)
    };
    let coefficient = |width: f64| {
        let [far_back, back, on, far] = [-2.0, -1.0, 1.0, 2.0].map(|steps| beside(steps * width));
        let (far_back, back, on, far) = (far_back?, back?, on?, far?);
        let first = (8.0 * (on - back) - (far - far_back)) / (12.0 * width);
        let quadratic = first * right;
        let parts = match test {
            TestFunction::Fold => [0.5 * left.dot(&quadratic), 0.0],
            _ => {
                let even = 16.0 * (on + back) - 30.0 * jacobian - (far + far_back);
                let second = even / (12.0 * width * width);
                let bent = resolvent? * quadratic;
                [
                    left.dot(&(second * right)) / 6.0,
                    0.5 * left.dot(&(first * bent)),
                ]
            }
        };
        Some(parts)
    };
    Ok(FORM_DISTANCES.iter().find_map(|width| {
        let (wide, narrow) = (coefficient(*width)?, coefficient(0.5 * width)?);
        let size: f64 = narrow.iter().map(|part| part.abs()).sum();
        let [wide, narrow] = [wide, narrow].map(|parts| parts[0] + parts[1]);
        ((wide - narrow).abs() <= NEAR * size).then_some(narrow)
    }))
}

/// The vector of length 1 that a singular matrix takes to zero.
pub(super) fn null_vector(matrix: &Matrix2<f64>) -> Vector2<f64> {
    let rows = [matrix.row(0), matrix.row(1)];
    let row = if rows[0].norm() >= rows[1].norm() {
        rows[0]
    } else {
        rows[1]
    };
    Vector2::new(-row[1], row[0]).normalize()
}

#[cfg(test)]
mod tests {
    use super::TestFunction;
    use crate::orbit::Monodromy;
    use nalgebra::{Matrix2, Rotation2};

    fn of(matrix: Matrix2<f64>) -> Monodromy {
        Monodromy::from_factors(&[(matrix, matrix.determinant())])
    }

    #[test]
    fn tests_vanish_at_their_multipliers() {
        let vanishes =
            |test: TestFunction, matrix| assert!(test.scaled_value(&of(matrix)).abs() < 1e-15);
        vanishes(TestFunction::Fold, Matrix2::new(1.0, 5.0, 0.0, 0.3));
        vanishes(TestFunction::Flip, Matrix2::new(-1.0, 5.0, 0.0, 0.3));
        vanishes(
            TestFunction::NeimarkSacker,
            Rotation2::new(1.0).into_inner(),
        );
    }

    #[test]
    fn neimark_sacker_needs_complex_multipliers_and_a_change() {
        let turned = |size: f64| of(Rotation2::new(1.0).into_inner() * size);
        let passes =
            |from: Monodromy, to: Monodromy| TestFunction::NeimarkSacker.passes_zero(&from, &to);
        assert!(passes(turned(0.9), turned(1.1)));
        assert!(!passes(turned(0.9), turned(0.95)));
        assert!(!passes(turned(1.0 - 1e-14), turned(1.0 + 1e-14)));
        let stretched = |size: f64| of(Matrix2::new(3.0 * size, 0.0, 0.0, size / 3.0));
        assert!(!passes(stretched(0.9), stretched(1.1)));
    }
}
