//! One arc of a trajectory, kept.

use crate::flow::{ArcSolution, DriveAngle};
use crate::integrator::{Arc, Clock, Crossing, Instant, Start};
use crate::phases::{PhaseId, PhaseKind, Phases};

/// One arc of a trajectory.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct KeptArc {
    /// When it began.
    pub start: Instant,
    /// How long it lasts, in s.
    pub duration: f64,
    /// The exact motion along the arc.
    #[doc(hidden)]
    pub course: ArcSolution,
    /// What the mass does on it.
    pub kind: PhaseKind,
    /// Which phase; none while the mass is held.
    #[doc(hidden)]
    pub phase: Option<PhaseId>,
    /// The crossing at its end, if there is one.
    #[doc(hidden)]
    pub crossing: Option<Crossing>,
    pub(super) side: f64,
    pub(super) end: Option<(f64, Start, DriveAngle)>,
}

impl KeptArc {
    /// An arc that has ended so many seconds after its start.
    #[doc(hidden)]
    pub fn new(arc: &Arc<'_>, duration: f64) -> Self {
        Self {
            start: arc.start,
            duration,
            course: arc.course.clone(),
            kind: arc.kind,
            phase: arc.phase.map(|phase| phase.id),
            crossing: None,
            side: arc.side,
            end: arc.end,
        }
    }

    /// The arc as an observer of a motion through these phases sees it.
    #[doc(hidden)]
    pub fn seen<'a>(&'a self, clock: &'a Clock, phases: &'a Phases) -> Arc<'a> {
        Arc {
            start: self.start,
            clock,
            course: &self.course,
            phase: self.phase.map(|phase| &phases[phase]),
            kind: self.kind,
            side: self.side,
            end: self.end,
        }
    }
}
