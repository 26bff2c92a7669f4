//! The stable z = 1 motion of a scene, searched from scratch: from many starts, and from a lattice of impacts.

use std::slice::from_ref;

use nalgebra::{Matrix2, Vector2};

use super::impact_lattice::all_single;
use super::stroboscopic_map::find_new_fixed_point;
use super::trials::{
    Candidate, NEAR_RETURN, Trial, Trials, least_moved, scaled_distance, settled_candidates,
};
use super::{Monodromy, Orbit, OrbitError, Passage, StroboscopicMap};
use crate::monitor::{Monitor, unmonitored};
use crate::tolerance::{NEAR, SAME, STABLE_REACH};
use softstop::internals::Scales;
use softstop::{CheckedScene, Scene};
use softstop_lanes::Machine;

/// Stages of the search: drive periods after which Newton's method takes over from where motions have moved least, and
/// those after which it then takes over from all: few for small basins, and far more if none is found.
const SEARCH_STAGES: [(u64, &[u64]); 3] = [(4, &[]), (12, &[2, 12]), (60, &[60])];

/// The stable z = 1 motion of a scene with the highest before-impact velocity: of those that starts spread over the
/// plane of states lead to, and of those that a lattice of impacts shows. Motions of narrow stretches of frequency may
/// show in neither: [`zone::find`](crate::zone::find) looks at all frequencies, too.
///
/// # Errors
/// [`OrbitError::NotFound`] if no start leads to one; [`OrbitError::Motion`] if the scene is invalid.
pub fn find(scene: &Scene) -> Result<Orbit, OrbitError> {
    find_with_monitor(scene, &unmonitored)
}

/// The stable z = 1 motion that [`find`] finds, as long as a monitor, which sees no progress, goes on.
///
/// # Errors
/// As [`find`]; [`OrbitError::Stopped`].
pub fn find_with_monitor(scene: &Scene, monitor: Monitor<'_>) -> Result<Orbit, OrbitError> {
    find_with_singles(scene, None, monitor)
}

/// The motion that [`find_with_monitor`] finds, with the z = 1 orbits that a lattice shows, those with the hardest impacts
/// last, searched unless they are known.
pub(crate) fn find_with_singles(
    scene: &Scene,
    known: Option<Vec<Orbit>>,
    monitor: Monitor<'_>,
) -> Result<Orbit, OrbitError> {
    let settled = search_all(from_ref(scene), usize::MAX, monitor).remove(0);
    let mut all = match known {
        Some(known) => known,
        None => all_single(scene, monitor)?,
    };
    all.retain(Orbit::is_stable);
    match (settled, all.pop()) {
        (Ok(settled), Some(other)) if other.is_harder(&settled) => Ok(other),
        (Err(OrbitError::NotFound { .. }), Some(other)) => Ok(other),
        (settled, _) => settled,
    }
}

/// The stable z = 1 motion that [`find`] finds of each of many scenes at once, from few candidates if they suffice.
///
/// # Errors
/// Each as of [`find`].
pub(crate) fn find_batch(scenes: &[Scene], monitor: Monitor<'_>) -> Vec<Result<Orbit, OrbitError>> {
    search_all(scenes, 1, monitor)
}

/// Searches the hardest stable z = 1 motion of each scene among all that the first groups of states lead to, and
/// further groups as long as there is none. Motions of all scenes go together, until they lead to a stable one.
fn search_all(
    scenes: &[Scene],
    groups: usize,
    monitor: Monitor<'_>,
) -> Vec<Result<Orbit, OrbitError>> {
    let none = |scene: &Scene| OrbitError::NotFound {
        frequency: scene.excitation.frequency,
        clearance: scene.clearance,
    };
    let mut found: Vec<_> = scenes.iter().map(|scene| Err(none(scene))).collect();
    let (mut machines, mut searches) = (Vec::new(), Vec::new());
    for (index, scene) in scenes.iter().enumerate() {
        match scene.check() {
            Ok(scene) => {
                machines.push(Machine::new(&scene));
                searches.push((index, FixedPoints::new(&scene)));
            }
            Err(error) => found[index] = Err(error.into()),
        }
    }
    let scenes = searches
        .iter()
        .map(|(_, fixed_points)| &**fixed_points.map.scene());
    let kept = SEARCH_STAGES.iter().flat_map(|(_, after)| *after).copied();
    let mut trials = Trials::new(scenes, kept.collect());
    for (until, after) in SEARCH_STAGES {
        trials.follow_trials(&machines, until, monitor);
        for (machine, (index, fixed_points)) in searches.iter_mut().enumerate() {
            let trials = trials.of_machine(machine);
            if !trials.iter().any(|trial| trial.is_open) {
                if let (Err(OrbitError::NotFound { .. }), Some(hardest)) =
                    (&found[*index], fixed_points.hardest_single())
                {
                    found[*index] = Ok(hardest);
                }
                continue;
            }
            let hardest = fixed_points
                .search_trials(trials, after, groups, monitor)
                .transpose();
            let is_over = hardest.is_some();
            if let Some(hardest) = hardest {
                found[*index] = hardest;
            }
            for trial in trials {
                trial.is_open &= !is_over && !fixed_points.predicts_stable(&trial.last);
            }
        }
    }
    found
}

/// The fixed points of a scene's map over one drive period that the search has met.
pub(super) struct FixedPoints {
    pub map: StroboscopicMap,
    scales: Scales,
    /// All of them.
    all: Vec<FixedPoint>,
    stable: Vec<Orbit>,
    /// States from which Newton's method has set out.
    tried: Vec<Vector2<f64>>,
}

