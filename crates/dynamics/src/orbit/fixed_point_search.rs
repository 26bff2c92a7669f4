//! The fixed points of the map over one drive period, by Newton's method from where trial motions may be near one.

use nalgebra::{Matrix2, Vector2};

use super::newton_fixed_point::find_new_fixed_point;
use super::trial_motions::{
    MAX_CANDIDATE_MOVE, OrbitCandidate, TrialMotion, least_moved, scaled_distance,
    settled_candidates,
};
use super::{MapApplication, Monodromy, Orbit, OrbitError, StroboscopicMap};
use crate::monitor::Monitor;
use crate::tolerance::{NEAR, SAME, STABLE_REACH};
use softstop::CheckedScene;
use softstop::internals::Scales;

/// The fixed points of a scene's map over one drive period that the search has met.
pub(super) struct FixedPointSearch {
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
    newton_matrix: Option<Matrix2<f64>>,
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
            newton_matrix: monodromy.resolvent(),
            reach: if is_stable { STABLE_REACH } else { NEAR },
            is_stable,
        }
    }
}

impl FixedPointSearch {
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
        trials: &[TrialMotion],
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

    /// The stable z = 1 fixed point with the hardest impact met so far.
    pub fn hardest_single(&self) -> Option<Orbit> {
        let hardest = self.stable_singles().max_by(|a, b| a.compare_velocity(b));
        hardest.cloned()
    }

    /// The stable fixed points with one impact per drive period met so far.
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
        candidates: Vec<OrbitCandidate>,
        monitor: Monitor<'_>,
    ) -> Result<(), OrbitError> {
        for candidate in candidates {
            OrbitError::ask_monitor(monitor)?;
            let OrbitCandidate { moves, state, .. } = candidate;
            let stands = |other: &Vector2<f64>| self.scaled_gap(*other, state) < 0.5 * moves;
            if !self.is_near_known_point(state)
                && !self.tried.iter().any(stands)
                && !self
                    .all
                    .iter()
                    .any(|fixed| self.is_on_way_to(fixed, &candidate))
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
    fn is_near_known_point(&self, state: Vector2<f64>) -> bool {
        let mut all = self.all.iter();
        all.any(|other| self.scaled_gap(other.state, state) < other.reach)
    }

    /// True if a candidate has moved as the Jacobian of a fixed point has it near that one.
    fn is_on_way_to(&self, to: &FixedPoint, candidate: &OrbitCandidate) -> bool {
        let moved = candidate.state - candidate.before;
        let off =
            |newton_matrix| self.scaled_gap(candidate.before + newton_matrix * moved, to.state);
        to.newton_matrix
            .is_some_and(|newton_matrix| off(newton_matrix) < to.reach)
    }

    /// True if a motion that moves little settles on a stable fixed point that was met, as its Jacobian has it.
    pub fn predicts_stable(&self, last: &OrbitCandidate) -> bool {
        let mut stable = self.all.iter().filter(|fixed| fixed.is_stable);
        last.moves < MAX_CANDIDATE_MOVE && stable.any(|fixed| self.is_on_way_to(fixed, last))
    }

    /// Searches a fixed point by Newton's method from a state, unless it comes near one that was met.
    fn search_from_state(&mut self, state: Vector2<f64>) {
        let found = find_new_fixed_point(&self.map, state, |state| self.is_near_known_point(state));
        let scales = self.map.scene().scales();
        let steepness = |passage: &MapApplication| scales.jacobian(&passage.monodromy).norm();
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
