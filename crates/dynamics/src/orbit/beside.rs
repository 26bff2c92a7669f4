//! Motions at frequencies beside the one that is looked at: narrow isolas lie between two frequencies of any row.

use nalgebra::{Matrix2x3, Vector2, Vector3};

use super::multi_segment_shooting::MultiSegmentShooting;
use super::{Orbit, OrbitError};
use softstop::Scene;

/// Steps before giving up.
const MAX_STEPS: usize = 20;
/// Largest step in each unknown.
const LARGEST: [f64; 3] = [0.1, 0.3, 0.02];
/// Half-width of the differences.
const DIFFERENCE_WIDTH: f64 = 1e-6;

/// The z = 1 orbit nearest to an impact of which little is missing, with its frequency free: steps of least norm
/// (Gauss and Newton) in the time of the impact in drive periods and the logarithms of its velocity and of the frequency.
/// Where they settle, in a fold as well, the system is regular. None beyond a share of the scene's frequency.
pub(super) fn beside_frequency(
    scene: &Scene,
    (time, velocity): (f64, f64),
    share: f64,
) -> Option<Orbit> {
    let beside = Beside(scene);
    let mut at = Vector3::new(time / scene.clock().period(), velocity.ln(), 0.0);
    let mut residual = beside.residual(at)?;
    for _ in 0..MAX_STEPS {
        let jacobian = beside.jacobian(at)?;
        let square = jacobian * jacobian.transpose();
        let step = -(jacobian.transpose() * square.lu().solve(&residual)?);
        let excess = step
            .iter()
            .zip(LARGEST)
            .map(|(part, most)| part.abs() / most);
        let next = at + step / excess.fold(1.0, f64::max);
        let left = beside.residual(next)?;
        if next.z.abs() > share {
            return None;
        }
        let settles = left.norm() >= 0.1 * residual.norm() && residual.norm() < DIFFERENCE_WIDTH;
        (at, residual) = (next, left);
        if settles {
            return beside.orbit(at).ok();
        }
    }
    None
}

/// A scene at any frequency.
struct Beside<'a>(&'a Scene);

impl Beside<'_> {
    fn scene(&self, at: Vector3<f64>) -> Scene {
        self.0
            .at_frequency(self.0.excitation.frequency * at.z.exp())
    }

    fn residual(&self, at: Vector3<f64>) -> Option<Vector2<f64>> {
        let scene = self.scene(at);
        let shooting = MultiSegmentShooting::new(&scene, 1)?;
        shooting
            .gap(at.x * shooting.span(), at.y.exp())
            .map(Vector2::from)
    }

    fn jacobian(&self, at: Vector3<f64>) -> Option<Matrix2x3<f64>> {
        let mut columns = [Vector2::zeros(); 3];
        for (index, column) in columns.iter_mut().enumerate() {
            let shift = Vector3::ith(index, DIFFERENCE_WIDTH);
            let [ahead, behind] = [at + shift, at - shift].map(|at| self.residual(at));
            *column = (ahead? - behind?) / (2.0 * DIFFERENCE_WIDTH);
        }
        Some(Matrix2x3::from_columns(&columns))
    }

    fn orbit(&self, at: Vector3<f64>) -> Result<Orbit, OrbitError> {
        let scene = self.scene(at);
        let period = scene.clock().period();
        Orbit::by_impacts(
            &scene,
            1,
            &[((at.x * period).rem_euclid(period), at.y.exp())],
        )
    }
}
