//! Trial motions from starts all around the plane of states: they show where periodic motions may be.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use crate::monitor::Monitor;
use crate::monitored_batch::follow_batch;
use softstop::internals::Scales;
use softstop::{Scene, Start};
use softstop_lanes::{BatchObserver, LoweredMachine};

/// Distances of the starts of trial motions from the origin of (w x, x'), in units of w times the length of the motion.
const START_SPEEDS: [f64; 9] = [0.3, 0.6, 0.9, 1.0, 1.1, 1.25, 1.6, 2.0, 3.0];
/// Directions of the starts of trial motions in the plane (w x, x').
const START_DIRECTIONS: usize = 16;
/// Distance, in scales of the motion, that a state may move within a period and yet lie near an orbit.
pub(super) const MAX_CANDIDATE_MOVE: f64 = 0.2;

/// A state of a trial motion that may lie near an orbit.
#[derive(Debug, Clone, Copy)]
pub(super) struct OrbitCandidate {
    /// Distance that the state has moved within the last period, 0 where that says nothing.
    pub moves: f64,
    pub state: Vector2<f64>,
    /// The state a period before.
    pub before: Vector2<f64>,
}

/// Distance of two states of a trial motion, in these scales.
pub(super) fn scaled_distance(scales: &Scales, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    scales.state(&(a - b)).norm()
}

/// A trial motion from one start.
#[derive(Debug, Clone)]
pub(super) struct TrialMotion {
    machine: usize,
    /// The state after the last period, and how far it moved.
    pub last: OrbitCandidate,
    /// Impacts in the present drive period.
    impacts: u64,
    /// The state that moved least within a period with one impact, where it moved little.
    least: Option<OrbitCandidate>,
    /// Its states after each of the numbers of periods that are kept.
    settled: Vec<(u64, OrbitCandidate)>,
    /// True as long as the trial is followed further.
    pub is_open: bool,
}

/// Trial motions of some machines from starts all around, followed together for a search.
pub(super) struct TrialMotions {
    all: Vec<TrialMotion>,
    /// Scales of the motions of each machine.
    scales: Vec<Scales>,
    /// Numbers of drive periods after which the states of trials are kept.
    kept: Vec<u64>,
    /// Drive periods that the trials have been followed.
    cycle: u64,
}

impl TrialMotions {
    /// Trial motions of some scenes, of which the states after the `kept` numbers of drive periods are kept.
    pub(super) fn new<'a>(scenes: impl Iterator<Item = &'a Scene>, kept: Vec<u64>) -> Self {
        let (mut all, mut scales) = (Vec::new(), Vec::new());
        for (machine, scene) in scenes.enumerate() {
            scales.push(scene.motion_scales());
            all.extend(starts_on_circles(scene).map(|start| TrialMotion {
                machine,
                last: OrbitCandidate::unmoved_state(start.into()),
                impacts: 0,
                least: None,
                settled: Vec::new(),
                is_open: true,
            }));
        }
        Self {
            all,
            scales,
            kept,
            cycle: 0,
        }
    }

    /// The trial motions of one machine.
    pub(super) fn trials_of_machine(&mut self, machine: usize) -> &mut [TrialMotion] {
        let each = self.all.len() / self.scales.len();
        &mut self.all[machine * each..(machine + 1) * each]
    }

    /// Follows the open trial motions up to a number of drive periods in all.
    pub(super) fn follow_trials(
        &mut self,
        machines: &[LoweredMachine],
        until: u64,
        monitor: Monitor<'_>,
    ) {
        let mut open: Vec<&mut TrialMotion> = self.all.iter_mut().filter(|it| it.is_open).collect();
        let lasting = until - self.cycle;
        let motions = open.iter();
        let motions = motions.map(|it| (it.machine, it.last.state.into(), lasting));
        let motions: Vec<_> = motions.collect();
        let mut recorder = TrialRecorder {
            trials: &mut open,
            scales: &self.scales,
            kept: &self.kept,
            since: self.cycle,
        };
        // The caller asks the monitor itself.
        let _ = follow_batch(machines, motions, &mut recorder, || monitor(0, 0));
        self.cycle = until;
    }
}

impl OrbitCandidate {
    /// A candidate at a state of which no period is known.
    fn unmoved_state(state: Vector2<f64>) -> Self {
        Self {
            moves: 0.0,
            state,
            before: state,
        }
    }
}

/// Of some trials the states that move least within a period with one impact, where they move little, the least first.
pub(super) fn least_moved(trials: &[TrialMotion]) -> Vec<OrbitCandidate> {
    let mut least: Vec<OrbitCandidate> = trials.iter().filter_map(|it| it.least).collect();
    least.sort_by(|a, b| a.moves.total_cmp(&b.moves));
    least
}

/// Where some trials were after each of these numbers of periods, as candidates that do not move.
pub(super) fn settled_candidates(trials: &[TrialMotion], after: &[u64]) -> Vec<OrbitCandidate> {
    let of = |after: u64| {
        trials
            .iter()
            .flat_map(move |it| it.settled.iter().filter(move |at| at.0 == after))
    };
    after
        .iter()
        .flat_map(|after| of(*after))
        .map(|(_, candidate)| *candidate)
        .collect()
}

/// An observer of a batch that keeps of each trial what becomes a candidate.
struct TrialRecorder<'a, 'b> {
    trials: &'a mut [&'b mut TrialMotion],
    scales: &'a [Scales],
    kept: &'a [u64],
    /// Drive periods that the trials were followed before this batch.
    since: u64,
}

impl BatchObserver for TrialRecorder<'_, '_> {
    fn observed(&self) -> (bool, bool) {
        (true, true)
    }

    fn impact(&mut self, job: usize, _: u64, _: f64, _: f64) {
        self.trials[job].impacts += 1;
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let trial = &mut *self.trials[job];
        let (state, before) = (state.into(), trial.last.state);
        let moves = scaled_distance(&self.scales[trial.machine], state, before);
        trial.last = OrbitCandidate {
            moves,
            state,
            before,
        };
        let cycle = self.since + cycle;
        if self.kept.contains(&cycle) {
            let settled = OrbitCandidate {
                moves: 0.0,
                ..trial.last
            };
            trial.settled.push((cycle, settled));
        }
        let impacts = std::mem::take(&mut trial.impacts);
        if impacts == 1 && moves < trial.least.map_or(MAX_CANDIDATE_MOVE, |least| least.moves) {
            trial.least = Some(trial.last);
        }
    }
}

/// Starts of trial motions on circles in (w x, x') about the origin.
fn starts_on_circles(scene: &Scene) -> impl Iterator<Item = Start> + use<> {
    let Scales { length, rate } = scene.motion_scales();
    START_SPEEDS.into_iter().flat_map(move |speed| {
        (0..START_DIRECTIONS).map(move |k| {
            let angle = TAU * k as f64 / START_DIRECTIONS as f64;
            Start::new(
                speed * length * angle.cos(),
                speed * length * (rate * angle.sin()),
            )
        })
    })
}
