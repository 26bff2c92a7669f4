//! Loss of stability of a motion as the drive's frequency, or another parameter, changes, and the bounds of z = 1.

use serde::Serialize;

use super::{FrequencyFamily, grazing_frequencies};
use crate::continuation::{BranchPoint, Continuation, Direction, Family, TestFunction};
use crate::monitor::stop_if;
use crate::orbit::{Orbit, OrbitError};
use softstop::{Scene, Start};

/// Most points of a branch that is followed for a loss of stability; after these it is given up.
const MAX_LOSS_POINTS: usize = 400;
/// Largest factor, up or down from the orbit's own value of the parameter, within which a loss of stability is searched.
const MAX_LOSS_FACTOR: f64 = 4.0;

/// The first orbit, up or down in frequency from a stable z = 1 orbit, at which a test function passes zero: s_SN by
/// [`TestFunction::Fold`], s_PD by [`TestFunction::Flip`]. None if stability is lost otherwise, or not at all.
///
/// # Errors
/// [`OrbitError`] if the branch cannot be begun.
pub fn loss_of_stability(
    orbit: &Orbit,
    direction: Direction,
    test: TestFunction,
) -> Result<Option<BranchPoint>, OrbitError> {
    let from = orbit.scene.excitation.frequency;
    let family = FrequencyFamily(&orbit.scene);
    let continuation = Continuation::new(&family, 1);
    let branch = follow_stable(&continuation, (from, MAX_LOSS_FACTOR), orbit, direction)?;
    let found = locate_loss(&continuation, &branch, test)?;
    // At a grazing the test jumps over zero.
    Ok(found.filter(|point| !test.jumps_at(&point.monodromy)))
}

/// Finds the value of a family's parameter at which a stable orbit, which has the value `from`, loses its stability: where the
/// test function passes zero, or else the last value up to which the orbit could be followed. None if it stays stable up to `reach`,
/// the largest factor, up or down from the orbit's own value, within which it is followed.
///
/// # Errors
/// As [`loss_of_stability`].
pub fn find_end_along(
    family: &dyn Family,
    (from, reach): (f64, f64),
    orbit: &Orbit,
    direction: Direction,
    test: TestFunction,
) -> Result<Option<f64>, OrbitError> {
    let continuation = Continuation::new(family, 1);
    let branch = follow_stable(&continuation, (from, reach), orbit, direction)?;
    if let Some(lost) = locate_loss(&continuation, &branch, test)? {
        return Ok(Some(lost.parameter));
    }
    let last = branch
        .last()
        .filter(|point| is_in_reach(point, (from, reach)));
    Ok(last.map(|point| point.parameter))
}

/// True if the parameter at a point lies within a factor `reach` of the orbit's own value.
fn is_in_reach(point: &BranchPoint, (from, reach): (f64, f64)) -> bool {
    (1.0 / reach..=reach).contains(&(point.parameter / from))
}

/// Follows the branch of an orbit as long as it is stable, to the first unstable point.
fn follow_stable(
    continuation: &Continuation<'_>,
    (from, reach): (f64, f64),
    orbit: &Orbit,
    direction: Direction,
) -> Result<Vec<BranchPoint>, OrbitError> {
    continuation.follow_points(orbit, from, direction, MAX_LOSS_POINTS, |point| {
        stop_if(!point.is_stable() || !is_in_reach(point, (from, reach)))
    })
}

/// Locates where a test function passes zero, or jumps over it, between the last two points of a branch; none if it does not.
fn locate_loss(
    continuation: &Continuation<'_>,
    branch: &[BranchPoint],
    test: TestFunction,
) -> Result<Option<BranchPoint>, OrbitError> {
    let value = |point: &BranchPoint| test.scaled_value(&point.monodromy);
    match branch {
        [.., before, last] if value(before) > 0.0 && value(last) <= 0.0 => {
            continuation.critical_between(before, last, test).map(Some)
        }
        _ => Ok(None),
    }
}

/// Frequencies in rad/s that bound the z = 1 motion of a machine: grazing g0, flip s_PD, fold s_SN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StabilityBounds {
    /// g0: above it the motion without impacts does not reach the clearance.
    pub grazing: Option<f64>,
    /// s_PD: the z = 1 motion, followed down from the scene's frequency, doubles its period.
    pub flip: Option<f64>,
    /// s_SN: the z = 1 motion, followed up from the scene's frequency, ends in a fold.
    pub fold: Option<f64>,
}

impl StabilityBounds {
    /// The frequencies that bound the z = 1 motion of a scene; flip and fold only if a state near that motion is given.
    ///
    /// # Errors
    /// [`OrbitError`] if the branch cannot be begun.
    pub fn of_scene(scene: &Scene, near: Option<Start>) -> Result<Self, OrbitError> {
        let grazing = grazing_frequencies(scene).ok().map(|(_, above)| above);
        let orbit = near.map(|start| Orbit::find_near(scene, start.into()));
        let orbit = orbit.transpose()?;
        let bound = |heading, test| match &orbit {
            Some(orbit) => loss_of_stability(orbit, heading, test),
            None => Ok(None),
        };
        Ok(Self {
            grazing,
            flip: bound(Direction::Down, TestFunction::Flip)?.map(|point| point.parameter),
            fold: bound(Direction::Up, TestFunction::Fold)?.map(|point| point.parameter),
        })
    }
}
