//! A machine that runs on: the motion with its tallies, its inputs and its tunable parameters.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::Observer;
use super::clock::{Clock, Instant};
use super::external_force::force_from_derivatives;
use super::motion::Motion;
use super::observer::Impact;
use super::start::InitialConditions;
use super::tallies::{Counts, Tallies};
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
    pub(super) tallies: Tallies,
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
        let tallies = Tallies {
            mass: scene.mass,
            counts: Counts::default(),
        };
        let at = clock.instant(time);
        let through = (scene.phases().clone(), clock);
        let motion = Motion::with_force(through, at, start, Polynomial::default(), fed)?;
        Ok(Self {
            scene,
            motion,
            epoch: 0.0,
            now: time,
            tallies,
            begin: time,
            checkpoint: Checkpoint::OnArc(at),
            earlier: None,
        })
    }

    /// The parameters that hold now.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The present time in s.
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

    /// Advances as [`Simulation::watch`], but stops right before the first crossing that does not happen before the time
    /// `halt` in s; [`Simulation::cross`] lets it happen. One that is after `until` by rounding alone counts as before it.
    ///
    /// # Errors
    /// As [`Simulation::advance`].
    pub fn watch_before(
        &mut self,
        until: f64,
        halt: Option<f64>,
        observer: &mut dyn Observer,
    ) -> Result<ControlFlow<()>, MotionError> {
        self.check_reach(until)?;
        let clock = *self.motion.clock();
        let instant = clock.instant(until - self.epoch);
        let before = self.motion.now();
        let (mut end, mut last, mut stop) = (instant, until, None);
        if let Some(halt) = halt {
            let rounding = self.rounding_at(until);
            (end, last) = (clock.after(instant, rounding), until + rounding);
            stop = Some(clock.instant(halt - rounding - self.epoch));
        }
        // Equal times may be written as instants that differ in the last digit.
        if instant <= before || self.motion.advance_if_clear(end)? {
            if halt.is_some() && instant > before {
                self.motion.now = instant;
            }
            self.checkpoint = Checkpoint::OnArc(before);
            self.now = until;
            return Ok(ControlFlow::Continue(()));
        }
        let origin = CheckpointState {
            motion: self.motion.clone(),
            counts: self.tallies.counts,
            now: self.now,
        };
        let origin = Box::write(Box::new_uninit(), origin);
        let mut observers = (&mut self.tallies, observer);
        match self.motion.watch_before(end, stop, &mut observers) {
            Ok(flow) => {
                self.checkpoint = Checkpoint::Before(origin);
                self.now = if flow.is_continue() {
                    if halt.is_some() && instant > self.motion.start {
                        self.motion.now = instant;
                    }
                    until
                } else {
                    self.time_of(self.motion.now()).clamp(self.now, last)
                };
                Ok(flow)
            }
            Err(error) => {
                (self.motion, self.tallies.counts) = (origin.motion, origin.counts);
                Err(error)
            }
        }
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

    /// The motion now.
    pub(crate) fn motion(&self) -> &Motion {
        &self.motion
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
            let work = self.tallies.work_under_way(&self.motion);
            if self.motion.set_force(force) {
                self.tallies.counts.work += work;
            }
            self.checkpoint = Checkpoint::OnArc(self.motion.now());
        }
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
            let angle = angle.rem_euclid(std::f64::consts::TAU);
            clock = Clock::new(new.frequency, angle);
            at = Clock::at_cycle(0);
        }
        let state = self.motion.state();
        let through = (scene.phases().clone(), clock);
        let motion = self.motion.restarted_through(through, at, state)?;
        self.tallies.counts.work += self.tallies.work_under_way(&self.motion);
        if retimed {
            self.restart_clock();
        }
        (self.motion, self.scene) = (motion, scene);
        self.checkpoint = Checkpoint::OnArc(self.motion.now());
        self.tallies.mass = self.scene.mass;
        let mechanical = self.motion.mechanical_energy(&self.scene);
        self.tallies.counts.work.supplied += mechanical - before;
        Ok(())
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
