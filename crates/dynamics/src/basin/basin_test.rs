//! The basin test: which motions come to one stable orbit; it costs far less than a survey of all attractors.

use std::slice::from_ref;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::bring_to_section::bring_to_section;
use super::contraction_ball::ContractionBalls;
use crate::ensemble::{Ensemble, HasMember, Member, MemberStatus};
use crate::missed_strokes::StrokeCount;
use crate::monitor::Monitor;
use crate::orbit::recurrence::{motion_size, state_distance};
use crate::orbit::{Orbit, OrbitError};
use crate::parallel;
use crate::tolerance::{SAME, STABLE_REACH};
use crate::zone::free_amplitude;
use nalgebra::{Complex, Vector2};
use softstop::{Instant, MotionError, Scene, Start};
use softstop_lanes::LoweredMachine;

/// Number of motions of a basin test that are advanced together: enough for all lanes, whatever the number of threads.
const MOTIONS_TOGETHER: usize = 512;
/// Drive periods between two checks whether motions have arrived in a contraction ball.
pub(super) const PERIODS_BETWEEN_CHECKS: u64 = 16;
/// Drive periods that the motions of a basin test may take before they come near the orbit.
const APPROACH_PERIODS: u64 = 256;
/// Logarithm of the factor by which motions near the tested orbit have to decay, by its slowest multiplier, to have arrived.
const SETTLING_EXPONENT: f64 = 28.0;
/// Decay rate of an orbit, as ln per drive period, below which a basin test does not follow all motions to their end, for 20,000
/// periods.
pub const SLOW_DECAY: f64 = SETTLING_EXPONENT / 20_000.0;
/// Decay rate of an orbit, as ln per drive period, that rounding cannot tell from 0: it is at a border of stability, as a fold.
const MIN_DECAY_EXPONENT: f64 = 1e-5;
/// Drive periods that motions get to come to an orbit at a border of stability.
const BORDER_PERIODS: u64 = 512;

/// A test of which motions come to a stable orbit: they arrive in balls about its points in which its map contracts.
pub struct BasinTest {
    machine: LoweredMachine,
    states: Vec<Start>,
    /// Contraction balls of the orbit, and of the motion without impacts if it is another one: what lies there is lost.
    balls: ContractionBalls,
    patience: u64,
    /// Distance in m/s within which a motion has arrived in the end.
    arrived: f64,
}

/// Index of the tested orbit in the contraction balls.
const OWN_ORBIT: usize = 0;
/// Index of the motion without impacts in the contraction balls.
const IMPACTLESS_ORBIT: usize = 1;

/// A motion of a basin test, with its time and the strokes that it has missed.
#[derive(Debug, Clone)]
pub(crate) struct TestedMotion {
    pub member: Member,
    /// Drive angle in rad that its machine starts with.
    pub angle: f64,
    /// Time of its state, in drive periods.
    pub time: f64,
    /// Length of a drive period in s.
    pub period: f64,
    /// Its strokes so far, if they are counted.
    pub strokes: StrokeCount,
}

impl TestedMotion {
    /// True if the motion has come to the tested orbit.
    pub fn reaches_orbit(&self) -> bool {
        self.member.status == MemberStatus::Arrived(OWN_ORBIT)
    }
}

impl HasMember for TestedMotion {
    fn member_mut(&mut self) -> &mut Member {
        &mut self.member
    }

    fn record_impact(&mut self, instant: Instant, _: f64) {
        let time = self.time + instant.cycles + instant.offset / self.period;
        self.strokes.record_impact(time);
    }
}

impl BasinTest {
    /// The basin test of an orbit; no motion is said to come to an unstable or neutral orbit.
    ///
    /// # Errors
    /// [`MotionError`] if the orbit cannot be computed.
    pub fn of(orbit: &Orbit) -> Result<Self, MotionError> {
        let scene = &orbit.scene;
        let states: Vec<Start> = orbit.states()?.into_iter().map(Start::from).collect();
        let size = motion_size(scene.excitation.frequency, &states);
        let slowest = orbit.monodromy.multipliers()[0].norm();
        let decay = -slowest.ln() / orbit.periods as f64;
        let (patience, arrived) = match decay {
            _ if decay > MIN_DECAY_EXPONENT => {
                let settling = SETTLING_EXPONENT / decay.max(SLOW_DECAY);
                (APPROACH_PERIODS + settling as u64, SAME)
            }
            _ if decay > -MIN_DECAY_EXPONENT && !orbit.monodromy.is_neutral() => {
                (BORDER_PERIODS, STABLE_REACH)
            }
            _ => (0, 0.0),
        };
        let mut balls = ContractionBalls::default();
        balls.add_orbit(OWN_ORBIT, orbit)?;
        if let Some(other) = find_impactless_orbit(scene).filter(|_| !orbit.impacts.is_empty()) {
            balls.add_orbit(IMPACTLESS_ORBIT, &other)?;
        }
        Ok(Self {
            machine: LoweredMachine::new(scene),
            states,
            balls,
            patience,
            arrived: arrived * size,
        })
    }

    /// Which of the motions from `starts` at drive angle phi come to the tested orbit; one that cannot be computed does not. The
    /// result is the same for any number of threads. The monitor is not told how much is done.
    ///
    /// # Errors
    /// [`OrbitError::Stopped`].
    pub fn test_starts(
        &self,
        starts: &[Start],
        monitor: Monitor<'_>,
    ) -> Result<Vec<bool>, OrbitError> {
        self.follow_starts(starts, &|_| false, monitor)
    }

