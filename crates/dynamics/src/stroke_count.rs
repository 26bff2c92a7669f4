//! The strokes that a motion misses.

/// Counts the strokes that a motion misses: an impact that comes n drive periods after the last one and not one has
/// missed n - 1, whatever the drive angles at which they come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeCount {
    last: f64,
    missed: u64,
}

impl StrokeCount {
    /// The count from an impact on, at a time in drive periods.
    pub const fn after_impact(impact: f64) -> Self {
        Self {
            last: impact,
            missed: 0,
        }
    }

    /// Counts the strokes missed before an impact at a time in drive periods.
    pub fn record_impact(&mut self, time: f64) {
        self.missed = self.missed_strokes(time);
        self.last = time;
    }

    /// Strokes missed up to a time in drive periods.
    pub fn missed_strokes(&self, time: f64) -> u64 {
        self.missed + ((time - self.last).round() as u64).saturating_sub(1)
    }
}
