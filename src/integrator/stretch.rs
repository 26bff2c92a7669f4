//! The last advance: where it began, and how to take it back.

use super::clock::Instant;
use super::motion::Motion;
use super::simulation::Simulation;
use super::tallies::Counts;

/// Where the last advance began.
#[derive(Debug, Clone)]
pub(super) enum Mark {
    /// On the arc that is under way.
    OnArc(Instant),
    /// Some crossings ago.
    Before(Box<Origin>),
}

/// A machine as it was before an advance.
#[derive(Debug, Clone)]
pub(super) struct Origin {
    pub motion: Motion,
    pub counts: Counts,
    pub now: f64,
}

impl Simulation {
    /// Takes back the last advance, if it met a crossing and nothing was set since; true if so.
    pub fn take_back(&mut self) -> bool {
        let start = Mark::OnArc(self.motion.now());
        match std::mem::replace(&mut self.mark, start) {
            Mark::OnArc(_) => false,
            Mark::Before(origin) => {
                self.mark = Mark::OnArc(origin.motion.now());
                (self.motion, self.tallies.counts) = (origin.motion, origin.counts);
                self.now = origin.now;
                true
            }
        }
    }

    /// Lets the stretch of [`Simulation::sensitivity`] begin at the present time.
    pub fn mark(&mut self) {
        self.mark = Mark::OnArc(self.motion.now());
    }

    /// True if that stretch reaches back to the start.
    pub fn is_marked_at_start(&self) -> bool {
        let at = match &self.mark {
            Mark::OnArc(instant) => *instant,
            Mark::Before(origin) => origin.motion.now(),
        };
        self.epoch == 0.0 && at == self.motion.clock().instant(self.begin)
    }

    /// The motion as it was at the mark, on an arc of its own from there on.
    pub(crate) fn motion_at_mark(&self) -> Motion {
        match &self.mark {
            Mark::OnArc(instant) => self.motion.departed_at(*instant),
            Mark::Before(origin) => origin.motion.departed_at(origin.motion.now()),
        }
    }
}
