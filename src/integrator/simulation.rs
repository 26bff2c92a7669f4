//! A machine that runs on: the motion with its tallies, its inputs and its tunable parameters.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::clock::{Clock, Instant};
use super::crossing::Impact;
use super::external_force::force_from_derivatives;
use super::motion::Motion;
use super::start::InitialConditions;
use super::tallies::Counts;
use super::{Observer, Work, work};
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::flow::Polynomial;
use crate::scene::Scene;

/// A running machine, SI units, absolute time in s.
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(super) scene: CheckedScene,
    pub(super) motion: Motion,
    /// Absolute time of the clock's time 0.
    pub(super) epoch: f64,
    pub(super) now: f64,
    pub(super) counts: Counts,
    /// Absolute time at which the machine started.
    pub(super) begin: f64,
    pub(super) checkpoint: Checkpoint,
    /// The last impact before the clock's time 0.
    pub(super) earlier: Option<Impact>,
}

impl Simulation {
    /// The machine from a [`Start`](super::Start) at time 0 s, or as [`InitialConditions`] says.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid, the start or the time not finite, or the start beyond a rigid stop.
    pub fn new(scene: &Scene, begin: impl Into<InitialConditions>) -> Result<Self, MotionError> {
        let InitialConditions { start, time, fed } = begin.into();
        let scene = scene.check()?;
        start.validate()?;
        if !time.is_finite() {
            return Err(MotionError::NotFinite {
                name: "time",
                value: time,
            });
        }
        let clock = scene.clock();
        within_reach(&clock, time, 0.0)?;
        let at = clock.instant(time);
        let through = (scene.phases().clone(), clock);
        let motion = Motion::with_force(through, at, start, Polynomial::default(), fed)?;
        Ok(Self {
            scene,
            motion,
            epoch: 0.0,
            now: time,
            counts: Counts::default(),
            begin: time,
            checkpoint: Checkpoint::OnArc(at),
            earlier: None,
        })
    }

    /// The parameters of the running machine that hold now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The present time in s of the running machine.
    pub fn time(&self) -> f64 {
        self.now
    }

    /// Advances to absolute time `until` in s, exactly, however the way is divided.
    ///
    /// # Errors
    /// [`MotionError`] if `until` is not finite or in the past, or the motion grows beyond all
    /// bounds; the machine then stays where it was.
    pub fn advance(&mut self, until: f64) -> Result<(), MotionError> {
        self.watch(until, &mut ()).map(drop)
    }

    /// Advances, watched by an observer, which may stop it: then the present time tells how far it is. An
    /// [`Effort`](super::Effort) limits what it may cost. [`Simulation::time_of`] gives the times of crossings.
    ///
    /// # Errors
    /// As [`Simulation::advance`].
    pub fn watch(
        &mut self,
        until: f64,
        observer: &mut dyn Observer,
    ) -> Result<ControlFlow<()>, MotionError> {
        self.watch_before(until, None, observer)
    }

    /// The absolute time in s of an instant since the frequency and phase of the drive were last set.
    pub fn time_of(&self, instant: Instant) -> f64 {
        self.epoch + self.motion.clock().time(instant)
    }

    /// Whether a time can be advanced to at all.
    ///
    /// # Errors
    /// [`MotionError::TimeBackwards`] and [`MotionError::TooFar`].
    pub fn check_reach(&self, until: f64) -> Result<(), MotionError> {
        if !(until.is_finite() && until >= self.now) {
            return Err(MotionError::TimeBackwards {
                until,
                present: self.now,
            });
        }
        within_reach(self.motion.clock(), until, self.epoch)
    }

    /// The motion of the running machine now.
    pub(crate) fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Work of the arc that is under way since its start, supplied and dissipated.
    pub(super) fn work_under_way(&self) -> Work {
        work(&self.motion.arc(), self.scene.mass, self.motion.elapsed())
    }

    /// Sets the external force from now on by its derivatives now: value in N, rate in N/s, and so on
    /// in N/s^k up to [`HIGHEST_ORDER`](crate::flow::HIGHEST_ORDER); those that are not given are zero.
    ///
    /// # Errors
    /// [`MotionError::ForceNotFinite`] if one of them is not finite, [`MotionError::ForceOrder`] if one
    /// beyond the highest order is not zero; nothing is changed then.
    pub fn set_force(&mut self, derivatives: &[f64]) -> Result<(), MotionError> {
        let force = force_from_derivatives(derivatives)?;
        if self.motion.force() != force {
            let work = self.work_under_way();
            if self.motion.set_force(force) {
                self.counts.work += work;
            }
            self.checkpoint = Checkpoint::OnArc(self.motion.now());
        }
        Ok(())
    }

