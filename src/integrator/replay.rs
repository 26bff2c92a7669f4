//! The last advance, gone through again by whoever wants to know more of it.

use super::checkpoint::Checkpoint;
use super::clock::{Clock, Instant};
use super::observer::{Arc, Observer};
use super::simulation::Simulation;
use crate::error::MotionError;
use crate::flow::{Polynomial, integrate};
use crate::phases::PhaseKind;

impl Simulation {
    /// Work in J, over the stretch of [`Simulation::contacts`], of a force that has these derivatives where it begins.
    ///
    /// # Errors
    /// [`MotionError`] if the stretch cannot be gone through again.
    pub fn work_of(&self, force: &Polynomial) -> Result<f64, MotionError> {
        let (motion, from) = self.motion_passing_mark();
        let mut watch = WorkRecorder {
            clock: *motion.clock(),
            from,
            force,
            work: 0.0,
        };
        self.replay(&mut watch)?;
        Ok(watch.work)
    }

    /// Tells of all arcs and crossings since the mark; the first arc may have begun before it.
    pub(super) fn replay(&self, observer: &mut dyn Observer) -> Result<(), MotionError> {
        let mut motion = self.motion_passing_mark().0.clone();
        motion.advance_like(&self.motion, observer)?;
        motion.tell_arc(observer);
        Ok(())
    }

    /// True if the mass was free all over the last advance, or since [`Simulation::mark`] was called or something was set.
    pub fn was_free(&self) -> bool {
        matches!(self.mark, Checkpoint::OnArc(_)) && self.motion.kind() == PhaseKind::Free
    }
}

/// Adds up the work of a force from an instant on.
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
        let power = |time: f64| self.force.eval(time - since) * arc.at(time).velocity;
        if elapsed > since {
            self.work += integrate((since.max(0.0), elapsed), rate, power);
        }
    }
}
