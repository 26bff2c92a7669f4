//! Who watches a motion: arcs as they end, crossings as they happen.

use std::ops::ControlFlow;

use super::arc::Arc;
use super::crossing::Crossing;

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
    /// Tells the observer that an arc has ended `elapsed` seconds after its start.
    fn arc(&mut self, _arc: &Arc<'_>, _elapsed: f64) {}

    /// Tells the observer that a crossing has happened.
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
