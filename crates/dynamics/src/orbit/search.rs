//! The z = 1 motion found from scratch.

use std::f64::consts::TAU;
use std::slice::from_ref;

use nalgebra::Vector2;

use super::newton::fixed_point_unless;
use super::periodic::STEEP;
use super::scan::{FAINTEST, all_single};
use super::{Orbit, OrbitError, Passage, StroboscopicMap};
use crate::watch::{Watcher, unwatched};
use softstop::internals::Scales;
use softstop::{Scene, Start};
use softstop_lanes::{Job, Machine, Watch};

/// Speeds of the starts, in units of w times the length of the motion.
const SPEEDS: [f64; 9] = [0.3, 0.6, 0.9, 1.0, 1.1, 1.25, 1.6, 2.0, 3.0];
/// Directions of the starts in the plane (w x, x').
const DIRECTIONS: usize = 16;
/// Drive periods after which Newton's method may take over: few, which finds motions with small basins, and more;
/// and far more if neither finds any.
const SETTLING: [&[u64]; 2] = [&[2, 12], &[60]];
/// Distance, in scales of the motion, that a state may move within a period and yet lie near an orbit.
const RETURNS: f64 = 0.2;
/// Distance, in the same scales, within which one state stands for another.
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

/// How far a state has moved within the last period, and the state.
type Candidate = (f64, Vector2<f64>);

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

/// Measures distances of states in scales of the motion.
#[derive(Debug, Clone, Copy)]
struct Distance {
    length: f64,
    speed: f64,
}

impl Distance {
    fn of(scene: &Scene) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        Self {
            length,
            speed: length * rate,
        }
    }

    fn between(self, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
        let way = a - b;
        Vector2::new(way.x / self.length, way.y / self.speed).norm()
    }
}

/// For each scene: of each motion the state that moves least within a period with one impact, where it moves little,
/// the least first; then where all motions are after each of these numbers of periods, in ascending order, as if they
/// did not move.
fn returning(
    machines: &[Machine],
    scenes: &[&Scene],
    settling: &[u64],
    watcher: Watcher<'_>,
) -> Vec<[Vec<Candidate>; 2]> {
    let jobs: Vec<Job> = scenes
        .iter()
        .enumerate()
        .flat_map(|(machine, scene)| {
            starts(scene).map(move |start| Job {
                machine,
                start,
                periods: settling[settling.len() - 1],
            })
        })
        .collect();
    let distances: Vec<Distance> = scenes.iter().map(|scene| Distance::of(scene)).collect();
    let count = jobs.len();
    let mut returns = Returns {
        first: 0,
        distances: jobs.iter().map(|job| distances[job.machine]).collect(),
        settling,
        last: jobs.iter().map(|job| job.start.into()).collect(),
        impacts: vec![0; count],
        least: vec![(RETURNS, Vector2::zeros()); count],
        settled: vec![vec![None; count]; settling.len()],
    };
    // One by one where they are slow, with the watcher asked in between: each is followed alone then.
    let together = match machines.iter().all(Machine::is_for_lanes) {
        true => jobs.len(),
        false => 1,
    };
    for (part, jobs) in jobs.chunks(together.max(1)).enumerate() {
        if watcher(0, 0).is_break() {
            break;
        }
        returns.first = part * together;
        softstop_lanes::run(machines, jobs, &mut returns);
    }
    let each = count / scenes.len().max(1);
    let of_scene = |index: usize| {
        let jobs = index * each..(index + 1) * each;
        let mut least = returns.least[jobs.clone()].to_vec();
        least.retain(|(moves, _)| *moves < RETURNS);
        least.sort_by(|a, b| a.0.total_cmp(&b.0));
        let settled = returns.settled.iter();
        let settled = settled.flat_map(|after| after[jobs.clone()].iter().flatten());
        [least, settled.map(|state| (0.0, *state)).collect()]
    };
    (0..scenes.len()).map(of_scene).collect()
}

/// Keeps of each motion the state that moves least within a period with one impact, and the states after some numbers
/// of periods.
struct Returns<'a> {
    /// Number of the first job of those that are followed now.
    first: usize,
    distances: Vec<Distance>,
    settling: &'a [u64],
    last: Vec<Vector2<f64>>,
    /// Impacts in the present period.
    impacts: Vec<u64>,
    least: Vec<Candidate>,
    /// After each of the numbers of periods, of each job.
    settled: Vec<Vec<Option<Vector2<f64>>>>,
}

impl Watch for Returns<'_> {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, job: usize, _: u64, _: f64, _: f64) {
        self.impacts[self.first + job] += 1;
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let (job, state) = (self.first + job, state.into());
        if let Some(place) = self.settling.iter().position(|after| *after == cycle) {
            self.settled[place][job] = Some(state);
        }
        let last = std::mem::replace(&mut self.last[job], state);
        let impacts = std::mem::take(&mut self.impacts[job]);
        if impacts == 1 {
            let moves = self.distances[job].between(state, last);
            if moves < self.least[job].0 {
                self.least[job] = (moves, state);
            }
        }
    }
}

/// Starts on circles in (w x, x') about the origin.
fn starts(scene: &Scene) -> impl Iterator<Item = Start> + use<> {
    let Scales { length, rate } = scene.motion_scales();
    SPEEDS.into_iter().flat_map(move |speed| {
        (0..DIRECTIONS).map(move |k| {
            let angle = TAU * k as f64 / DIRECTIONS as f64;
            Start::new(
                speed * length * angle.cos(),
                speed * length * (rate * angle.sin()),
            )
        })
    })
}
