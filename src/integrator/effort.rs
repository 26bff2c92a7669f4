//! How much work an advance may cost, and how often a motion asked for the law of force.

use std::ops::ControlFlow;

use super::{Arc, Observer};
use crate::flow::DEGREE;

/// Stops a motion once it has cost so much: work left, counted in scan windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort(u64);

/// Windows of an arc that are scanned before the observer is asked whether to go on.
pub(super) const WINDOWS_PER_QUESTION: u32 = 1 << 20;

impl Effort {
    /// The effort that scanning this many windows of time costs, about. A window is the reciprocal of the fastest of drive
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

/// Counts what a motion takes: the same on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Evaluations {
    /// Windows that were scanned, and Taylor steps.
    pub steps: u64,
    /// States of a closed form count as one each, a Taylor polynomial as its degree.
    pub evaluations: u64,
}

impl Observer for Evaluations {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let windows = if arc.course.taylor_step().is_some() {
            0
        } else {
            (elapsed / arc.course.flow.window).ceil() as u64
        };
        self.steps += windows.max(1);
        self.evaluations += windows + DEGREE as u64;
    }
}
