//! How much work an advance may cost.

use std::ops::ControlFlow;

use super::Observer;

/// Stops a motion once it has cost so much: work left, counted in scan windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort(u64);

/// Windows of an arc that are scanned before the observer is asked whether to go on.
pub(super) const CHUNK: u32 = 1 << 20;

impl Effort {
    /// About as much as scanning this many windows of time costs. A window is the reciprocal of the fastest of drive
    /// and free motion; a crossing costs as much as 64 of them, a Taylor step as much as 128.
    pub const fn windows(windows: u64) -> Self {
        Self(windows)
    }
}

impl Observer for Effort {
    fn progress(&mut self, windows: u64) -> ControlFlow<()> {
        self.0 = self.0.saturating_sub(windows);
        if self.0 == 0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}
