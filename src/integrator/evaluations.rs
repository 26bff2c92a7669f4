//! How often a motion asked for the law of force.

use super::{Arc, Observer};
use crate::flow::DEGREE;

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
