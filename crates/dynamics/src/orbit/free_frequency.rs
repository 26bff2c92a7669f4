//! z = 1 orbits with their frequency free, beside a given one: narrow isolas lie between two frequencies of any row.

use nalgebra::{Matrix2x3, Vector2, Vector3};

use super::multi_segment_shooting::MultiSegmentShooting;
use super::{Orbit, OrbitError, TimedImpact};
use crate::tolerance::DIFFERENCE_WIDTH;
use softstop::{CheckedScene, SceneError};

/// Newton steps for an orbit with free frequency before giving up.
const MAX_STEPS: usize = 20;
/// Largest Newton step in time (drive periods), ln velocity and ln frequency.
const MAX_STEP: [f64; 3] = [0.1, 0.3, 0.02];

/// The z = 1 orbit nearest to an impact of which little is missing, with its frequency free: steps of least norm
/// (Gauss and Newton) in the time of the impact in drive periods and the logarithms of its velocity and of the frequency.
/// Where they settle, in a fold as well, the system is regular. None beyond a share of the scene's frequency.
pub(super) fn find_beside_frequency(
    scene: &CheckedScene,
    (time, velocity): TimedImpact,
    share: f64,
) -> Option<Orbit> {
    let beside = FreeFrequency(scene);
    let mut at = Vector3::new(time / scene.clock().period(), velocity.ln(), 0.0);
    let mut here = beside.shooting_at(at)?;
    let mut residual = return_residual(&here, at)?;
    for _ in 0..MAX_STEPS {
        let jacobian = beside.residual_jacobian(&here, at)?;
        let square = jacobian * jacobian.transpose();
        let step = -(jacobian.transpose() * square.lu().solve(&residual)?);
        let excess = step
            .iter()
            .zip(MAX_STEP)
            .map(|(part, most)| part.abs() / most);
        let next = at + step / excess.fold(1.0, f64::max);
        if next.z.abs() > share {
            return None;
        }
        here = beside.shooting_at(next)?;
        let left = return_residual(&here, next)?;
        let settles = left.norm() >= 0.1 * residual.norm() && residual.norm() < DIFFERENCE_WIDTH;
        (at, residual) = (next, left);
        if settles {
            return beside.orbit_at(at).ok();
        }
    }
    None
}

/// A scene with its frequency free: unknowns are impact time (periods), ln velocity, ln frequency ratio.
struct FreeFrequency<'a>(&'a CheckedScene);

impl FreeFrequency<'_> {
    /// The scene at the frequency of these unknowns.
    fn scene_at(&self, at: Vector3<f64>) -> Result<CheckedScene, SceneError> {
        let frequency = self.0.excitation.frequency * at.z.exp();
        self.0.recheck(self.0.at_frequency(frequency))
    }

    /// The shooting at the frequency that the third unknown is, ln(w/w0); none if the scene is none there.
    fn shooting_at(&self, at: Vector3<f64>) -> Option<MultiSegmentShooting> {
        MultiSegmentShooting::new(&self.scene_at(at).ok()?, 1)
    }

    /// Derivatives by the unknowns, by central differences, of the residual at the next impact; `here` is the shooting for the
    /// scene of these unknowns.
    fn residual_jacobian(
        &self,
        here: &MultiSegmentShooting,
        at: Vector3<f64>,
    ) -> Option<Matrix2x3<f64>> {
        let mut columns = [Vector2::zeros(); 3];
        for (index, column) in columns.iter_mut().enumerate() {
            let shift = Vector3::ith(index, DIFFERENCE_WIDTH);
            let residual = |at: Vector3<f64>| match index {
                2 => return_residual(&self.shooting_at(at)?, at),
                _ => return_residual(here, at),
            };
            *column = (residual(at + shift)? - residual(at - shift)?) / (2.0 * DIFFERENCE_WIDTH);
        }
        Some(Matrix2x3::from_columns(&columns))
    }

    /// The z = 1 orbit at the frequency and from the impact of these unknowns.
    fn orbit_at(&self, at: Vector3<f64>) -> Result<Orbit, OrbitError> {
        let scene = self.scene_at(at)?;
        let period = scene.clock().period();
        Orbit::find_by_impacts(
            &scene,
            1,
            &[((at.x * period).rem_euclid(period), at.y.exp())],
        )
    }
}

/// What the next impact is off by for these unknowns, by the shooting at their frequency: position and velocity, scaled.
fn return_residual(shooting: &MultiSegmentShooting, at: Vector3<f64>) -> Option<Vector2<f64>> {
    let gap = shooting.return_gap(at.x * shooting.span(), at.y.exp());
    gap.map(Vector2::from)
}
