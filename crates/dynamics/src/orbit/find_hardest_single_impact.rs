//! The stable z = 1 motion of a scene with the highest before-impact velocity, searched from scratch: from many starts, and from
//! a lattice of impacts.

use std::slice::from_ref;

use super::all_single_impact_orbits::single_impact_orbits;
use super::fixed_point_search::FixedPointSearch;
use super::orbit_of_segments::flight_factor;
use super::trial_motions::TrialMotions;
use super::{Orbit, OrbitError};
use crate::monitor::{Monitor, unmonitored};
use crate::tolerance::TEST_ROUNDING;
use softstop::Scene;
use softstop::internals::PhaseId;
use softstop_lanes::LoweredMachine;

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
    find_with_known_orbits(scene, None, monitor)
}

/// The motion that [`find_with_monitor`] finds, with the z = 1 orbits that a lattice shows, those with the hardest impacts
/// last, searched unless they are known.
pub(crate) fn find_with_known_orbits(
    scene: &Scene,
    known: Option<Vec<Orbit>>,
    monitor: Monitor<'_>,
) -> Result<Orbit, OrbitError> {
    let settled = search_hardest_of_scenes(from_ref(scene), usize::MAX, monitor).remove(0);
    let mut all = match known {
        Some(known) => known,
        None => single_impact_orbits(scene, monitor)?,
    };
    all.retain(Orbit::is_stable);
    match (settled, all.pop()) {
        (Ok(settled), Some(other)) if other.is_harder(&settled) => other.resolved(),
        (Err(OrbitError::NotFound { .. }), Some(other)) => other.resolved(),
        (settled, _) => settled?.resolved(),
    }
}

/// The stable z = 1 motion that [`find`] finds of each of many scenes at once, from few candidates if they suffice.
///
/// # Errors
/// Each as of [`find`].
pub(crate) fn find_batch(scenes: &[Scene], monitor: Monitor<'_>) -> Vec<Result<Orbit, OrbitError>> {
    search_hardest_of_scenes(scenes, 1, monitor)
}

/// Searches the hardest stable z = 1 motion of each scene among all that the first groups of states lead to, and
/// further groups as long as there is none. Motions of all scenes go together, until they lead to a stable one.
fn search_hardest_of_scenes(
    scenes: &[Scene],
    groups: usize,
    monitor: Monitor<'_>,
) -> Vec<Result<Orbit, OrbitError>> {
    let none = |scene| Err(OrbitError::not_found(scene));
    let mut found: Vec<_> = scenes.iter().map(none).collect();
    let (mut machines, mut searches) = (Vec::new(), Vec::new());
    for (index, scene) in scenes.iter().enumerate() {
        match scene.check() {
            Ok(scene) => {
                machines.push(LoweredMachine::new(&scene));
                searches.push((index, FixedPointSearch::new(&scene)));
            }
            Err(error) => found[index] = Err(error.into()),
        }
    }
    let scenes = searches
        .iter()
        .map(|(_, fixed_points)| &**fixed_points.map.scene());
    let kept = SEARCH_STAGES.iter().flat_map(|(_, after)| *after).copied();
    let mut trials = TrialMotions::new(scenes, kept.collect());
    for (until, after) in SEARCH_STAGES {
        trials.follow_trials(&machines, until, monitor);
        for (machine, (index, fixed_points)) in searches.iter_mut().enumerate() {
            let trials = trials.trials_of_machine(machine);
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

impl Orbit {
    /// The orbit, if its contact is more than rounding or something else brings the mass back.
    ///
    /// A free mass that its suspension does not bring back, to rounding, seems to return to its state where it just touches the
    /// stop, while nothing balances the push of the stop. To first order the depth of a contact is the square of the before-impact
    /// velocity, in the scene's scales; one no deeper than the error of the state may be none.
    ///
    /// # Errors
    /// [`OrbitError::NotFound`].
    pub(crate) fn resolved(self) -> Result<Self, OrbitError> {
        let depth = (self.before_impact_velocity() / self.scene.scales().speed()).powi(2);
        let flow = self.scene.phases()[PhaseId::FREE].flow;
        let free = flight_factor(&flow, self.scene.period());
        match free.fold_test().abs() > TEST_ROUNDING || depth > self.state_error() {
            true => Ok(self),
            false => Err(OrbitError::not_found(&self.scene)),
        }
    }
}
