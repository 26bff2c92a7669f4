//! The stable z = 1 motion of a scene at the frequency of its drive, and the zones of scenes.

use super::all_stable_ranges::find_stable_ranges;
use super::hysteresis_zone::{UpperEnd, zones_of};
use super::single_impact_zone::single_impact;
use super::stable_range::StableRange;
use super::{Zone, ZoneError, ZoneKind};
use crate::monitor::{Monitor, unmonitored};
use crate::orbit::{self, Orbit, OrbitError};
use softstop::Scene;

/// The stable z = 1 motion of a scene with the highest before-impact velocity: of those on all
/// [`stable_ranges`](super::stable_ranges()) that hold the frequency of the drive, and of those that a search at that frequency
/// alone finds ([`orbit::find`]).
///
/// # Errors
/// [`OrbitError::NotFound`] if there is none; [`OrbitError::Motion`] if the scene is invalid.
pub fn find(scene: &Scene) -> Result<Orbit, OrbitError> {
    find_with_monitor(scene, &unmonitored)
}

/// The stable z = 1 motion that [`find`] finds, as long as a monitor, which is not told how much is done, lets the search go on.
///
/// # Errors
/// As [`find`]; [`OrbitError::Stopped`].
pub fn find_with_monitor(scene: &Scene, monitor: Monitor<'_>) -> Result<Orbit, OrbitError> {
    let stable_ranges = find_stable_ranges(scene, monitor)?.ranges;
    find_among(scene, &stable_ranges, monitor)
}

/// The stable z = 1 motion that [`find`] finds, where the stable ranges of the scene are known already.
///
/// # Errors
/// As [`find_with_monitor`].
pub fn find_among(
    scene: &Scene,
    stable_ranges: &[StableRange],
    monitor: Monitor<'_>,
) -> Result<Orbit, OrbitError> {
    let here = orbit::find_with_monitor(scene, monitor);
    let on = stable_ranges
        .iter()
        .filter_map(|one| one.orbit_at(scene)?.resolved().ok());
    match (here, on.max_by(Orbit::compare_velocity)) {
        (Ok(here), Some(other)) if other.is_harder(&here) => Ok(other),
        (Err(OrbitError::NotFound { .. }), Some(other)) => Ok(other),
        (here, _) => here,
    }
}

/// The zones of one kind of some scenes; the frequency of their drives plays no part. A zone of [`ZoneKind::Hysteresis`] may also
/// end above in the grazing of a surface beyond the clearance, as of a rigid stop behind the other, and not only in a fold.
///
/// # Errors
/// Each as [`hysteresis_batch`](super::hysteresis_batch) or [`single_impact`].
pub fn find_zones(
    kind: ZoneKind,
    scenes: &[Scene],
    monitor: Monitor<'_>,
) -> Vec<Result<Zone, ZoneError>> {
    match kind {
        ZoneKind::Hysteresis => zones_of(scenes, UpperEnd::FoldOrGrazing, monitor),
        ZoneKind::SingleImpact { between } => single_impact(scenes, between, monitor),
    }
}
