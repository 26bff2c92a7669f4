//! Snapshots: all that a machine has to remember, as plain data.
//!
//! Whatever follows from the scene (phases, flows) and from a departure (the course) is left out and
//! computed anew, which gives the same numbers bit for bit.

use std::convert::Infallible;

use serde::{Deserialize, Serialize};

use super::bounce_train::BounceTrain;
use super::clock::{Clock, Instant};
use super::crossing::Impact;
use super::external_force::Force;
use super::motion::Motion;
use super::simulation::{Checkpoint, Simulation};
use super::start::Start;
use super::tallies::Counts;
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::events::NextEvent;
use crate::flow::{Chatter, Departure, FinePosition, Polynomial, TaylorStep};
use crate::phases::{Mode, Phases, Sticking};

/// A running machine at one time. Written to bytes and read back, in this process or another, it goes
/// on bit for bit (on the same kind of machine).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    scene: CheckedScene,
    epoch: f64,
    now: f64,
    begin: f64,
    counts: Counts,
    motion: MotionData,
    #[serde(rename = "mark")]
    checkpoint: Checkpoint<MotionData>,
    earlier: Option<Impact>,
}

/// [`Motion`] as data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct MotionData {
    /// Drive angle in rad at the clock's time 0.
    angle: f64,
    mode: Mode,
    fed: bool,
    pierced: bool,
    force: Force,
    start: Instant,
    now: Instant,
    departure: Departure,
    /// What is known of the departure beyond its rounded position.
    finer: Option<FinePosition>,
    chatter: Option<Chatter>,
    outlook: NextEvent,
    bounce_train: BounceTrain,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    is_put: bool,
}

impl MotionData {
    fn from_motion(motion: &Motion) -> Self {
        Self {
            angle: motion.clock.phase,
            mode: motion.mode,
            fed: motion.fed,
            pierced: motion.pierced,
            force: motion.force,
            start: motion.start,
            now: motion.now,
            departure: motion.course.departure,
            finer: motion
                .course
                .taylor_step()
                .map(TaylorStep::fine_start_position),
            chatter: motion.course.chatter().copied(),
            outlook: motion.outlook,
            bounce_train: motion.bounce_train,
            is_put: motion.is_put,
        }
    }

    /// The motion, which goes on bit for bit.
    fn to_motion(&self, scene: &CheckedScene) -> Result<Motion, MotionError> {
        let phases = scene.phases();
        self.validate(phases)?;
        let clock = Clock::new(scene.excitation.frequency, self.angle);
        let given = Start::new(self.departure.position, self.departure.velocity);
        // One that was put there may be beyond a rigid stop.
        let passed = phases.walls().find(|wall| wall.is_reached(given.position));
        let start = match passed.filter(|_| self.is_put) {
            Some(wall) => Start::new(wall.position, given.velocity),
            None => given,
        };
        let force = Polynomial::default();
        let fresh =
            Motion::with_force((phases.clone(), clock), self.start, start, force, self.fed)?;
        let mut motion = Motion {
            pierced: self.pierced,
            force: self.force,
            now: self.now,
            bounce_train: self.bounce_train,
            ..fresh
        };
        if self.is_put {
            (motion.mode, motion.now) = (self.mode, self.start);
            motion.begin_in_state(given);
            motion.now = self.now;
        } else {
            motion.begin_course(self.departure, self.mode, self.finer, self.chatter);
        }
        motion.outlook = self.outlook;
        let guards = motion.present_guards().len();
        if matches!(self.outlook, NextEvent::Crossing(found) if found.guard >= guards) {
            return Err(invalid("a crossing of a surface that does not exist"));
        }
        Ok(motion)
    }

    fn validate(&self, phases: &Phases) -> Result<(), MotionError> {
        let held = self.mode.sticking().into_iter().flat_map(Sticking::phases);
        let mut named = self.mode.phase().into_iter().chain(held);
        if named.any(|phase| phase.index() >= phases.phases.len()) {
            return Err(invalid("a phase that does not exist"));
        }
        let (start, now) = (self.start, self.now);
        let times = [start.cycles, start.offset, now.cycles, now.offset];
        let numbers = [self.angle, self.departure.position, self.departure.velocity];
        if times.iter().chain(&numbers).any(|n| !n.is_finite()) || now < start {
            return Err(invalid("numbers that no motion has"));
        }
        Ok(())
    }
}

fn invalid(what: &'static str) -> MotionError {
    MotionError::Snapshot { what }
}

impl Simulation {
    /// All that is needed to go on from here.
    pub fn snapshot(&self) -> Snapshot {
        let moving = |motion: &Motion| Ok::<_, Infallible>(MotionData::from_motion(motion));
        let Ok(checkpoint) = self.checkpoint.map(moving);
        Snapshot {
            scene: self.scene.clone(),
            epoch: self.epoch,
            now: self.now,
            begin: self.begin,
            counts: self.counts,
            motion: MotionData::from_motion(&self.motion),
            checkpoint,
            earlier: self.earlier,
        }
    }

    /// The machine that a snapshot was taken of.
    ///
    /// # Errors
    /// [`MotionError::Snapshot`] if no machine can have left it behind.
    pub fn restored(snapshot: &Snapshot) -> Result<Self, MotionError> {
        let scene = snapshot.scene.clone();
        let times = [snapshot.epoch, snapshot.now, snapshot.begin];
        if times.iter().any(|time| !time.is_finite()) {
            return Err(invalid("times that are not finite"));
        }
        Ok(Self {
            motion: snapshot.motion.to_motion(&scene)?,
            epoch: snapshot.epoch,
            now: snapshot.now,
            counts: snapshot.counts,
            begin: snapshot.begin,
            checkpoint: snapshot.checkpoint.map(|it| it.to_motion(&scene))?,
            earlier: snapshot.earlier,
            scene,
        })
    }
}
