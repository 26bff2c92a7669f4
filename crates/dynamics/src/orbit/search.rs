//! The z = 1 motion found from scratch.

use std::slice::from_ref;

use nalgebra::Vector2;

use super::newton::fixed_point_unless;
use super::periodic::STEEP;
use super::returning::{Candidate, Distance, returning};
use super::scan::{FAINTEST, all_single};
use super::{Orbit, OrbitError, Passage, StroboscopicMap};
use crate::watch::{Watcher, unwatched};
use softstop::Scene;
use softstop_lanes::Machine;

/// Drive periods after which Newton's method may take over: few, which finds motions with small basins, and more;
/// and far more if neither finds any.
const SETTLING: [&[u64]; 2] = [&[2, 12], &[60]];
/// Distance, in scales of the motion, within which one state stands for another.
const SAME: f64 = 0.02;
/// Share of what a state moves within a period up to which it stands for another one in the search for an orbit.
const STANDS_FOR: f64 = 0.5;
/// Share of a before-impact velocity by which rounding may change it.
const SAME_SPEED: f64 = 1e-9;

/// The stable z = 1 motion of a scene with the highest before-impact velocity: of those that starts spread over the
/// plane of states lead to, and of those that a lattice of impacts shows.
///
/// # Errors
/// [`OrbitError::NotFound`] if no start leads to one; [`OrbitError::Motion`] if the scene is
/// invalid.
pub fn find(scene: &Scene) -> Result<Orbit, OrbitError> {
    find_watched(scene, &unwatched)
}

/// The same, as long as a watcher, which is not told how much is done, lets it go on.
///
/// # Errors
/// As [`find`]; [`OrbitError::Stopped`].
pub fn find_watched(scene: &Scene, watcher: Watcher<'_>) -> Result<Orbit, OrbitError> {
    let settled = search(from_ref(scene), usize::MAX, watcher).remove(0);
    let mut all = all_single(scene, watcher)?;
    all.retain(Orbit::is_stable);
    match (settled, all.pop()) {
        (Ok(settled), Some(other)) if is_harder(&other, &settled) => Ok(other),
        (Err(OrbitError::NotFound { .. }), Some(other)) => Ok(other),
        (settled, _) => settled,
    }
}

/// True if the impact of one motion is harder, beyond rounding.
fn is_harder(one: &Orbit, other: &Orbit) -> bool {
    let [one, other] = [one, other].map(Orbit::before_impact_velocity);
    one > (1.0 + SAME_SPEED) * other
}

/// The same of many scenes at once, from those motions that come back near to where they were, and only if they lead to
/// none, from all.
///
/// # Errors
/// Each as of [`find`].
pub(crate) fn find_soon(scenes: &[Scene], watcher: Watcher<'_>) -> Vec<Result<Orbit, OrbitError>> {
    search(scenes, 1, watcher)
}

/// The best of all motions that the first groups of states lead to; further groups are tried only as long as there is
/// none. The motions of all scenes are followed together.
fn search(scenes: &[Scene], groups: usize, watcher: Watcher<'_>) -> Vec<Result<Orbit, OrbitError>> {
    let none = |scene: &Scene| OrbitError::NotFound {
        frequency: scene.excitation.frequency,
        clearance: scene.clearance,
    };
    let mut found: Vec<_> = scenes.iter().map(|scene| Err(none(scene))).collect();
    let mut open: Vec<usize> = (0..scenes.len()).collect();
    for settling in SETTLING {
        let mut machines = Vec::with_capacity(open.len());
        open.retain(|&index| match Machine::new(&scenes[index]) {
            Ok(machine) => {
                machines.push(machine);
                true
            }
            Err(error) => {
                found[index] = Err(error.into());
                false
            }
        });
        let all: Vec<&Scene> = open.iter().map(|&index| &scenes[index]).collect();
        let mut candidates = returning(&machines, &all, settling, watcher).into_iter();
        open.retain(|&index| {
            let best = candidates
                .next()
                .map(|of| best(&scenes[index], of, groups, watcher));
            let best = best.unwrap_or(Ok(None)).transpose();
            let is_open = best.is_none();
            if let Some(best) = best {
                found[index] = best;
            }
            is_open
        });
    }
    found
}

/// The hardest of the stable z = 1 motions that states lead to.
fn best(
    scene: &Scene,
    candidates: [Vec<Candidate>; 2],
    groups: usize,
    watcher: Watcher<'_>,
) -> Result<Option<Orbit>, OrbitError> {
    OrbitError::ask(watcher)?;
    let map = StroboscopicMap::new(scene, 1)?;
    let distance = Distance::of(scene);
    let mut known: Vec<Orbit> = Vec::new();
    let mut tried: Vec<Vector2<f64>> = Vec::new();
    let faintest = FAINTEST * scene.motion_scales().speed();
    let is_single =
        |orbit: &Orbit| orbit.impacts.len() == 1 && orbit.before_impact_velocity() > faintest;
    for (group, candidates) in candidates.into_iter().enumerate() {
        if group >= groups && known.iter().any(is_single) {
            break;
        }
        for (moves, state) in candidates {
            OrbitError::ask(watcher)?;
            let near = |state| {
                let is_same = |other: &Orbit| distance.between(other.state(), state) < SAME;
                known.iter().any(is_same)
            };
            let stands =
                |other: &Vector2<f64>| distance.between(*other, state) < STANDS_FOR * moves;
            if !near(state) && !tried.iter().any(stands) {
                tried.push(state);
                known.extend(beside(scene, &map, state, near));
            }
        }
    }
    let single = known.into_iter().filter(is_single);
    Ok(single.max_by(|a, b| {
        let [a, b] = [a, b].map(Orbit::before_impact_velocity);
        a.total_cmp(&b)
    }))
}

/// The stable motion of one drive period that Newton's method reaches from a state near it, unless it comes near one
/// that is known.
fn beside(
    scene: &Scene,
    map: &StroboscopicMap,
    state: Vector2<f64>,
    known: impl Fn(Vector2<f64>) -> bool,
) -> Option<Orbit> {
    let steep = |passage: &Passage| map.scales().jacobian(&passage.monodromy).norm() > STEEP;
    let orbit = match fixed_point_unless(map, state, known) {
        Ok(None) => None,
        Ok(Some((state, passage))) if !steep(&passage) => {
            Orbit::on(scene, map, state, &passage).ok()
        }
        Ok(_) => Orbit::near(scene, state).ok(),
        Err(_) => Orbit::by_guesses(scene, state, 1, 1),
    };
    orbit.filter(|orbit| orbit.periods == 1 && orbit.is_stable())
}