    /// Whether at least `needed` of the motions from `starts` at drive angle phi come to the tested orbit; they are followed
    /// until that is known. The answer is the same for any number of threads, what it costs is not.
    ///
    /// # Errors
    /// As [`BasinTest::test_starts`].
    pub fn is_reached_from(
        &self,
        starts: &[Start],
        needed: usize,
        monitor: Monitor<'_>,
    ) -> Result<bool, OrbitError> {
        let Some(spare) = starts.len().checked_sub(needed) else {
            return Ok(false);
        };
        let (reached, missed) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let is_decided = |reaches: bool| {
            let count = if reaches { &reached } else { &missed };
            count.fetch_add(1, Relaxed);
            reached.load(Relaxed) >= needed || missed.load(Relaxed) > spare
        };
        self.follow_starts(starts, &is_decided, monitor)?;
        Ok(reached.into_inner() >= needed)
    }

    /// Follows motions from `starts` at drive angle phi until each has ended or `is_decided`, which is told of each end whether
    /// the orbit is reached, is true: which of them have reached it.
    fn follow_starts(
        &self,
        starts: &[Start],
        is_decided: &(dyn Fn(bool) -> bool + Sync),
        monitor: Monitor<'_>,
    ) -> Result<Vec<bool>, OrbitError> {
        let scene = self.machine.scene();
        let motion = |state: &Start| TestedMotion {
            member: Member::new(0, *state),
            angle: scene.excitation.phase,
            time: 0.0,
            period: scene.period(),
            strokes: StrokeCount::after_impact(0.0),
        };
        let follow_motions = |starts: &[Start]| -> Result<Vec<bool>, OrbitError> {
            let motions = starts.iter().map(motion).collect();
            let machines = from_ref(&self.machine);
            let ended = self.follow_motions::<false>(machines, motions, is_decided, monitor)?;
            Ok(ended.iter().map(TestedMotion::reaches_orbit).collect())
        };
        Ok(parallel::try_map_chunks(starts, MOTIONS_TOGETHER, follow_motions)?.concat())
    }

    /// Follows motions until they have reached the tested orbit or are given up, or `is_decided` is true at the end of one;
    /// `COUNTS`: their strokes are counted. The machines differ from the orbit's only in the drive angle with which they start.
    pub(crate) fn follow_motions<const COUNTS: bool>(
        &self,
        machines: &[LoweredMachine],
        mut motions: Vec<TestedMotion>,
        is_decided: &(dyn Fn(bool) -> bool + Sync),
        monitor: Monitor<'_>,
    ) -> Result<Vec<TestedMotion>, OrbitError> {
        let quiet = |_, _| monitor(0, 0);
        let ensemble = Ensemble::new(machines, &quiet);
        let mut left: Vec<&mut TestedMotion> = motions.iter_mut().collect();
        let (mut periods, mut is_over) = (0, false);
        while !left.is_empty() && !is_over && periods < self.patience {
            ensemble.count_work(0)?;
            ensemble.advance_batch::<COUNTS, false, _>(&mut left, PERIODS_BETWEEN_CHECKS)?;
            periods += PERIODS_BETWEEN_CHECKS;
            for motion in &mut left {
                motion.time += PERIODS_BETWEEN_CHECKS as f64;
                if motion.member.status == MemberStatus::Open {
                    motion.member.status = self.classify_motion(motion, periods >= self.patience);
                }
            }
            left.retain(|motion| {
                let is_open = motion.member.status == MemberStatus::Open;
                is_over |= !is_open && is_decided(motion.reaches_orbit());
                is_open
            });
        }
        Ok(motions)
    }

    /// What a motion of the basin test has come to; `is_last`: it is followed no farther.
    fn classify_motion(&self, motion: &TestedMotion, is_last: bool) -> MemberStatus {
        let scene = self.machine.scene();
        let frequency = scene.excitation.frequency;
        let state = bring_to_section(scene, motion.member.state, motion.angle);
        let Ok(state) = state else {
            return MemberStatus::Lost;
        };
        let is_near = |own: &Start| state_distance(frequency, own, &state) <= self.arrived;
        match self.balls.orbit_holding(state) {
            Some(orbit) => MemberStatus::Arrived(orbit),
            None if !is_last => MemberStatus::Open,
            None if self.states.iter().any(is_near) => MemberStatus::Arrived(OWN_ORBIT),
            None => MemberStatus::Wandering,
        }
    }
}

/// The periodic motion of a scene without impacts; none if it would strike a stop.
fn find_impactless_orbit(scene: &Scene) -> Option<Orbit> {
    let drive = scene.excitation;
    if free_amplitude(scene, drive.frequency) >= scene.least_clearance() {
        return None;
    }
    let spring = scene.stiffness - scene.mass * drive.frequency * drive.frequency;
    let swing = drive.amplitude / Complex::new(spring, scene.damping * drive.frequency);
    let swing = swing * Complex::from_polar(1.0, drive.phase);
    let state = Vector2::new(swing.re, -drive.frequency * swing.im);
    let orbit = Orbit::find_periodic(scene, state, 1).ok()?;
    orbit.impacts.is_empty().then_some(orbit)
}
