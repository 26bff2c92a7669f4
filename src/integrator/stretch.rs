//! The last advance: where it began, and how to take it back.

use super::clock::Instant;
use super::mark::Mark;
use super::motion::Motion;
use super::simulation::Simulation;

impl Simulation {
    /// The machine as it was before the last advance, if that met a crossing or stopped on its way and
    /// nothing was set since.
    pub fn before_advance(&self) -> Option<Self> {
        let Mark::Before(origin) = &self.mark else {
            return None;
        };
        let mut machine = self.clone();
        machine.mark = Mark::OnArc(origin.motion.now());
        (machine.motion, machine.tallies.counts) = (origin.motion.clone(), origin.counts);
        machine.now = origin.now;
        Some(machine)
    }

    /// Lets the stretch of [`Simulation::sensitivity`] begin at the present time.
    pub fn mark(&mut self) {
        self.mark = Mark::OnArc(self.motion.now());
    }

    /// True if that stretch reaches back to the start.
    pub fn is_marked_at_start(&self) -> bool {
        let (_, at) = self.marked();
        self.epoch == 0.0 && at == self.motion.clock().instant(self.begin)
    }

    /// The motion as it was at the mark, on an arc of its own from there on.
    pub(crate) fn motion_at_mark(&self) -> Motion {
        let (motion, at) = self.marked();
        motion.departed_at(at)
    }

    /// A motion that passes the mark, and when.
    fn marked(&self) -> (&Motion, Instant) {
        match &self.mark {
            Mark::OnArc(instant) => (&self.motion, *instant),
            Mark::Before(origin) => (&origin.motion, origin.motion.now()),
        }
    }
}
