//! The z = 1 motion found from scratch.

use std::cmp::Ordering;
use std::slice::from_ref;

use nalgebra::{Matrix2, Vector2};

use super::newton::find_new_fixed_point;
use super::periodic::STEEP;
use super::scan::{FAINTEST, all_single};
use super::trials::{Candidate, RETURNS, Trial, Trials, distance, least, settled};
use super::{Monodromy, Orbit, OrbitError, Passage, StroboscopicMap};
use crate::monitor::{Monitor, unmonitored};
use softstop::internals::Scales;
use softstop::{MotionError, Scene};
use softstop_lanes::Machine;

/// Drive periods after which Newton's method takes over from where motions have moved least, and those after which it
/// then takes over from all, unless what is looked for is found: few, which finds motions with small basins, and more; and
/// far more if neither finds any.
const STAGES: [(u64, &[u64]); 3] = [(4, &[]), (12, &[2, 12]), (60, &[60])];
/// Distance, in scales of the motion, within which a state stands for a stable motion, and for an unstable one, which a
/// stable one may be near to.
const SAME_STABLE: f64 = 0.02;
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
    find_with_monitor(scene, &unmonitored)
}

/// The motion that [`find`] finds, as long as a monitor, which is not told how much is done, lets the search go on.
///
/// # Errors
/// As [`find`]; [`OrbitError::Stopped`].
pub fn find_with_monitor(scene: &Scene, monitor: Monitor<'_>) -> Result<Orbit, OrbitError> {
    let settled = search(from_ref(scene), usize::MAX, monitor).remove(0);
    let mut all = all_single(scene, monitor)?;
    all.retain(Orbit::is_stable);
    match (settled, all.pop()) {
        (Ok(settled), Some(other)) if other.is_harder(&settled) => Ok(other),
        (Err(OrbitError::NotFound { .. }), Some(other)) => Ok(other),
        (settled, _) => settled,
    }
}

impl Orbit {
    /// The order of two orbits by their before-impact velocities.
    pub(crate) fn compare_velocity(&self, other: &Self) -> Ordering {
        let [own, other] = [self, other].map(Self::before_impact_velocity);
        own.total_cmp(&other)
    }

    /// True if its impact is harder than that of another one, beyond rounding.
    pub(crate) fn is_harder(&self, other: &Self) -> bool {
        self.before_impact_velocity() > (1.0 + SAME_SPEED) * other.before_impact_velocity()
    }
}

/// The motion that [`find`] finds of each of many scenes at once, from those motions that come back near to where they were, and only if they lead to
/// none, from all.
///
/// # Errors
/// Each as of [`find`].
pub(crate) fn find_batch(scenes: &[Scene], monitor: Monitor<'_>) -> Vec<Result<Orbit, OrbitError>> {
    search(scenes, 1, monitor)
}

/// The best of all motions that the first groups of states lead to; further groups are tried only as long as there is
/// none. The motions of all scenes are followed together, and those no farther that lead to a stable one that was met.
fn search(scenes: &[Scene], groups: usize, monitor: Monitor<'_>) -> Vec<Result<Orbit, OrbitError>> {
    let none = |scene: &Scene| OrbitError::NotFound {
        frequency: scene.excitation.frequency,
        clearance: scene.clearance,
    };
    let mut found: Vec<_> = scenes.iter().map(|scene| Err(none(scene))).collect();
    let (mut machines, mut searches) = (Vec::new(), Vec::new());
    for (index, scene) in scenes.iter().enumerate() {
        let machine = Machine::new(scene).map_err(OrbitError::from);
        match machine.and_then(|machine| Ok((machine, FixedPoints::new(scene)?))) {
            Ok((machine, fixed_points)) => {
                machines.push(machine);
                searches.push((index, fixed_points));
            }
            Err(error) => found[index] = Err(error),
        }
    }
    let scenes = searches.iter().map(|(_, fixed_points)| fixed_points.scene);
    let kept = STAGES.iter().flat_map(|(_, after)| *after).copied();
    let mut trials = Trials::new(scenes, kept.collect());
    for (until, after) in STAGES {
        trials.follow(&machines, until, monitor);
        for (machine, (index, fixed_points)) in searches.iter_mut().enumerate() {
            let trials = trials.of(machine);
            if !trials.iter().any(|trial| trial.is_open) {
                if let (Err(OrbitError::NotFound { .. }), Some(hardest)) =
                    (&found[*index], fixed_points.hardest())
                {
                    found[*index] = Ok(hardest);
                }
                continue;
            }
            let hardest = fixed_points
                .search(trials, after, groups, monitor)
                .transpose();
            let is_over = hardest.is_some();
            if let Some(hardest) = hardest {
                found[*index] = hardest;
            }
            for trial in trials {
                trial.is_open &= !is_over && !fixed_points.attracts(&trial.last);
            }
        }
    }
    found
}

/// The fixed points of the map over one drive period that the search has met.
struct FixedPoints<'a> {
    scene: &'a Scene,
    map: StroboscopicMap,
    scales: Scales,
    /// All of them.
    all: Vec<FixedPoint>,
    stable: Vec<Orbit>,
    /// States from which Newton's method has set out.
    tried: Vec<Vector2<f64>>,
}

