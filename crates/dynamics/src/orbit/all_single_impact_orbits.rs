//! All motions with one impact per drive period, stable or not, from a lattice of times and velocities of that impact.
//!
//! A motion of z = 1 is known from the time t and the before-impact velocity v of its impact. What the next impact is
//! off by ([`MultiSegmentShooting`]) is smooth in both, so a lattice over one drive period and all velocities that the drive can keep
//! up shows the cells in which it may vanish, and Newton's method from there finds where it does. How small the basin
//! of a motion is plays no part.

use super::free_frequency::find_beside_frequency;
use super::impact_lattice::{guess_impacts_from_lattice, lattice_speeds};
use super::single_impact_search::SingleImpactSearch;
use super::{Orbit, OrbitError, TimedImpact};
use crate::monitor::{Monitor, unmonitored};
use softstop::{CheckedScene, Scene};

/// All z = 1 orbits of a scene, those with the hardest impacts last.
///
/// # Errors
/// [`OrbitError::Motion`] if the scene is none; [`OrbitError::Stopped`].
pub(crate) fn single_impact_orbits(
    scene: &Scene,
    monitor: Monitor<'_>,
) -> Result<Vec<Orbit>, OrbitError> {
    Ok(search_whole_lattice(&scene.check()?, monitor)?.map_or(Vec::new(), |singles| singles.found))
}

/// All z = 1 orbits of a scene, after those that near misses lead to within a share of its frequency.
///
/// # Errors
/// As [`single_impact_orbits`].
pub(crate) fn single_impact_orbits_about_frequency(
    scene: &CheckedScene,
    share: f64,
    monitor: Monitor<'_>,
) -> Result<Vec<Orbit>, OrbitError> {
    let Some(singles) = search_whole_lattice(scene, monitor)? else {
        return Ok(Vec::new());
    };
    let beside = |impact| find_beside_frequency(scene, impact, share);
    let beside = singles.missed.iter().copied().filter_map(beside);
    let mut all: Vec<Orbit> = beside.filter(|orbit| singles.has_impact(orbit)).collect();
    all.extend(singles.found);
    Ok(all)
}

/// The z = 1 orbits that Newton's method leads to from an impact (s, m/s), first to one, then, deflated, to others.
pub(crate) fn single_impact_orbits_near_impact(
    scene: &CheckedScene,
    impact: TimedImpact,
) -> Vec<Orbit> {
    SingleImpactSearch::new(scene).map_or(Vec::new(), |mut singles| {
        singles
            .collect_from_guess(impact, &unmonitored)
            .unwrap_or_default();
        singles.found
    })
}

/// A search for all z = 1 orbits over the impact lattice of a scene; none if the scene has no stop.
fn search_whole_lattice(
    scene: &CheckedScene,
    monitor: Monitor<'_>,
) -> Result<Option<SingleImpactSearch>, OrbitError> {
    OrbitError::ask_monitor(monitor)?;
    let Some(mut singles) = SingleImpactSearch::new(scene) else {
        return Ok(None);
    };
    let lattice = (singles.period, &lattice_speeds(scene)[..]);
    for guess in guess_impacts_from_lattice(&singles.shooting, lattice, monitor)? {
        singles.collect_from_guess(guess, monitor)?;
    }
    singles.found.sort_by(Orbit::compare_velocity);
    Ok(Some(singles))
}
