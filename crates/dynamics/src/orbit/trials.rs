//! Motions from starts all around the plane of states, followed together: they show where periodic motions may be.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use crate::batch::follow;
use crate::monitor::Monitor;
use softstop::internals::Scales;
use softstop::{Scene, Start};
use softstop_lanes::{BatchObserver, Machine};

/// Speeds of the starts, in units of w times the length of the motion.
const SPEEDS: [f64; 9] = [0.3, 0.6, 0.9, 1.0, 1.1, 1.25, 1.6, 2.0, 3.0];
/// Directions of the starts in the plane (w x, x').
const DIRECTIONS: usize = 16;
/// Distance, in scales of the motion, that a state may move within a period and yet lie near an orbit.
pub(super) const RETURNS: f64 = 0.2;

/// A state that may lie near an orbit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    /// How far it has moved within the last period, or none where that says nothing.
    pub moves: f64,
    pub state: Vector2<f64>,
    /// The state a period before.
    pub before: Vector2<f64>,
}

/// Distance of two states in these scales.
pub(super) fn distance(scales: &Scales, a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    scales.state(&(a - b)).norm()
}

/// A motion from one start.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    machine: usize,
    /// The last period.
    pub last: Candidate,
    /// Impacts in the present period.
    impacts: u64,
    /// The state that moved least within a period with one impact, where it moved little.
    least: Option<Candidate>,
    /// After each of the numbers of periods that are kept.
    settled: Vec<(u64, Candidate)>,
    /// True as long as it is followed on.
    pub is_open: bool,
}

/// Motions of some machines from starts all around, followed together: trials of a search.
pub(super) struct Trials {
    all: Vec<Trial>,
    /// Those of the motions of each machine.
    scales: Vec<Scales>,
    /// Numbers of drive periods after which it is kept where motions are.
    kept: Vec<u64>,
    /// Drive periods that they were followed.
    cycle: u64,
}

impl Trials {
    pub(super) fn new<'a>(scenes: impl Iterator<Item = &'a Scene>, kept: Vec<u64>) -> Self {
        let (mut all, mut scales) = (Vec::new(), Vec::new());
        for (machine, scene) in scenes.enumerate() {
            scales.push(scene.motion_scales());
            all.extend(starts(scene).map(|start| Trial {
                machine,
                last: Candidate::unmoved(start.into()),
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

    /// Those of a machine.
    pub(super) fn of(&mut self, machine: usize) -> &mut [Trial] {
        let each = self.all.len() / self.scales.len();
        &mut self.all[machine * each..(machine + 1) * each]
    }

    /// Follows those that are open up to a number of drive periods in all.
    pub(super) fn follow(&mut self, machines: &[Machine], until: u64, monitor: Monitor<'_>) {
        let mut open: Vec<&mut Trial> = self.all.iter_mut().filter(|it| it.is_open).collect();
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
        let _ = follow(machines, motions, &mut recorder, || monitor(0, 0));
        self.cycle = until;
    }
}

impl Candidate {
    /// A state of which no period is known.
    fn unmoved(state: Vector2<f64>) -> Self {
        Self {
            moves: 0.0,
            state,
            before: state,
        }
    }
}

/// Of some motions the states that move least within a period with one impact, where they move little, the least first.
pub(super) fn least(trials: &[Trial]) -> Vec<Candidate> {
    let mut least: Vec<Candidate> = trials.iter().filter_map(|it| it.least).collect();
    least.sort_by(|a, b| a.moves.total_cmp(&b.moves));
    least
}

/// Where some motions were after each of these numbers of periods, as if they did not move.
pub(super) fn settled(trials: &[Trial], after: &[u64]) -> Vec<Candidate> {
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

/// Keeps of each trial what becomes a candidate.
struct TrialRecorder<'a, 'b> {
    trials: &'a mut [&'b mut Trial],
    scales: &'a [Scales],
    kept: &'a [u64],
    /// Drive periods before.
    since: u64,
}

impl BatchObserver for TrialRecorder<'_, '_> {
    const IMPACTS: bool = true;
    const PERIODS: bool = true;

    fn impact(&mut self, job: usize, _: u64, _: f64, _: f64) {
        self.trials[job].impacts += 1;
    }

    fn period(&mut self, job: usize, cycle: u64, state: Start) {
        let trial = &mut *self.trials[job];
        let (state, before) = (state.into(), trial.last.state);
        let moves = distance(&self.scales[trial.machine], state, before);
        trial.last = Candidate {
            moves,
            state,
            before,
        };
        let cycle = self.since + cycle;
        if self.kept.contains(&cycle) {
            let settled = Candidate {
                moves: 0.0,
                ..trial.last
            };
            trial.settled.push((cycle, settled));
        }
        let impacts = std::mem::take(&mut trial.impacts);
        if impacts == 1 && moves < trial.least.map_or(RETURNS, |least| least.moves) {
            trial.least = Some(trial.last);
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
