//! Motions from time 0 on, kept or ready to be advanced.

use std::ops::ControlFlow;

use super::Trajectory;
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::integrator::{Clock, Instant, Motion, Observer, Start, force_from_derivatives};
use crate::scene::Scene;

/// An external force that acts from a time on, until the next one does.
#[derive(Debug, Clone, PartialEq)]
pub struct AppliedForce {
    /// When it begins, in s.
    pub from: f64,
    /// Derivatives of the force then, as in [`Simulation::set_force`](crate::Simulation::set_force): value in N, rate in N/s, and so on.
    pub derivatives: Vec<f64>,
}

impl Scene {
    /// The exact motion from `start` at time 0 over `periods` whole drive periods.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid or the motion grows beyond all bounds.
    pub fn trajectory(&self, start: Start, periods: u64) -> Result<Trajectory, MotionError> {
        self.trajectory_until(start, Clock::at_cycle(periods))
    }

    /// The exact motion from `start` at time 0 to any later instant.
    ///
    /// # Errors
    /// As [`Scene::trajectory`].
    pub fn trajectory_until(&self, start: Start, end: Instant) -> Result<Trajectory, MotionError> {
        self.trajectory_with_forces(start, end, &[], &mut ())
    }

    /// The exact motion from `start` at time 0 under forces in order of time, to an instant or until the observer stops it.
    ///
    /// # Errors
    /// As [`Scene::trajectory`]; [`MotionError::TimeBackwards`] if a force begins before the one ahead of it, and those of
    /// [`Simulation::set_force`](crate::Simulation::set_force).
    pub fn trajectory_with_forces(
        &self,
        start: Start,
        end: Instant,
        forces: &[AppliedForce],
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, MotionError> {
        let scene = self.check()?;
        let mut motion = scene.motion(start)?;
        let mut trajectory = Trajectory::empty(&scene);
        let mut flow = ControlFlow::Continue(());
        for force in forces {
            let from = motion.clock().instant(force.from);
            if from >= end {
                break;
            }
            flow = motion.watch(from, &mut (&mut trajectory, &mut *observer))?;
            if flow.is_break() {
                break;
            }
            let before = motion.clone();
            if motion.set_force(force_from_derivatives(&force.derivatives)?) {
                before.tell_arc(&mut trajectory);
            }
        }
        if flow.is_continue() {
            motion.advance(end, &mut (&mut trajectory, observer))?;
        }
        motion.tell_arc(&mut trajectory);
        trajectory.end = motion.state();
        Ok(trajectory)
    }

    /// The motion from `start` at time 0, ready to be advanced.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid or the start not finite.
    #[doc(hidden)]
    pub fn motion(&self, start: Start) -> Result<Motion, MotionError> {
        self.check()?.motion(start)
    }
}

impl CheckedScene {
    /// The motion from `start` at time 0, ready to be advanced.
    ///
    /// # Errors
    /// [`MotionError`] if the start is not finite, or beyond a rigid stop.
    #[doc(hidden)]
    #[inline]
    pub fn motion(&self, start: Start) -> Result<Motion, MotionError> {
        start.validate()?;
        Motion::new(self, Clock::at_cycle(0), start)
    }
}
