//! Single-impact zones: all stable z = 1 motions on one branch, below g0 as well.

use super::all_stable_ranges::FOLLOWED_RANGE;
use super::end_of_followed_branch::{LONGEST_BRANCH, find_end};
use super::hysteresis_zone::follow_upward;
use super::{FrequencyFamily, Zone, ZoneError, ZoneKind, grazing_frequencies, refuse_below};
use crate::continuation::{BranchPoint, Continuation, Direction};
use crate::monitor::{Monitor, stop_if};
use crate::orbit::{Orbit, OrbitError, harder_single_impact_orbit};
use crate::parallel;
use crate::tolerance::SAME;
use softstop::{CheckedScene, Scene};

/// Number of frequencies besides the grazing frequency g0 of the impact-less motion at which single-impact motions are searched
/// to begin a zone with.
const START_FREQUENCIES: usize = 6;

/// The single-impact zones of some scenes: ranges of stable z = 1; the frequency of their drives plays no part. Each reaches both
/// ways from the hardest z = 1 motion that is found at g0 and at some frequencies `between` two, in rad/s, until the motion loses
/// its stability or another impact comes up: above, over a fold to the fold at the highest frequency.
///
/// # Errors
/// Each a [`ZoneError`]: [`ZoneError::NoMotion`] if there is no such motion at these frequencies.
pub fn single_impact(
    scenes: &[Scene],
    between: (f64, f64),
    monitor: Monitor<'_>,
) -> Vec<Result<Zone, ZoneError>> {
    parallel::map(scenes, |scene| zone_of_scene(scene, between, monitor))
}

/// The single-impact zone of one scene: of the zones found the one whose motions between the two frequencies are hardest.
fn zone_of_scene(
    scene: &Scene,
    between: (f64, f64),
    monitor: Monitor<'_>,
) -> Result<Zone, ZoneError> {
    let scene = &scene.check()?;
    refuse_below(scene)?;
    let mut zones: Vec<Zone> = Vec::new();
    for frequency in start_frequencies(scene, between) {
        let known = zones
            .iter()
            .filter_map(|zone| zone.point_at(zone.place_of(frequency)).ok());
        let known = known.map(|point| point.before_impact_velocity());
        let least = (1.0 + SAME) * known.fold(0.0, f64::max);
        if let Some(start) = harder_single_impact_orbit(
            &scene.recheck(scene.at_frequency(frequency))?,
            least,
            monitor,
        )? {
            zones.extend(zone_about(scene, &start, between, monitor).ok().flatten());
        }
        OrbitError::ask_monitor(monitor)?;
    }
    let hardest = zones.into_iter().filter_map(|zone| {
        let velocity = hardest_between(&zone, between)?;
        Some((zone, velocity))
    });
    let best = hardest.max_by(|a, b| a.1.total_cmp(&b.1));
    let (from, to) = between;
    let none = ZoneError::NoMotion {
        from: from.into(),
        to: to.into(),
    };
    best.map(|(zone, _)| zone).ok_or(none)
}

/// The highest before-impact velocity of a zone's stable motions between two frequencies; none if the zone lies outside.
fn hardest_between(zone: &Zone, (low, high): (f64, f64)) -> Option<f64> {
    let inside = zone.branch.iter();
    let inside = inside.filter(|it| it.is_stable() && (low..=high).contains(&it.parameter));
    let at_ends = [low, high].map(|at| zone.point_at(zone.place_of(at)).ok());
    let all = inside.chain(at_ends.iter().flatten());
    all.map(BranchPoint::before_impact_velocity)
        .max_by(f64::total_cmp)
}

/// The frequencies in rad/s at which single-impact motions of a scene are searched: the upper grazing frequency g0 of the
/// impact-less motion, and some evenly spaced in ratio in the range `between`, clipped to the followed range.
fn start_frequencies(scene: &Scene, between: (f64, f64)) -> Vec<f64> {
    let rate = scene.scales().rate;
    let (low, high) = (
        between.0.max(FOLLOWED_RANGE.0 * rate),
        between.1.min(0.5 * FOLLOWED_RANGE.1 * rate),
    );
    // A range above all that is looked at, or one frequency, is looked at as it is.
    let (low, high) = if low < high {
        (low, high)
    } else {
        (between.0, between.0)
    };
    let g0 = grazing_frequencies(scene).map(|(_, above)| above);
    let count = if low < high { START_FREQUENCIES } else { 1 };
    let inside =
        (0..count).map(|index| low * (high / low).powf((index as f64 + 0.5) / count as f64));
    g0.into_iter().chain(inside).collect()
}

/// The single-impact zone about a z = 1 motion, followed up and down from it; none if it has no width.
fn zone_about(
    scene: &CheckedScene,
    start: &Orbit,
    between: (f64, f64),
    monitor: Monitor<'_>,
) -> Result<Option<Zone>, ZoneError> {
    let frequency = start.scene.excitation.frequency;
    let rate = scene.scales().rate;
    let range = (FOLLOWED_RANGE.0 * rate, FOLLOWED_RANGE.1 * rate);
    let family = FrequencyFamily(scene);
    let continuation = Continuation::new(&family, 1);
    let (mut above, fold) = follow_upward(&continuation, start, (frequency, range.1), monitor)?;
    let high = match fold {
        Some(fold) => fold,
        None => find_end(&continuation, &mut above, Direction::Up, range)?,
    };
    let mut branch =
        continuation.follow_points(start, frequency, Direction::Down, LONGEST_BRANCH, |point| {
            let ends = !point.is_stable() || point.parameter < range.0;
            stop_if(ends || monitor(0, 0).is_break())
        })?;
    OrbitError::ask_monitor(monitor)?;
    let low = find_end(&continuation, &mut branch, Direction::Down, range)?;
    branch.reverse();
    branch.extend(above.into_iter().skip(1));
    let (frequency_g0_below, frequency_g0) = match grazing_frequencies(scene) {
        Ok((below, above)) => (below, above),
        Err(_) if scene.clearance > 0.0 => (None, 0.0),
        Err(_) => (None, f64::INFINITY),
    };
    let zone = Zone {
        kind: ZoneKind::SingleImpact { between },
        range: None,
        scene: scene.clone(),
        frequency_g0_below,
        frequency_g0,
        low,
        high,
        branch,
    };
    Ok((zone.frequency_width() > 0.0).then_some(zone))
}
