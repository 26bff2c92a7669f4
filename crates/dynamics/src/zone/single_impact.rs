//! All stable z = 1 motions on one branch, below g0 as well.

use rayon::prelude::*;

use super::end::{EndKind, Loss, ZoneEnd, first_end};
use super::hysteresis::{LONGEST_BRANCH, highest_fold, upward};
use super::places::{Zone, ZoneKind};
use super::stretches::FOLLOWED;
use super::{Frequencies, ZoneError, grazing_frequencies};
use crate::continuation::{BranchPoint, Follower, Heading, Limits, SpecialKind, Test};
use crate::orbit::{Orbit, OrbitError, hardest_single};
use crate::watch::{Watcher, stop_if};
use softstop::Scene;
use softstop::internals::budget::Fork;

/// Frequencies beside g0 at which motions are looked for.
const STARTS: usize = 6;
/// Highest frequency, in units of the natural one, at which they are looked for.
const HIGHEST: f64 = 4.0;

/// Share by which rounding may change a before-impact velocity.
const SAME: f64 = 1e-6;

/// The ranges of stable z = 1 of some scenes; the frequency of their drives plays no part. Each reaches both ways from the
/// hardest of the z = 1 motions at g0 and at some frequencies between two, in rad/s, until the motion loses its stability
/// or another impact comes up: above, over a fold to the fold at the highest frequency.
///
/// # Errors
/// Each a [`ZoneError`]: [`ZoneError::NoMotion`] if there is no such motion at these frequencies.
pub fn single_impact(
    scenes: &[Scene],
    between: (f64, f64),
    watcher: Watcher<'_>,
) -> Vec<Result<Zone, ZoneError>> {
    let fork = Fork::default();
    let zones = scenes.par_iter();
    let zones = zones.map(|scene| fork.part(|| of_scene(scene, between, watcher)));
    let zones = zones.collect();
    fork.join();
    zones
}

