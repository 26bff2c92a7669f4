//! Which motions come to one stable orbit: all others are not told apart, which costs far less than a survey.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::ball::ContractionBall;
use super::section::at_section;
use crate::batch::follow;
use crate::monitor::Monitor;
use crate::orbit::recurrence::{distance, size};
use crate::orbit::{Orbit, OrbitError};
use crate::stroke_count::StrokeCount;
use crate::zone::free_amplitude;
use nalgebra::{Complex, Vector2};
use softstop::internals::budget::Fork;
use softstop::{Excitation, MotionError, Scene, Start};
use softstop_lanes::{BatchObserver, Machine};

/// Motions that go together: enough for all lanes to be busy. It may not depend on how many threads there are.
const MOTIONS_TOGETHER: usize = 512;
/// Drive periods between two looks at where the motions are.
pub(super) const PERIODS_AT_ONCE: u64 = 16;
/// Drive periods that motions may take before they come near: this many, and as many as the slowest multiplier needs
/// to take away all but this exponent of e; and never more than the last.
const PATIENCE: u64 = 256;
const SHRUNK: f64 = 28.0;
const MAX_SETTLING: f64 = 20_000.0;
/// Decay a drive period, as an exponent, below which an orbit is at a border to rounding, as at a fold: it attracts from
/// one side alone, and ever more slowly. Drive periods that motions get there.
const SLOWEST_DECAY: f64 = 1e-5;
const AT_BORDER: u64 = 512;
/// Distance from the orbit, in units of its size, at which a motion has arrived that no ball holds; and at a border.
const ARRIVED: [f64; 2] = [1e-6, 2e-2];

/// A stable orbit with balls about its points in which its map contracts: what lies in one of them comes to it.
pub struct BasinTest {
    machine: [Machine; 1],
    drive: Excitation,
    states: Vec<Start>,
    balls: Vec<ContractionBall>,
    /// Those of the motion without impacts, if it is another one: what lies there is lost.
    away: Vec<ContractionBall>,
    patience: u64,
    /// Distance within which a motion has arrived in the end.
    arrived: f64,
}

/// A motion on its way, at a drive angle in rad that its machine starts with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TestedMotion {
    pub machine: usize,
    pub angle: f64,
    pub state: Start,
    /// When that is, in drive periods.
    pub time: f64,
    /// Its strokes so far.
    pub strokes: StrokeCount,
}

/// What became of a tested motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TestResult {
    /// It came to the orbit.
    pub reaches: bool,
    /// Strokes missed on its way, if they were counted.
    pub missed: u64,
}

impl BasinTest {
    /// That of an orbit; nothing comes to one that is unstable or neutral.
    ///
    /// # Errors
    /// [`MotionError`] if the orbit cannot be computed.
    pub fn of(orbit: &Orbit) -> Result<Self, MotionError> {
        let scene = &orbit.scene;
        let states: Vec<Start> = orbit.states()?.into_iter().map(Start::from).collect();
        let size = size(scene.excitation.frequency, &states);
        let slowest = orbit.multipliers()[0].norm();
        let decay = -slowest.ln() / orbit.periods as f64;
        let (patience, arrived) = match decay {
            _ if decay > SLOWEST_DECAY => {
                let settling = (SHRUNK / decay).min(MAX_SETTLING);
                (PATIENCE + settling as u64, ARRIVED[0])
            }
            _ if decay > -SLOWEST_DECAY && !orbit.is_neutral() => (AT_BORDER, ARRIVED[1]),
            _ => (0, 0.0),
        };
        let away = match without_impacts(scene).filter(|_| !orbit.impacts.is_empty()) {
            Some(other) => ContractionBall::all(&other)?,
            None => Vec::new(),
        };
        Ok(Self {
            machine: [Machine::new(scene)?],
            drive: scene.excitation,
            states,
            balls: ContractionBall::all(orbit)?,
            away,
            patience,
            arrived: arrived * size,
        })
    }

    /// Which of the motions from these states at drive angle phi come to the orbit; a motion that cannot be computed
    /// does not. The same for any number of threads. The monitor is not told how much is done.
    ///
    /// # Errors
    /// [`OrbitError::Stopped`].
    pub fn reached(&self, starts: &[Start], monitor: Monitor<'_>) -> Result<Vec<bool>, OrbitError> {
        let motion = |state: &Start| TestedMotion {
            machine: 0,
            angle: self.drive.phase,
            state: *state,
            time: 0.0,
            strokes: StrokeCount::after(0.0),
        };
        let follow_motions = |starts: &[Start]| {
            let motions: Vec<TestedMotion> = starts.iter().map(motion).collect();
            self.follow_motions::<false>(&self.machine, motions, monitor)
        };
        let (fork, chunks) = (Fork::default(), starts.par_chunks(MOTIONS_TOGETHER));
        let chunks = chunks.map(|starts| fork.part(|| follow_motions(starts)));
        let chunks = chunks.collect::<Result<Vec<_>, OrbitError>>();
        fork.join();
        Ok(chunks?
            .concat()
            .iter()
            .map(|result| result.reaches)
            .collect())
    }

