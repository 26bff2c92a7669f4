//! Who watches a motion: arcs as they end, crossings as they happen.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

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
    /// The node `elapsed` seconds after the start, at the end of the arc or on the way.
    pub(super) fn node_after(&self, elapsed: f64) -> ScanNode {
        match self.end {
            Some((at, Start { position, velocity }, drive)) if at == elapsed => self
                .course
                .node_of_state(elapsed, drive, (position, velocity)),
            _ => self.course.node_at(elapsed),
        }
    }

    /// When it began, in s since the clock's time 0.
    pub fn begin(&self) -> f64 {
        self.clock.time(self.start)
    }

    /// The drive angle `elapsed` seconds after the start.
    pub fn drive(&self, elapsed: f64) -> DriveAngle {
        self.clock.drive(self.clock.after(self.start, elapsed))
    }

    /// The state `elapsed` seconds after the start.
    pub fn at(&self, elapsed: f64) -> Start {
        let (position, velocity) = self.course.state_at(elapsed, self.drive(elapsed));
        Start::new(position, velocity)
    }
}

/// What happens at a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrossingKind {
    /// A surface is passed.
    Surface {
        /// Onwards (towards the stop) rather than back.
        forward: bool,
        /// It is an impact: a clearance is passed onwards.
        impact: bool,
        /// A strip has been pierced through.
        pierces: bool,
    },
    /// A rigid stop is hit.
    Rebound {
        /// It is an impact: the stop stands at a clearance.
        impact: bool,
        /// A strip has been pierced through.
        pierces: bool,
    },
    /// The velocity passes zero under dry friction.
    Reversal,
    /// Contact ceases or begins to press, without a jump of the force.
    Switch,
    /// Ever faster bounces on a rigid stop come to their end. The velocity before is the speed with
    /// which the last, summed ones began.
    Rest,
    /// A held mass is let go.
    Release,
}

impl CrossingKind {
    /// True if it is an impact.
    pub const fn is_impact(self) -> bool {
        matches!(
            self,
            Self::Surface { impact: true, .. } | Self::Rebound { impact: true, .. }
        )
    }

    /// True if a strip has been pierced through.
    pub const fn pierces(self) -> bool {
        matches!(
            self,
            Self::Surface { pierces: true, .. } | Self::Rebound { pierces: true, .. }
        )
    }
}

/// A crossing: an exact instant with the states on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// When it happens.
    pub instant: Instant,
    /// What happens.
    pub kind: CrossingKind,
    /// Position in m.
    pub position: f64,
    /// Velocity before in m/s.
    pub velocity: f64,
    /// Velocity after in m/s.
    pub velocity_after: f64,
    /// Acceleration before in m/s^2.
    pub acceleration_before: f64,
    /// Acceleration after in m/s^2.
    pub acceleration_after: f64,
}

impl Crossing {
    /// Kinetic energy in J that a mass loses: at a rebound, or when its bounce counts as rest.
    pub fn lost_energy(&self, mass: f64) -> f64 {
        // What summed bounces lose they lose on their way.
        if self.kind == CrossingKind::Rest {
            return 0.0;
        }
        let after = self.velocity_after * self.velocity_after;
        0.5 * mass * (self.velocity * self.velocity - after)
    }

    /// True if a strip has been pierced through.
    pub fn pierces(&self) -> bool {
        self.kind.pierces()
    }

    /// The before-impact velocity in m/s towards the stop, if this is an impact; [`Crossing::velocity`] has its sign.
    pub fn impact_velocity(&self) -> Option<f64> {
        self.kind.is_impact().then_some(self.velocity.abs())
    }
}

/// Watches a motion, and may stop it. To add one, implement what is of interest: each method does nothing unless
/// overridden. Two observers make a third, `(&mut first, &mut second)`.
///
/// ```
/// use std::ops::ControlFlow;
///
/// use softstop::{Crossing, Observer, Ratios, Simulation, Start};
///
/// /// Stops at the first impact.
/// #[derive(Default)]
/// struct First {
///     velocity: Option<f64>,
/// }
///
/// impl Observer for First {
///     fn crossing(&mut self, crossing: &Crossing) {
///         self.velocity = self.velocity.or(crossing.impact_velocity());
///     }
///
///     fn progress(&mut self, _: u64) -> ControlFlow<()> {
///         self.velocity.map_or(ControlFlow::Continue(()), |_| ControlFlow::Break(()))
///     }
/// }
///
/// let mut machine = Simulation::new(&Ratios::unloaded().scene()?, Start::new(0.0, 14.0))?;
/// let mut first = First::default();
/// assert!(machine.watch(1000.0, &mut first)?.is_break());
/// assert_eq!(machine.last_impact().map(|impact| impact.time), Some(machine.time()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Observer {
    /// An arc has ended `elapsed` seconds after its start.
    fn arc(&mut self, _arc: &Arc<'_>, _elapsed: f64) {}

    /// A crossing has happened.
    fn crossing(&mut self, _crossing: &Crossing) {}

    /// Whether to go on. Asked after each crossing and each step, and now and then on a long arc, with what
    /// has been done since, in scan windows (see [`Effort`](super::Effort)).
    fn progress(&mut self, _windows: u64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Watches nothing.
impl Observer for () {}

impl<A: Observer + ?Sized, B: Observer + ?Sized> Observer for (&mut A, &mut B) {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.0.arc(arc, elapsed);
        self.1.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.0.crossing(crossing);
        self.1.crossing(crossing);
    }

    fn progress(&mut self, windows: u64) -> ControlFlow<()> {
        self.0.progress(windows)?;
        self.1.progress(windows)
    }
}

/// An impact, its time counted from the start of the simulation.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Impact {
    /// Time in s.
    pub time: f64,
    /// Before-impact velocity in m/s.
    pub velocity: f64,
}
