//! A motion kept: its arcs, its crossings, its energies.

mod kept_arc;

pub use kept_arc::KeptArc;

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::integrator::{
    Arc, Clock, Crossing, Instant, Motion, Observer, Start, Work, force_from_derivatives,
    mechanical_energy, work,
};
use crate::scene::Scene;

/// A mass that touches: when, and how fast.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Touch {
    /// When it happens.
    pub instant: Instant,
    /// Before-impact velocity in m/s.
    pub before_impact_velocity: f64,
}

/// An external force that acts from a time on, until the next one does.
#[derive(Debug, Clone, PartialEq)]
pub struct AppliedForce {
    /// When it begins, in s.
    pub from: f64,
    /// Derivatives of the force then, as in [`Simulation::set_force`](crate::Simulation::set_force): value in N, rate in N/s, and so on.
    pub derivatives: Vec<f64>,
}

/// An exact motion over a span of time.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Trajectory {
    /// The clock of its instants.
    pub clock: Clock,
    /// Arcs in order of time, without gaps.
    pub arcs: Vec<KeptArc>,
    /// Crossings in order of time.
    pub crossings: Vec<Crossing>,
    /// Energies supplied and dissipated, in J.
    pub work: Work,
    /// Mechanical energy at the end less that at the start, in J.
    pub stored: f64,
    /// State at the end.
    pub end: Start,
}

impl Trajectory {
    /// The impacts in order of time.
    pub fn impacts(&self) -> impl Iterator<Item = Touch> + '_ {
        self.crossings.iter().filter_map(|crossing| {
            let before_impact_velocity = crossing.impact_velocity()?;
            Some(Touch {
                instant: crossing.instant,
                before_impact_velocity,
            })
        })
    }

    /// Position in m and velocity in m/s at any time within the trajectory.
    pub fn at(&self, instant: Instant) -> Option<Start> {
        let next = self.arcs.partition_point(|arc| arc.start <= instant);
        let arc = self.arcs.get(next.checked_sub(1)?)?;
        let elapsed = self.clock.elapsed(arc.start, instant);
        if next == self.arcs.len() && elapsed > arc.duration {
            return None;
        }
        let (position, velocity) = arc.course.state_at(elapsed, self.clock.drive(instant));
        Some(Start::new(position, velocity))
    }

    /// supplied - dissipated - stored, in J: zero but for rounding.
    pub fn energy_defect(&self) -> f64 {
        self.work.supplied - self.work.dissipated - self.stored
    }
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
        self.trajectory_under(start, end, &[], &mut ())
    }

    /// The exact motion from `start` at time 0 under external forces, in order of time, to any later instant, or until
    /// the observer stops it.
    ///
    /// # Errors
    /// As [`Scene::trajectory`]; [`MotionError::TimeBackwards`] if a force begins before the one ahead of it, and those of
    /// [`Simulation::set_force`](crate::Simulation::set_force).
    pub fn trajectory_under(
        &self,
        start: Start,
        end: Instant,
        forces: &[AppliedForce],
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, MotionError> {
        let mut motion = self.motion(start)?;
        let energy_before = mechanical_energy(self, &motion);
        let mut recorder = TrajectoryRecorder {
            mass: self.mass,
            ..TrajectoryRecorder::default()
        };
        let mut flow = ControlFlow::Continue(());
        for force in forces {
            let from = motion.clock().instant(force.from);
            if from >= end {
                break;
            }
            flow = motion.watch(from, &mut (&mut recorder, &mut *observer))?;
            if flow.is_break() {
                break;
            }
            let before = motion.clone();
            if motion.set_force(force_from_derivatives(&force.derivatives)?) {
                before.tell_arc(&mut recorder);
            }
        }
        if flow.is_continue() {
            motion.advance(end, &mut (&mut recorder, observer))?;
        }
        motion.tell_arc(&mut recorder);
        Ok(Trajectory {
            clock: *motion.clock(),
            arcs: recorder.arcs,
            crossings: recorder.crossings,
            work: recorder.work,
            stored: mechanical_energy(self, &motion) - energy_before,
            end: motion.state(),
        })
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

/// Keeps the arcs and crossings of a motion.
#[derive(Default)]
struct TrajectoryRecorder {
    mass: f64,
    arcs: Vec<KeptArc>,
    crossings: Vec<Crossing>,
    work: Work,
}

impl Observer for TrajectoryRecorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.work += work(arc, self.mass, elapsed);
        self.arcs.push(KeptArc::new(arc, elapsed));
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.work.dissipated += crossing.lost_energy(self.mass);
        if let Some(arc) = self.arcs.last_mut() {
            arc.crossing = Some(*crossing);
        }
        self.crossings.push(*crossing);
    }
}
