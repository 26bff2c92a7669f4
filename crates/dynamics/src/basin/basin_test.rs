//! Which motions come to one stable orbit: all others are not told apart, which costs far less than a survey.

use std::f64::consts::TAU;
use std::slice::from_ref;

use rayon::prelude::*;

use super::ball::ContractionBalls;
use super::section::at_section;
use crate::attractors::catalogue::ARRIVED;
use crate::ensemble::{Ensemble, HasMember, Member, Outcome};
use crate::monitor::Monitor;
use crate::orbit::recurrence::{distance, size};
use crate::orbit::{Orbit, OrbitError};
use crate::stroke_count::StrokeCount;
use crate::zone::free_amplitude;
use nalgebra::{Complex, Vector2};
use softstop::internals::budget::Fork;
use softstop::{Excitation, Instant, MotionError, Scene, Start};
use softstop_lanes::Machine;

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
/// Distance from an orbit at a border, in units of its size, at which a motion has arrived that no ball holds.
const ARRIVED_AT_BORDER: f64 = 2e-2;

/// A stable orbit with balls about its points in which its map contracts: what lies in one of them comes to it.
pub struct BasinTest {
    machine: Machine,
    drive: Excitation,
    states: Vec<Start>,
    /// Those of the orbit, and of the motion without impacts if it is another one: what lies there is lost.
    balls: ContractionBalls,
    patience: u64,
    /// Distance within which a motion has arrived in the end.
    arrived: f64,
}

/// Numbers of the orbit, and of the motion without impacts.
const OWN: usize = 0;
const OTHER: usize = 1;

/// A motion that comes to the orbit or does not.
#[derive(Debug, Clone)]
pub(crate) struct TestedMotion {
    pub member: Member,
    /// Drive angle in rad that its machine starts with.
    pub angle: f64,
    /// When it is at its state, in drive periods, and their length in s.
    pub time: f64,
    pub period: f64,
    /// Its strokes so far, if they are counted.
    pub strokes: StrokeCount,
}

impl TestedMotion {
    /// True if it has come to the orbit.
    pub fn reaches(&self) -> bool {
        self.member.outcome == Outcome::Arrived(OWN)
    }
}

impl HasMember for TestedMotion {
    fn member(&mut self) -> &mut Member {
        &mut self.member
    }

    fn impact(&mut self, instant: Instant, _: f64) {
        let time = self.time + instant.cycles + instant.offset / self.period;
        self.strokes.record_impact(time);
    }
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
                (PATIENCE + settling as u64, ARRIVED)
            }
            _ if decay > -SLOWEST_DECAY && !orbit.is_neutral() => (AT_BORDER, ARRIVED_AT_BORDER),
            _ => (0, 0.0),
        };
        let mut balls = ContractionBalls::default();
        balls.add(OWN, orbit)?;
        if let Some(other) = without_impacts(scene).filter(|_| !orbit.impacts.is_empty()) {
            balls.add(OTHER, &other)?;
        }
        Ok(Self {
            machine: Machine::new(scene)?,
            drive: scene.excitation,
            states,
            balls,
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
            member: Member::new(0, *state),
            angle: self.drive.phase,
            time: 0.0,
            period: TAU / self.drive.frequency,
            strokes: StrokeCount::after(0.0),
        };
        let follow_motions = |starts: &[Start]| {
            let motions = starts.iter().map(motion).collect();
            let ended = self.follow_motions::<false>(from_ref(&self.machine), motions, monitor)?;
            Ok(ended.iter().map(TestedMotion::reaches).collect())
        };
        let (fork, chunks) = (Fork::default(), starts.par_chunks(MOTIONS_TOGETHER));
        let chunks = chunks.map(|starts| fork.run_part(|| follow_motions(starts)));
        let chunks = chunks.collect::<Result<Vec<Vec<bool>>, OrbitError>>();
        fork.charge_parts();
        Ok(chunks?.concat())
    }

    /// Follows motions until they have reached the orbit or are given up, with or without counting their strokes. The
    /// machines differ from the orbit's in the drive angle alone with which they start.
    pub(crate) fn follow_motions<const COUNTS: bool>(
        &self,
        machines: &[Machine],
        mut motions: Vec<TestedMotion>,
        monitor: Monitor<'_>,
    ) -> Result<Vec<TestedMotion>, OrbitError> {
        let quiet = |_, _| monitor(0, 0);
        let ensemble = Ensemble::new(machines, &quiet);
        let mut left: Vec<&mut TestedMotion> = motions.iter_mut().collect();
        let mut periods = 0;
        while !left.is_empty() && periods < self.patience {
            ensemble.note(0)?;
            ensemble.advance_batch::<COUNTS, false, _>(&mut left, PERIODS_AT_ONCE)?;
            periods += PERIODS_AT_ONCE;
            for motion in &mut left {
                motion.time += PERIODS_AT_ONCE as f64;
                if motion.member.outcome == Outcome::Open {
                    motion.member.outcome = self.outcome(motion, periods >= self.patience);
                }
            }
            left.retain(|motion| motion.member.outcome == Outcome::Open);
        }
        Ok(motions)
    }

    /// What a motion has come to.
    fn outcome(&self, motion: &TestedMotion, is_last: bool) -> Outcome {
        let phases = self.machine.shared_phases();
        let state = at_section(&phases, self.drive, motion.member.state, motion.angle);
        let Ok(state) = state else {
            return Outcome::Lost;
        };
        let is_near = |own: &Start| distance(self.drive.frequency, own, &state) <= self.arrived;
        match self.balls.caught(state) {
            Some(orbit) => Outcome::Arrived(orbit),
            None if !is_last => Outcome::Open,
            None if self.states.iter().any(is_near) => Outcome::Arrived(OWN),
            None => Outcome::Wandering,
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
