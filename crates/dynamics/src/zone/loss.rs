//! Where a motion loses its stability as the drive's frequency, or another parameter, changes.

use super::Frequencies;
use crate::continuation::{BranchPoint, Family, Follower, Heading, Test};
use crate::orbit::{Orbit, OrbitError};
use crate::watch::stop_if;

/// Points after which a branch is given up.
const LONGEST: usize = 400;
/// How far from the orbit's own value a loss is looked for, as a factor.
const FARTHEST: f64 = 4.0;

/// The first orbit, up or down from a stable z = 1 orbit, at which a test passes zero: s_SN by
/// [`Test::Fold`], s_PD by [`Test::Flip`]. None if stability is lost otherwise, or not at all.
///
/// # Errors
/// [`OrbitError`] if the branch cannot be begun.
pub fn loss_of_stability(
    orbit: &Orbit,
    heading: Heading,
    test: Test,
) -> Result<Option<BranchPoint>, OrbitError> {
    let from = orbit.scene.excitation.frequency;
    loss_along(&Frequencies(&orbit.scene), from, orbit, heading, test)
}

/// The same along the parameter of any family, of which the orbit has the value `from`.
///
/// # Errors
/// As [`loss_of_stability`].
pub fn loss_along<F: Family>(
    family: &F,
    from: f64,
    orbit: &Orbit,
    heading: Heading,
    test: Test,
) -> Result<Option<BranchPoint>, OrbitError> {
    let follower = Follower::new(family, 1);
    let branch = follower.follow(orbit, from, heading, LONGEST, |point| {
        let ratio = point.parameter / from;
        stop_if(!point.is_stable() || !(1.0 / FARTHEST..=FARTHEST).contains(&ratio))
    })?;
    let value = |point: &BranchPoint| test.value(&point.monodromy);
    match &branch[..] {
        [.., before, last] if value(before) > 0.0 && value(last) <= 0.0 => {
            follower.critical_between(before, last, test).map(Some)
        }
        _ => Ok(None),
    }
}