/// The range of one scene.
fn of_scene(scene: &Scene, between: (f64, f64), watcher: Watcher<'_>) -> Result<Zone, ZoneError> {
    scene.validate()?;
    let mut zones: Vec<Zone> = Vec::new();
    for frequency in starts(scene, between) {
        let known = zones
            .iter()
            .filter_map(|zone| zone.point_at(zone.place_of(frequency)).ok());
        let known = known.map(|point| point.before_impact_velocity());
        let least = (1.0 + SAME) * known.fold(0.0, f64::max);
        if let Some(start) = hardest_single(&scene.at_frequency(frequency), least, watcher)? {
            zones.extend(about(scene, &start, between, watcher).ok().flatten());
        }
        OrbitError::ask(watcher)?;
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

/// The highest velocity at the points of a zone between two frequencies, and at these; none if it lies outside.
fn hardest_between(zone: &Zone, (low, high): (f64, f64)) -> Option<f64> {
    let inside = zone.branch.iter();
    let inside = inside.filter(|it| it.is_stable() && (low..=high).contains(&it.parameter));
    let at_ends = [low, high].map(|at| zone.point_at(zone.place_of(at)).ok());
    let all = inside.chain(at_ends.iter().flatten());
    all.map(BranchPoint::before_impact_velocity)
        .max_by(f64::total_cmp)
}

/// The frequencies at which a scene's motions are looked for: g0, and some evenly spaced in ratio.
fn starts(scene: &Scene, between: (f64, f64)) -> Vec<f64> {
    let rate = scene.scales().rate;
    let (low, high) = (
        between.0.max(FOLLOWED.0 * rate),
        between.1.min(HIGHEST * rate),
    );
    // A range above all that is looked at, or one frequency, is looked at as it is.
    let (low, high) = if low < high {
        (low, high)
    } else {
        (between.0, between.0)
    };
    let g0 = grazing_frequencies(scene).map(|(_, above)| above);
    let count = if low < high { STARTS } else { 1 };
    let inside =
        (0..count).map(|index| low * (high / low).powf((index as f64 + 0.5) / count as f64));
    g0.into_iter().chain(inside).collect()
}

/// The range about a motion; none if it has no width.
fn about(
    scene: &Scene,
    start: &Orbit,
    between: (f64, f64),
    watcher: Watcher<'_>,
) -> Result<Option<Zone>, ZoneError> {
    let frequency = start.scene.excitation.frequency;
    let rate = scene.scales().rate;
    let range = (FOLLOWED.0 * rate, FOLLOWED.1 * rate);
    let family = Frequencies(scene);
    let follower = Follower::new(&family, 1);
    let mut above = upward(&follower, start, (frequency, range.1), watcher)?;
    let high = match highest_fold(&above) {
        Some(fold) => fold,
        None => ended(&follower, &mut above, Heading::Up, range)?,
    };
    let mut branch = follower.follow(start, frequency, Heading::Down, LONGEST_BRANCH, |point| {
        let ends = !point.is_stable() || point.parameter < range.0;
        stop_if(ends || watcher(0, 0).is_break())
    })?;
    OrbitError::ask(watcher)?;
    let low = ended(&follower, &mut branch, Heading::Down, range)?;
    branch.reverse();
    branch.extend(above.into_iter().skip(1));
    let (frequency_g0_below, frequency_g0) = match grazing_frequencies(scene) {
        Ok((below, above)) => (below, above),
        Err(_) if scene.clearance > 0.0 => (None, 0.0),
        Err(_) => (None, f64::INFINITY),
    };
    let zone = Zone {
        kind: ZoneKind::SingleImpact { between },
        scene: scene.clone(),
        frequency_g0_below,
        frequency_g0,
        low,
        high,
        branch,
    };
    Ok((zone.width() > 0.0).then_some(zone))
}

/// Where stable motions end that were followed from the first of these points on; the last point is then there.
fn ended(
    follower: &Follower<'_, Frequencies<'_>>,
    points: &mut Vec<BranchPoint>,
    heading: Heading,
    range: (f64, f64),
) -> Result<ZoneEnd, OrbitError> {
    let is_beyond =
        |point: &BranchPoint| !point.is_stable() || !(range.0..=range.1).contains(&point.parameter);
    let first = points.iter().position(is_beyond).unwrap_or(points.len());
    let beyond = points.drain(first..).next();
    if let (Some(before), Some(beyond)) = (points.last(), beyond) {
        let (point, kind) = match Test::ALL
            .into_iter()
            .find(|test| test.value(&beyond.monodromy) <= 0.0)
        {
            Some(test) => {
                let kind = EndKind::Special(SpecialKind::Critical(test));
                (follower.critical_between(before, &beyond, test), kind)
            }
            None => {
                let bound = beyond.parameter.clamp(range.0, range.1);
                (
                    follower.between(before, &beyond, bound),
                    EndKind::Other(Loss::Range),
                )
            }
        };
        if let Ok(point) = point {
            points.push(point.clone());
            return Ok(ZoneEnd::at(&point, kind));
        }
    }
    followed_to_end(follower, points, heading, range)
}

/// The end by a look at every special point, from the last point on, or from the first one if there is nothing to see
/// from the last.
fn followed_to_end(
    follower: &Follower<'_, Frequencies<'_>>,
    points: &mut Vec<BranchPoint>,
    heading: Heading,
    range: (f64, f64),
) -> Result<ZoneEnd, OrbitError> {
    let last = points.len().checked_sub(1).ok_or(OrbitError::NotIsolated)?;
    let from = |index: usize| {
        let start = &points[index];
        let limits = Limits {
            range: match heading {
                Heading::Up => (start.parameter, range.1),
                Heading::Down => (range.0, start.parameter),
            },
            points: LONGEST_BRANCH,
        };
        let branch = follower.branch(start.parameter, start.state(), &limits, |point| {
            stop_if(!point.is_stable() || point.impacts.len() != 1)
        });
        branch.map(|branch| (index, branch))
    };
    let (index, mut branch) = from(last).or_else(|_| from(0))?;
    points.truncate(index + 1);
    let start = points[index].parameter;
    if heading == Heading::Down {
        branch.points.reverse();
    }
    let further = branch
        .points
        .iter()
        .filter(|point| point.parameter != start);
    if let Some((point, kind)) = first_end(&branch, further.clone()) {
        let until = further.take_while(|it| it.parameter != point.parameter);
        points.extend(until.chain([point]).cloned());
        return Ok(ZoneEnd::at(point, kind));
    }
    points.extend(further.filter(|point| point.is_stable()).cloned());
    let end = match heading {
        Heading::Up => &branch.ends.1,
        Heading::Down => &branch.ends.0,
    };
    let kind = EndKind::Other(Loss::of(end));
    let last = points.last().ok_or(OrbitError::NotIsolated)?;
    Ok(ZoneEnd::at(last, kind))
}
