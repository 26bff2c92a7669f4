//! The mark of a running machine: where its last advance began, and how to go back there.

use super::checkpoint::Checkpoint;
use super::clock::Instant;
use super::motion::Motion;
use super::simulation::Simulation;
use super::tallies::Counts;
use super::work::Work;
use crate::error::MotionError;

impl Simulation {
    /// The machine as it was before the last advance, if that met a crossing or stopped on its way and
    /// nothing was set since.
    pub fn before_advance(&self) -> Option<Self> {
        let Checkpoint::Before(origin) = &self.mark else {
            return None;
        };
        let mut machine = self.clone();
        machine.mark = Checkpoint::OnArc(origin.motion.now());
        (machine.motion, machine.tallies.counts) = (origin.motion.clone(), origin.counts);
        machine.now = origin.now;
        Some(machine)
    }

    /// Sets the mark: lets the stretch of [`Simulation::sensitivity`] begin at the present time.
    pub fn mark(&mut self) {
        self.mark = Checkpoint::OnArc(self.motion.now());
    }

    /// True if the mark is the start: the stretch of [`Simulation::sensitivity`] reaches back to it.
    pub fn is_marked_at_start(&self) -> bool {
        let (_, at) = self.motion_passing_mark();
        at == self.motion.clock().instant(self.begin - self.epoch)
    }

    /// The motion as it was at the mark, on an arc of its own from there on.
    pub(crate) fn motion_at_mark(&self) -> Motion {
        let (motion, at) = self.motion_passing_mark();
        motion.restarted_at(at)
    }

    /// The machine as it was at the mark, position and velocity changed by so much: what follows may be compared with
    /// other changes. Its energies count from there.
    ///
    /// # Errors
    /// [`MotionError::BeyondStop`].
    pub fn at_mark(&self, position: f64, velocity: f64) -> Result<Self, MotionError> {
        let motion = self.motion_at_mark();
        let mut machine = self.clone();
        machine.now = self.time_of(motion.now());
        machine.tallies.counts.work = Work::default();
        if let Checkpoint::Before(origin) = &self.mark {
            machine.now = origin.now;
            let work = machine.tallies.counts.work;
            machine.tallies.counts = Counts {
                work,
                ..origin.counts
            };
        }
        machine.mark = Checkpoint::OnArc(motion.now());
        machine.motion = motion;
        if position != 0.0 || velocity != 0.0 {
            machine.motion.displace(position, velocity)?;
        }
        Ok(machine)
    }

    /// A motion that passes the mark, and when.
    pub(super) fn motion_passing_mark(&self) -> (&Motion, Instant) {
        match &self.mark {
            Checkpoint::OnArc(instant) => (&self.motion, *instant),
            Checkpoint::Before(origin) => (&origin.motion, origin.motion.now()),
        }
    }
}
