//! Counts the strokes that a motion misses.

use std::ops::ControlFlow;

use crate::monitor::stop_if;
use softstop::{Crossing, Instant, Observer};

/// The number of strokes that a motion misses: an impact that comes n drive periods after the last one has missed n - 1, whatever
/// the drive angles at which they come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeCount {
    last: f64,
    missed: u64,
}

impl StrokeCount {
    /// A count of missed strokes that begins with an impact at a time in drive periods.
    pub const fn after_impact(impact: f64) -> Self {
        Self {
            last: impact,
            missed: 0,
        }
    }

    /// Counts the strokes that were missed before an impact at a time in drive periods.
    pub fn record_impact(&mut self, time: f64) {
        self.missed = self.missed_strokes(time);
        self.last = time;
    }

    /// Number of strokes missed up to a time in drive periods.
    pub fn missed_strokes(&self, time: f64) -> u64 {
        self.missed + ((time - self.last).round() as u64).saturating_sub(1)
    }
}

/// An observer that counts the strokes that a motion misses, and may stop it where the mass leaves strip or stop.
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