    /// Follows motions until they have reached the orbit or are given up. The machines differ from the orbit's in the drive angle
    /// alone with which they start.
    pub(crate) fn follow_motions<const COUNTS: bool>(
        &self,
        machines: &[Machine],
        mut motions: Vec<TestedMotion>,
        monitor: Monitor<'_>,
    ) -> Result<Vec<TestResult>, OrbitError> {
        let period = TAU / self.drive.frequency;
        let mut reached = vec![false; motions.len()];
        let mut left: Vec<usize> = (0..motions.len()).collect();
        let mut periods = 0;
        while !left.is_empty() && periods < self.patience {
            OrbitError::ask(monitor)?;
            let open = left.iter().map(|motion| &motions[*motion]);
            let open = open.map(|it| (it.machine, it.state, PERIODS_AT_ONCE));
            let open: Vec<_> = open.collect();
            let mut counter = Counter::<COUNTS> {
                period,
                motions: &mut motions,
                open: &left,
            };
            let outcomes = follow(machines, open, &mut counter, || monitor(0, 0));
            let outcomes = outcomes.ok_or(OrbitError::Stopped)?;
            periods += PERIODS_AT_ONCE;
            let ends = left.into_iter().zip(outcomes);
            left = ends
                .filter_map(|(motion, outcome)| {
                    let it = &mut motions[motion];
                    it.state = outcome.end;
                    it.time += PERIODS_AT_ONCE as f64;
                    let outcome = match outcome.error {
                        Some(_) => Some(false),
                        None => self.has_reached(it, periods >= self.patience),
                    };
                    reached[motion] = outcome == Some(true);
                    outcome.is_none().then_some(motion)
                })
                .collect();
        }
        let ends = motions.iter().zip(reached);
        let result = |(motion, reaches): (&TestedMotion, bool)| TestResult {
            reaches,
            missed: motion.strokes.missed(motion.time),
        };
        Ok(ends.map(result).collect())
    }

    /// Whether a motion has come to the orbit, or never will; none if that is open still.
    fn has_reached(&self, motion: &TestedMotion, is_last: bool) -> Option<bool> {
        let phases = self.machine[0].shared_phases();
        let Ok(state) = at_section(&phases, self.drive, motion.state, motion.angle) else {
            return Some(false);
        };
        let holds = |balls: &[ContractionBall]| balls.iter().any(|ball| ball.holds(state));
        let is_near = |own: &Start| distance(self.drive.frequency, own, &state) <= self.arrived;
        match () {
            () if holds(&self.balls) => Some(true),
            () if holds(&self.away) => Some(false),
            () if is_last => Some(self.states.iter().any(is_near)),
            () => None,
        }
    }
}

/// The motion without impacts, if there is one.
fn without_impacts(scene: &Scene) -> Option<Orbit> {
    let drive = scene.excitation;
    if free_amplitude(scene, drive.frequency) >= scene.least_clearance() {
        return None;
    }
    let spring = scene.stiffness - scene.mass * drive.frequency * drive.frequency;
    let swing = drive.amplitude / Complex::new(spring, scene.damping * drive.frequency);
    let swing = swing * Complex::from_polar(1.0, drive.phase);
    let state = Vector2::new(swing.re, -drive.frequency * swing.im);
    let orbit = Orbit::periodic(scene, state, 1).ok()?;
    orbit.impacts.is_empty().then_some(orbit)
}

/// Counts the strokes of those motions that are open.
struct Counter<'a, const COUNTS: bool> {
    period: f64,
    motions: &'a mut [TestedMotion],
    open: &'a [usize],
}

impl<const COUNTS: bool> BatchObserver for Counter<'_, COUNTS> {
    const IMPACTS: bool = COUNTS;

    fn impact(&mut self, job: usize, cycle: u64, offset: f64, _: f64) {
        let motion = &mut self.motions[self.open[job]];
        let time = motion.time + cycle as f64 + offset / self.period;
        motion.strokes.record_impact(time);
    }
}
