//! Where the z = 1 motion of a machine begins and ends as the drive's frequency changes.

use nalgebra::Vector2;
use serde::Serialize;

use super::Observation;
use crate::continuation::{Along, BranchPoint, Follower, Heading, Parameter};
use crate::orbit::{Orbit, OrbitError};
use softstop::scene::Scene;

/// Frequencies in rad/s that bound regimes of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// g0: above it the motion without impacts does not reach the clearance.
    pub grazing: Option<f64>,
    /// s_PD: the z = 1 motion, followed down from the scene's frequency, doubles its period.
    pub flip: Option<f64>,
    /// s_SN: the z = 1 motion, followed up from the scene's frequency, ends in a fold.
    pub fold: Option<f64>,
}

/// Points after which a branch is given up.
const LONGEST: usize = 400;
/// How far from the scene's frequency a bound is looked for, as a factor.
const FARTHEST: f64 = 4.0;

/// The bounds of a scene whose settled motion has been observed; those of the z = 1 motion only if it
/// is one.
///
/// # Errors
/// [`OrbitError`] if the branch cannot be begun.
pub fn bounds(scene: &Scene, observed: &Observation) -> Result<Bounds, OrbitError> {
    let is_z1 = observed
        .regime
        .is_some_and(|regime| (regime.impacts, regime.periods) == (1, 1));
    let (flip, fold) = if is_z1 {
        let start = Vector2::new(observed.start.position, observed.start.velocity);
        let orbit = Orbit::near(scene, start)?;
        let fold = along(scene, &orbit, Heading::Up, BranchPoint::fold_test)?;
        let flip = along(scene, &orbit, Heading::Down, flip_test)?;
        (flip, fold)
    } else {
        (None, None)
    };
    Ok(Bounds {
        grazing: grazing(scene),
        flip,
        fold,
    })
}

/// The frequency at which the amplitude of the motion without impacts equals the clearance, above
/// resonance: |F0| = r |k1 - m w^2 + i b1 w|, a quadratic equation in w^2.
fn grazing(scene: &Scene) -> Option<f64> {
    let (m, k, b) = (scene.mass, scene.stiffness, scene.damping);
    let reach = scene.excitation.amplitude / scene.clearance;
    if !(reach.is_finite() && reach > 0.0) {
        return None;
    }
    let half = m * k - 0.5 * b * b;
    let discriminant = half * half - m * m * (k * k - reach * reach);
    let square = (half + discriminant.sqrt()) / (m * m);
    (square > 0.0).then(|| square.sqrt())
}

/// 1 + tr + det: zero at a flip, positive on its stable side.
fn flip_test(point: &BranchPoint) -> f64 {
    1.0 + point.monodromy.trace() + point.monodromy.determinant()
}

/// The first frequency on the branch, up or down, at which a test passes zero; none if
/// the motion loses its stability otherwise, or not at all.
fn along(
    scene: &Scene,
    orbit: &Orbit,
    heading: Heading,
    test: impl Fn(&BranchPoint) -> f64,
) -> Result<Option<f64>, OrbitError> {
    let family = Along::new(scene.clone(), [Parameter::Frequency])?;
    let follower = Follower::new(&family, 1);
    let from = scene.excitation.frequency;
    let branch = follower.follow(orbit, from, heading, LONGEST, |point| {
        let ratio = point.parameter / from;
        !point.is_stable() || !(1.0 / FARTHEST..=FARTHEST).contains(&ratio)
    })?;
    let [.., before, last] = &branch[..] else {
        return Ok(None);
    };
    if test(before) > 0.0 && test(last) <= 0.0 {
        let found = follower.locate(before, last, test)?;
        return Ok(Some(found.parameter));
    }
    Ok(None)
}
