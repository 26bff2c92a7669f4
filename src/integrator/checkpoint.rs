//! The checkpoint of a running machine: where its last advance began, how to go back there, and that advance gone through again.

use super::arc::Arc;
use super::clock::{Clock, Instant};
use super::external_force::force_from_derivatives;
use super::motion::Motion;
use super::observer::Observer;
use super::simulation::{Checkpoint, Simulation};
use super::work::Work;
use crate::error::MotionError;
use crate::flow::{Polynomial, integrate};
use crate::phases::PhaseKind;

impl Simulation {
    /// The machine as it was before the last advance, if that met a crossing or stopped on its way and nothing was set since.
    pub fn before_advance(&self) -> Option<Self> {
        let Checkpoint::Before(origin) = &self.checkpoint else {
            return None;
        };
        let mut machine = self.clone();
        machine.checkpoint = Checkpoint::OnArc(origin.motion.now());
        (machine.motion, machine.counts) = (origin.motion.clone(), origin.counts);
        machine.now = origin.now;
        Some(machine)
    }

    /// Sets the checkpoint: lets the stretch of [`Simulation::sensitivity`] begin at the present time.
    pub fn set_checkpoint(&mut self) {
        self.checkpoint = Checkpoint::OnArc(self.motion.now());
    }

    /// True if the checkpoint is the start: the stretch of [`Simulation::sensitivity`] reaches back to it.
    pub fn is_checkpoint_at_start(&self) -> bool {
        let (_, at) = self.motion_through_checkpoint();
        at == self.motion.clock().instant(self.begin - self.epoch)
    }

    /// The motion as it was at the checkpoint, on an arc of its own from there on.
    pub(crate) fn motion_at_checkpoint(&self) -> Motion {
        let (motion, at) = self.motion_through_checkpoint();
        motion.restarted_at(at)
    }

    /// The time in s of the checkpoint.
    pub fn time_of_checkpoint(&self) -> f64 {
        self.time_of(self.motion_through_checkpoint().1)
    }

    /// The machine as it was at the checkpoint: what follows may be compared with what did. Its energies count from there.
    #[must_use]
    pub fn at_checkpoint(&self) -> Self {
        let motion = self.motion_at_checkpoint();
        let mut machine = self.before_advance().unwrap_or_else(|| Self {
            now: self.time_of(motion.now()),
            ..self.clone()
        });
        machine.counts.work = Work::default();
        machine.checkpoint = Checkpoint::OnArc(motion.now());
        machine.motion = motion;
        machine
    }

    /// A motion that passes the checkpoint, and when.
    pub(super) fn motion_through_checkpoint(&self) -> (&Motion, Instant) {
        match &self.checkpoint {
            Checkpoint::OnArc(instant) => (&self.motion, *instant),
            Checkpoint::Before(origin) => (&origin.motion, origin.motion.now()),
        }
    }

    /// Work in J, over the stretch of [`Simulation::contacts`], of a force that has these derivatives where it begins, as in
    /// [`Simulation::set_force`]: value in N, rate in N/s, and so on.
    ///
    /// # Errors
    /// Those of [`Simulation::set_force`]; [`MotionError`] if the stretch cannot be gone through again.
    pub fn work_since_checkpoint(&self, force: &[f64]) -> Result<f64, MotionError> {
        let force = &force_from_derivatives(force)?;
        let (motion, from) = self.motion_through_checkpoint();
        let mut watch = WorkRecorder {
            clock: *motion.clock(),
            from,
            force,
            work: 0.0,
        };
        self.replay(&mut watch)?;
        Ok(watch.work)
    }

    /// Tells of all arcs and crossings since the checkpoint; the first arc may have begun before it.
    pub(super) fn replay(&self, observer: &mut dyn Observer) -> Result<(), MotionError> {
        let mut motion = self.motion_through_checkpoint().0.clone();
        motion.advance_like(&self.motion, observer)?;
        motion.tell_arc(observer);
        Ok(())
    }

    /// True if the mass was free all over the last advance, or since [`Simulation::set_checkpoint`] was called or something was set.
    pub fn was_free_since_checkpoint(&self) -> bool {
        matches!(self.checkpoint, Checkpoint::OnArc(_)) && self.motion.kind() == PhaseKind::Free
    }
}

/// An observer that adds up the work of a force from an instant on.
struct WorkRecorder<'a> {
    clock: Clock,
    from: Instant,
    force: &'a Polynomial,
    work: f64,
}

impl Observer for WorkRecorder<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let since = self.clock.elapsed(arc.start, self.from);
        let flow = &arc.course.flow;
        let rate = flow.frequency + flow.modes.fastest_rate();
        let power = |time: f64| self.force.value_at(time - since) * arc.at(time).velocity;
        if elapsed > since {
            self.work += integrate((since.max(0.0), elapsed), rate, power);
        }
    }
}
