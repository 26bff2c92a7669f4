//! Coefficients of the normal forms of folds and flips.

use nalgebra::{Matrix2, Vector2};

use super::TestFunction;
use crate::orbit::{OrbitError, StroboscopicMap};
use crate::tolerance::NEAR;
use softstop::CheckedScene;

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
