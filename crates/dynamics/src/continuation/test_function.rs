//! Test functions of the monodromy matrix for folds, flips and Neimark-Sacker points.

use crate::orbit::Monodromy;
use crate::tolerance::{NEAR, TEST_ROUNDING};

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

    /// The value of the test, scaled by the size of trace and determinant: bounded also at grazing, where these are not.
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

    /// True if the test vanishes to rounding: at a bifurcation; that for a fold also all along orbits that lie side by side, as those
    /// of a free mass, which nothing brings back to where it was.
    pub(crate) fn vanishes_at(self, monodromy: &Monodromy) -> bool {
        self.scaled_value(monodromy).abs() <= TEST_ROUNDING
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

#[cfg(test)]
mod tests {
    use super::TestFunction;
    use crate::orbit::Monodromy;
    use nalgebra::{Matrix2, Rotation2};

    fn of(matrix: Matrix2<f64>) -> Monodromy {
        Monodromy::with_determinant(matrix, matrix.determinant())
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