/// A fixed point of the map.
struct FixedPoint {
    state: Vector2<f64>,
    /// What leads to it from a state, times what that moves: Newton's method with the Jacobian of the fixed point.
    lead: Option<Matrix2<f64>>,
    /// Distance within which another state stands for it.
    reach: f64,
    is_stable: bool,
}

impl FixedPoint {
    fn new(state: Vector2<f64>, monodromy: Monodromy) -> Self {
        let is_stable = monodromy.is_stable();
        Self {
            state,
            lead: monodromy.resolvent(),
            reach: if is_stable {
                SAME_STABLE
            } else {
                SAME_UNSTABLE
            },
            is_stable,
        }
    }
}

impl<'a> FixedPoints<'a> {
    fn new(scene: &'a Scene) -> Result<Self, MotionError> {
        Ok(Self {
            scene,
            map: StroboscopicMap::new(scene, 1)?,
            scales: scene.motion_scales(),
            all: Vec::new(),
            stable: Vec::new(),
            tried: Vec::new(),
        })
    }

    /// Looks at where motions have moved least, and then at where they are after some numbers of periods; the hardest
    /// stable z = 1 motion met so far if there is one and all is looked at.
    fn search(
        &mut self,
        trials: &[Trial],
        after: &[u64],
        groups: usize,
        monitor: Monitor<'_>,
    ) -> Result<Option<Orbit>, OrbitError> {
        OrbitError::ask(monitor)?;
        self.look_at(least(trials), monitor)?;
        if after.is_empty() {
            return Ok(None);
        }
        if groups > 1 || self.singles().next().is_none() {
            self.look_at(settled(trials, after), monitor)?;
        }
        self.tried.clear();
        Ok(self.hardest())
    }

    /// The hardest of the stable motions with one impact.
    fn hardest(&self) -> Option<Orbit> {
        let hardest = self.singles().max_by(|a, b| a.compare_velocity(b));
        hardest.cloned()
    }

    /// The stable motions with one impact.
    fn singles(&self) -> impl Iterator<Item = &Orbit> {
        let faintest = FAINTEST * self.scales.speed();
        let is_single = move |orbit: &&Orbit| {
            orbit.impacts.len() == 1 && orbit.before_impact_velocity() > faintest
        };
        self.stable.iter().filter(is_single)
    }

    /// Follows Newton's method from each candidate that no other one stands for.
    fn look_at(
        &mut self,
        candidates: Vec<Candidate>,
        monitor: Monitor<'_>,
    ) -> Result<(), OrbitError> {
        for candidate in candidates {
            OrbitError::ask(monitor)?;
            let Candidate { moves, state, .. } = candidate;
            let stands = |other: &Vector2<f64>| self.apart(*other, state) < STANDS_FOR * moves;
            if !self.is_near(state)
                && !self.tried.iter().any(stands)
                && !self.all.iter().any(|fixed| self.leads(fixed, &candidate))
            {
                self.tried.push(state);
                self.look(state);
            }
        }
        Ok(())
    }

    /// How far apart two states are, in scales of the motion.
    fn apart(&self, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
        distance(&self.scales, a, b)
    }

    fn is_near(&self, state: Vector2<f64>) -> bool {
        let mut all = self.all.iter();
        all.any(|other| self.apart(other.state, state) < other.reach)
    }

    /// True if a candidate has moved as the Jacobian of a fixed point has it near that one.
    fn leads(&self, to: &FixedPoint, candidate: &Candidate) -> bool {
        let moved = candidate.state - candidate.before;
        let off = |lead| self.apart(candidate.before + lead * moved, to.state);
        to.lead.is_some_and(|lead| off(lead) < to.reach)
    }

    /// True if a motion that moves little settles on a stable one that was met, as its Jacobian has it.
    fn attracts(&self, last: &Candidate) -> bool {
        let mut stable = self.all.iter().filter(|fixed| fixed.is_stable);
        last.moves < RETURNS && stable.any(|fixed| self.leads(fixed, last))
    }

    /// Newton's method from a state, unless it comes near a motion that was met.
    fn look(&mut self, state: Vector2<f64>) {
        let found = find_new_fixed_point(&self.map, state, |state| self.is_near(state));
        let steepness = |passage: &Passage| self.map.scales().jacobian(&passage.monodromy).norm();
        let orbit = match found {
            Ok(None) => return,
            Ok(Some((state, passage))) if steepness(&passage) <= STEEP => {
                self.all.push(FixedPoint::new(state, passage.monodromy));
                if !passage.monodromy.is_stable() {
                    return;
                }
                self.stable.push(Orbit::on(self.scene, 1, state, passage));
                return;
            }
            Ok(_) => Orbit::near(self.scene, state).ok(),
            Err(_) => Orbit::by_guesses(self.scene, state, 1, 1),
        };
        if let Some(orbit) = orbit.filter(|orbit| orbit.periods == 1) {
            self.all
                .push(FixedPoint::new(orbit.state(), orbit.monodromy));
            self.stable.extend(orbit.is_stable().then_some(orbit));
        }
    }
}
