//! Motions from starts all around, followed together until they come back near to where they were.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use crate::batch::follow;
use crate::watch::Watcher;
use softstop::internals::Scales;
use softstop::{Scene, Start};
use softstop_lanes::{Job, Machine, Watch};

/// Speeds of the starts, in units of w times the length of the motion.
const SPEEDS: [f64; 9] = [0.3, 0.6, 0.9, 1.0, 1.1, 1.25, 1.6, 2.0, 3.0];
/// Directions of the starts in the plane (w x, x').
const DIRECTIONS: usize = 16;
/// Distance, in scales of the motion, that a state may move within a period and yet lie near an orbit.
const RETURNS: f64 = 0.2;

/// A state that may lie near an orbit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    /// How far it has moved within the last period, or none where that says nothing.
    pub moves: f64,
    pub state: Vector2<f64>,
    /// The state a period before.
    pub before: Vector2<f64>,
}

/// Measures distances of states in scales of the motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Distance {
    length: f64,
    speed: f64,
}

impl Distance {
    pub(super) fn of(scene: &Scene) -> Self {
        let Scales { length, rate } = scene.motion_scales();
        Self {
            length,
            speed: length * rate,
        }
    }

    pub(super) fn between(self, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
        let way = a - b;
        Vector2::new(way.x / self.length, way.y / self.speed).norm()
    }
}

/// For each scene: of each motion the state that moves least within a period with one impact, where it moves little,
/// the least first; then where all motions are after each of these numbers of periods, in ascending order, as if they
/// did not move.
pub(super) fn returning(
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
        distances: jobs.iter().map(|job| distances[job.machine]).collect(),
        settling,
        last: jobs.iter().map(|job| job.start.into()).collect(),
        impacts: vec![0; count],
        least: vec![None; count],
        settled: vec![vec![None; count]; settling.len()],
    };
    // The caller asks the watcher itself.
    let _ = follow(machines, &jobs, &mut returns, || watcher(0, 0));
    let each = count / scenes.len().max(1);
    let of_scene = |index: usize| {
        let jobs = index * each..(index + 1) * each;
        let least = returns.least[jobs.clone()].iter().flatten();
        let mut least: Vec<Candidate> = least.copied().collect();
        least.sort_by(|a, b| a.moves.total_cmp(&b.moves));
        let settled = returns.settled.iter();
        let settled = settled.flat_map(|after| after[jobs.clone()].iter().flatten());
        [least, settled.copied().collect()]
    };
    (0..scenes.len()).map(of_scene).collect()
}

/// Keeps of each motion the state that moves least within a period with one impact, and the states after some numbers
/// of periods.
struct Returns<'a> {
    distances: Vec<Distance>,
    settling: &'a [u64],
    last: Vec<Vector2<f64>>,
    /// Impacts in the present period.
    impacts: Vec<u64>,
    least: Vec<Option<Candidate>>,
    /// After each of the numbers of periods, of each job.
    settled: Vec<Vec<Option<Candidate>>>,
}

impl Watch for Returns<'_> {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, job: usize, _: u64, _: f64, _: f64) {
        self.impacts[job] += 1;
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let state = state.into();
        let before = std::mem::replace(&mut self.last[job], state);
        let candidate = |moves| {
            Some(Candidate {
                moves,
                state,
                before,
            })
        };
        if let Some(place) = self.settling.iter().position(|after| *after == cycle) {
            self.settled[place][job] = candidate(0.0);
        }
        let impacts = std::mem::take(&mut self.impacts[job]);
        if impacts == 1 {
            let moves = self.distances[job].between(state, before);
            if moves < self.least[job].map_or(RETURNS, |least| least.moves) {
                self.least[job] = candidate(moves);
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
