//! One arc of a trajectory, kept.

use crate::flow::{ArcSolution, DriveAngle};
use crate::integrator::{Crossing, Instant, Start};
use crate::phases::{PhaseId, PhaseKind};

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
