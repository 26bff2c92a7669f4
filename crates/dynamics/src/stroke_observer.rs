//! Counts the strokes of a motion as it goes on.

use std::ops::ControlFlow;

use crate::monitor::stop_if;
use crate::stroke_count::StrokeCount;
use softstop::{Crossing, Instant, Observer};

/// Counts the strokes of a motion, and stops it where the mass leaves strip or stop.
pub(crate) struct StrokeObserver<'a> {
    pub clearance: f64,
    /// The drive period in s.
    pub period: f64,
    pub strokes: &'a mut StrokeCount,
    /// Whether the motion stops where the mass leaves strip or stop.
    pub stops: bool,
    /// True once it has left them.
    pub left: bool,
}

impl Observer for StrokeObserver<'_> {
    fn crossing(&mut self, crossing: &Crossing) {
        self.left |= crossing.position == self.clearance && crossing.velocity_after < 0.0;
        if crossing.kind.is_impact() {
            let Instant { cycles, offset } = crossing.instant;
            self.strokes.record_impact(cycles + offset / self.period);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        stop_if(self.stops && self.left)
    }
}
