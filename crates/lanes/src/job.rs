//! The jobs of a batch and their outcomes.

use super::batch_observer::ObserverHandle;
use super::lowered_machine::LoweredMachine;
use softstop::{MotionError, Start};

/// A motion to follow, from drive period 0 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Job {
    /// Which of the machines.
    pub machine: usize,
    /// State at time 0.
    pub start: Start,
    /// Drive periods to follow it.
    pub periods: u64,
}

/// End and counts of the motion of a job.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// State at the end.
    pub end: Start,
    /// Impacts on the way.
    pub impacts: u64,
    /// Crossings of all surfaces on the way: of the stop, the strip, corners, the wall, and reversals that change the law.
    pub crossings: u64,
    /// Drive periods that the safe engine followed, in part or whole.
    pub handed_over: u64,
    /// Drive periods that were leapt over, since nothing happens in them or each is like the one before.
    pub leapt: u64,
    /// Why it ended early, if it did.
    pub error: Option<MotionError>,
}

/// The jobs of a batch, the machines that they name, and the observer of their motions.
pub(super) struct Task<'a> {
    pub machines: &'a [LoweredMachine],
    pub jobs: &'a [Job],
    pub watch: ObserverHandle<'a>,
    /// Most lanes to use.
    pub at_once: usize,
}