    /// Takes another drive and another external force, by its derivatives as in [`Simulation::set_force`], from now on: of
    /// this amplitude in N and frequency in rad/s, at this angle in rad. Phase, latched strip and bounces in a row stay as
    /// they are. The scene's own phase of the drive, which counts from time 0, is left alone.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`], [`MotionError::Scene`] if amplitude or frequency make no valid scene, and those of
    /// [`Simulation::set_force`]; nothing is changed then.
    pub fn set_drive(
        &mut self,
        amplitude: f64,
        frequency: f64,
        angle: f64,
        force: &[f64],
    ) -> Result<(), MotionError> {
        let force = force_from_derivatives(force)?;
        if !angle.is_finite() {
            return Err(MotionError::NotFinite {
                name: "drive angle",
                value: angle,
            });
        }
        let mut scene = Scene::clone(&self.scene);
        (scene.excitation.amplitude, scene.excitation.frequency) = (amplitude, frequency);
        let scene = self.scene.recheck(scene)?;
        let clock = Clock::new(frequency, angle.rem_euclid(TAU));
        let work = self.work_under_way();
        self.restart_clock();
        let now = Clock::at_cycle(0);
        let through = (scene.phases().clone(), clock);
        if self.motion.set_drive(through, now, force) {
            self.counts.work += work;
        }
        self.scene = scene;
        self.checkpoint = Checkpoint::OnArc(self.motion.now());
        Ok(())
    }

    /// Switches the feed of strips on or off; it takes effect at the next upward crossing of the clearance.
    pub fn feed_strip(&mut self, fed: bool) {
        self.motion.feed_strip(fed);
    }

    /// Takes new parameters from now on. The drive angle stays continuous unless the drive's phase
    /// itself is changed; mass, suspension and geometry may change too.
    ///
    /// # Errors
    /// [`MotionError::Scene`] if the scene is invalid, [`MotionError::BeyondStop`] if its rigid stop
    /// would stand before the mass; nothing is changed then.
    pub fn tune(&mut self, scene: &Scene) -> Result<(), MotionError> {
        let scene = self.scene.recheck(scene.clone())?;
        if scene == self.scene {
            return Ok(());
        }
        let before = self.energy().mechanical;
        let (old, new) = (self.scene.excitation, scene.excitation);
        let (mut clock, mut at) = (*self.motion.clock(), self.motion.now());
        let retimed = old.frequency != new.frequency || old.phase != new.phase;
        if retimed {
            let angle =
                old.frequency * at.offset + clock.phase + new.reduced_phase() - old.reduced_phase();
            let angle = angle.rem_euclid(TAU);
            clock = Clock::new(new.frequency, angle);
            at = Clock::at_cycle(0);
        }
        let state = self.motion.state();
        let through = (scene.phases().clone(), clock);
        let motion = self.motion.restarted_through(through, at, state)?;
        self.counts.work += self.work_under_way();
        if retimed {
            self.restart_clock();
        }
        (self.motion, self.scene) = (motion, scene);
        self.checkpoint = Checkpoint::OnArc(self.motion.now());
        let mechanical = self.motion.mechanical_energy(&self.scene);
        self.counts.work.supplied += mechanical - before;
        Ok(())
    }

    /// Begins to count the time of a new clock at the present time.
    fn restart_clock(&mut self) {
        self.earlier = self.last_impact();
        self.counts.last_impact = None;
        self.epoch = self.now;
    }
}

/// Refuses a time at which the drive angle is not resolved any more.
fn within_reach(clock: &Clock, until: f64, epoch: f64) -> Result<(), MotionError> {
    let farthest = 9.0e15 * clock.period();
    if (until - epoch).abs() > farthest {
        return Err(MotionError::TooFar { until, farthest });
    }
    Ok(())
}

/// Where the last advance began; the motion is itself, or data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Checkpoint<M = Motion> {
    /// On the arc that is under way.
    OnArc(Instant),
    /// Some crossings ago.
    Before(Box<CheckpointState<M>>),
}

/// A machine as it was before an advance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct CheckpointState<M = Motion> {
    pub motion: M,
    pub counts: Counts,
    pub now: f64,
}

impl<M> Checkpoint<M> {
    /// This checkpoint with its motion made into another form.
    pub fn map<N, E>(&self, motion: impl Fn(&M) -> Result<N, E>) -> Result<Checkpoint<N>, E> {
        Ok(match self {
            Self::OnArc(instant) => Checkpoint::OnArc(*instant),
            Self::Before(origin) => Checkpoint::Before(Box::new(CheckpointState {
                motion: motion(&origin.motion)?,
                counts: origin.counts,
                now: origin.now,
            })),
        })
    }
}