/// A fixed point of the map, with what tells which states lead to it.
struct FixedPoint {
    state: Vector2<f64>,
    /// What leads to it from a state, times what that moves: Newton's method with the Jacobian of the fixed point.
    lead: Option<Matrix2<f64>>,
    /// Distance within which another state stands for it.
    reach: f64,
    is_stable: bool,
}

impl FixedPoint {
    /// A fixed point at a state, with its monodromy matrix.
    fn new(state: Vector2<f64>, monodromy: Monodromy) -> Self {
        let is_stable = monodromy.is_stable();
        Self {
            state,
            lead: monodromy.resolvent(),
            reach: if is_stable { STABLE_REACH } else { NEAR },
            is_stable,
        }
    }
}

impl FixedPoints {
    /// A search of a scene's fixed points that has met none.
    pub fn new(scene: &CheckedScene) -> Self {
        Self {
            map: StroboscopicMap::new(scene, 1),
            scales: scene.motion_scales(),
            all: Vec::new(),
            stable: Vec::new(),
            tried: Vec::new(),
        }
    }

    /// Searches fixed points from where trial motions have moved least, and then from where they are after some numbers
    /// of periods; the hardest stable z = 1 motion met so far if there is one and all is looked at.
    pub fn search_trials(
        &mut self,
        trials: &[Trial],
        after: &[u64],
        groups: usize,
        monitor: Monitor<'_>,
    ) -> Result<Option<Orbit>, OrbitError> {
        OrbitError::ask_monitor(monitor)?;
        self.search_candidates(least_moved(trials), monitor)?;
        if after.is_empty() {
            return Ok(None);
        }
        if groups > 1 || self.stable_singles().next().is_none() {
            self.search_candidates(settled_candidates(trials, after), monitor)?;
        }
        self.tried.clear();
        Ok(self.hardest_single())
    }

    /// The stable z = 1 motion with the hardest impact met so far.
    pub fn hardest_single(&self) -> Option<Orbit> {
        let hardest = self.stable_singles().max_by(|a, b| a.compare_velocity(b));
        hardest.cloned()
    }

    /// The stable motions with one impact per drive period met so far.
    fn stable_singles(&self) -> impl Iterator<Item = &Orbit> {
        let faintest = SAME * self.scales.speed();
        let is_single = move |orbit: &&Orbit| {
            orbit.impacts.len() == 1 && orbit.before_impact_velocity() > faintest
        };
        self.stable.iter().filter(is_single)
    }

    /// Searches a fixed point by Newton's method from each candidate that no other one stands for.
    fn search_candidates(
        &mut self,
        candidates: Vec<Candidate>,
        monitor: Monitor<'_>,
    ) -> Result<(), OrbitError> {
        for candidate in candidates {
            OrbitError::ask_monitor(monitor)?;
            let Candidate { moves, state, .. } = candidate;
            let stands = |other: &Vector2<f64>| self.scaled_gap(*other, state) < 0.5 * moves;
            if !self.is_known(state)
                && !self.tried.iter().any(stands)
                && !self
                    .all
                    .iter()
                    .any(|fixed| self.leads_to(fixed, &candidate))
            {
                self.tried.push(state);
                self.search_from_state(state);
            }
        }
        Ok(())
    }

    /// Distance of two states, in scales of the motion.
    fn scaled_gap(&self, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
        scaled_distance(&self.scales, a, b)
    }

    /// True if a state stands for a fixed point that was met.
    fn is_known(&self, state: Vector2<f64>) -> bool {
        let mut all = self.all.iter();
        all.any(|other| self.scaled_gap(other.state, state) < other.reach)
    }

    /// True if a candidate has moved as the Jacobian of a fixed point has it near that one.
    fn leads_to(&self, to: &FixedPoint, candidate: &Candidate) -> bool {
        let moved = candidate.state - candidate.before;
        let off = |lead| self.scaled_gap(candidate.before + lead * moved, to.state);
        to.lead.is_some_and(|lead| off(lead) < to.reach)
    }

    /// True if a motion that moves little settles on a stable fixed point that was met, as its Jacobian has it.
    pub fn predicts_stable(&self, last: &Candidate) -> bool {
        let mut stable = self.all.iter().filter(|fixed| fixed.is_stable);
        last.moves < NEAR_RETURN && stable.any(|fixed| self.leads_to(fixed, last))
    }

    /// Searches a fixed point by Newton's method from a state, unless it comes near one that was met.
    fn search_from_state(&mut self, state: Vector2<f64>) {
        let found = find_new_fixed_point(&self.map, state, |state| self.is_known(state));
        let scales = self.map.scene().scales();
        let steepness = |passage: &Passage| scales.jacobian(&passage.monodromy).norm();
        let orbit = match found {
            Ok(None) => return,
            Ok(Some((state, passage))) if NEAR * steepness(&passage) <= 1.0 => {
                self.all.push(FixedPoint::new(state, passage.monodromy));
                if !passage.monodromy.is_stable() {
                    return;
                }
                self.stable.push(Orbit::from_map(1, state, passage));
                return;
            }
            Ok(_) => Orbit::find_near(self.map.scene(), state).ok(),
            Err(_) => Orbit::find_by_guesses(self.map.scene(), state, 1, 1),
        };
        if let Some(orbit) = orbit.filter(|orbit| orbit.periods == 1) {
            self.all
                .push(FixedPoint::new(orbit.state(), orbit.monodromy));
            self.stable.extend(orbit.is_stable().then_some(orbit));
        }
    }
}
