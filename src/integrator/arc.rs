//! An arc of a motion, as observers see it.

use super::clock::{Clock, Instant};
use super::start::Start;
use crate::flow::{ArcSolution, DriveAngle, ScanNode};
use crate::phases::{Phase, PhaseKind};

/// A stretch of motion in one phase.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Arc<'a> {
    /// When it began.
    pub start: Instant,
    /// The clock of its instants.
    pub clock: &'a Clock,
    /// The exact motion along the arc.
    #[doc(hidden)]
    pub course: &'a ArcSolution,
    /// The phase of the arc; none while the mass is held.
    #[doc(hidden)]
    pub phase: Option<&'a Phase>,
    /// What the mass does on it.
    pub kind: PhaseKind,
    /// 1 where what holds on it is a stop above, or none, -1 where it is one below.
    pub side: f64,
    /// When it ends, in s after the start, with state and drive there, where a crossing has told them.
    pub(crate) end: Option<(f64, Start, DriveAngle)>,
}

impl Arc<'_> {
    /// The scan node `elapsed` seconds after the start, at the end of the arc or on the way.
    pub(super) fn node_after(&self, elapsed: f64) -> ScanNode {
        match self.end {
            Some((at, Start { position, velocity }, drive)) if at == elapsed => self
                .course
                .node_of_state(elapsed, drive, (position, velocity)),
            _ => self.course.node_at(elapsed),
        }
    }

    /// When the arc began, in s since the clock's time 0.
    pub fn begin(&self) -> f64 {
        self.clock.time(self.start)
    }

    /// The drive angle `elapsed` seconds after the start of the arc.
    pub fn drive(&self, elapsed: f64) -> DriveAngle {
        self.clock.drive(self.clock.after(self.start, elapsed))
    }

    /// The state `elapsed` seconds after the start of the arc.
    pub fn at(&self, elapsed: f64) -> Start {
        let (position, velocity) = self.course.state_at(elapsed, self.drive(elapsed));
        Start::new(position, velocity)
    }
}
