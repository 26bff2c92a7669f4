//! The z = 1 motion found from scratch.

use std::slice::from_ref;

use nalgebra::{Matrix2, Vector2};

use super::newton::fixed_point_unless;
use super::periodic::STEEP;
use super::returning::{Candidate, Distance, returning};
use super::scan::{FAINTEST, all_single};
use super::{Monodromy, Orbit, OrbitError, Passage, StroboscopicMap};
use crate::watch::{Watcher, unwatched};
use softstop::Scene;
use softstop_lanes::Machine;

/// Drive periods after which Newton's method may take over: few, which finds motions with small basins, and more;
/// and far more if neither finds any.
const SETTLING: [&[u64]; 2] = [&[2, 12], &[60]];
/// Distance, in scales of the motion, within which a state stands for a stable motion, and for an unstable one, which a
/// stable one may be near to.
const SAME: f64 = 0.02;
const SAME_UNSTABLE: f64 = 1e-3;
/// Share of what a state moves within a period up to which it stands for another one in the search for an orbit.
const STANDS_FOR: f64 = 0.5;
/// Share of a before-impact velocity by which rounding may change it.
const SAME_SPEED: f64 = 1e-9;

/// The stable z = 1 motion of a scene with the highest before-impact velocity: of those that starts spread over the
/// plane of states lead to, and of those that a lattice of impacts shows. Motions of narrow stretches of frequency may
/// show in neither: [`zone::find`](crate::zone::find) looks at all frequencies, too.
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
        (Ok(settled), Some(other)) if other.is_harder(&settled) => Ok(other),
        (Err(OrbitError::NotFound { .. }), Some(other)) => Ok(other),
        (settled, _) => settled,
    }
}

impl Orbit {
    /// True if its impact is harder than that of another one, beyond rounding.
    pub(crate) fn is_harder(&self, other: &Self) -> bool {
        self.before_impact_velocity() > (1.0 + SAME_SPEED) * other.before_impact_velocity()
    }
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
    let mut met = Met {
        scene,
        map: StroboscopicMap::new(scene, 1)?,
        distance: Distance::of(scene),
        all: Vec::new(),
        stable: Vec::new(),
    };
    let mut tried: Vec<Vector2<f64>> = Vec::new();
    let faintest = FAINTEST * scene.motion_scales().speed();
    let is_single =
        |orbit: &Orbit| orbit.impacts.len() == 1 && orbit.before_impact_velocity() > faintest;
    for (group, candidates) in candidates.into_iter().enumerate() {
        if group >= groups && met.stable.iter().any(is_single) {
            break;
        }
        for candidate in candidates {
            OrbitError::ask(watcher)?;
            let Candidate { moves, state, .. } = candidate;
            let stands =
                |other: &Vector2<f64>| met.distance.between(*other, state) < STANDS_FOR * moves;
            if !met.is_near(state) && !tried.iter().any(stands) && !met.leads_to(&candidate) {
                tried.push(state);
                met.look(state);
            }
        }
    }
    let single = met.stable.into_iter().filter(is_single);
    Ok(single.max_by(|a, b| {
        let [a, b] = [a, b].map(Orbit::before_impact_velocity);
        a.total_cmp(&b)
    }))
}

/// The motions of one drive period that were met.
struct Met<'a> {
    scene: &'a Scene,
    map: StroboscopicMap,
    distance: Distance,
    /// All of them.
    all: Vec<Fixed>,
    stable: Vec<Orbit>,
}

/// A fixed point of the map.
struct Fixed {
    state: Vector2<f64>,
    /// What leads to it from a state, times what that moves: Newton's method with the Jacobian of the fixed point.
    lead: Option<Matrix2<f64>>,
    /// Distance within which another state stands for it.
    reach: f64,
}

impl Fixed {
    fn new(state: Vector2<f64>, monodromy: Monodromy) -> Self {
        Self {
            state,
            lead: monodromy.resolvent(),
            reach: if monodromy.is_stable() {
                SAME
            } else {
                SAME_UNSTABLE
            },
        }
    }
}

impl Met<'_> {
    fn is_near(&self, state: Vector2<f64>) -> bool {
        let mut all = self.all.iter();
        all.any(|other| self.distance.between(other.state, state) < other.reach)
    }

    /// True if a candidate has moved as the Jacobian of one of them has it near that one.
    fn leads_to(&self, candidate: &Candidate) -> bool {
        let moved = candidate.state - candidate.before;
        self.all.iter().any(|other| {
            let off = |lead| {
                let there = candidate.before + lead * moved;
                self.distance.between(there, other.state)
            };
            other.lead.is_some_and(|lead| off(lead) < other.reach)
        })
    }

    /// Newton's method from a state, unless it comes near a motion that was met.
    fn look(&mut self, state: Vector2<f64>) {
        let found = fixed_point_unless(&self.map, state, |state| self.is_near(state));
        let steepness = |passage: &Passage| self.map.scales().jacobian(&passage.monodromy).norm();
        let orbit = match found {
            Ok(None) => return,
            Ok(Some((state, passage))) if steepness(&passage) <= STEEP => {
                self.all.push(Fixed::new(state, passage.monodromy));
                if !passage.monodromy.is_stable() {
                    return;
                }
                let orbit = Orbit::on(self.scene, &self.map, state, &passage);
                self.stable.extend(orbit);
                return;
            }
            Ok(_) => Orbit::near(self.scene, state).ok(),
            Err(_) => Orbit::by_guesses(self.scene, state, 1, 1),
        };
        if let Some(orbit) = orbit.filter(|orbit| orbit.periods == 1) {
            self.all.push(Fixed::new(orbit.state(), orbit.monodromy));
            self.stable.extend(orbit.is_stable().then_some(orbit));
        }
    }
}
