//! Many motions at once, one per lane of the processor's vector registers.
//!
//! The lanes go in lock-step through the same work, from crossing to crossing: they scan windows of time, counted
//! from the last crossing, until each has met one that may hold the next; then all expand their motion about the
//! instant before it, decide, and find the crossing. What a lane concludes it concludes by the certificates of the
//! safe engine, [`Motion`](softstop::Motion); what lies within rounding of two answers, or is not a plain crossing (rest, sticking, chatter),
//! is handed to the safe engine up to the end of the drive period. Machines with power laws go there altogether.
//!
//! A lane keeps the time since the beginning of its drive period, and takes cos and sin of the drive angle from
//! it anew before each scan: the drive never drifts. Nothing in the loop calls the mathematical library.

mod engine;
mod guard;
mod judge;
mod lanes;
mod law;
mod look;
mod machine;
mod parallel;
mod registers;
mod root;
mod safe;
mod scan;
mod state;
mod taylor;
mod watch;

pub use machine::Machine;
pub use parallel::run_parallel;
pub use registers::Registers;
pub use watch::Watch;

use watch::Listener;

use softstop::error::MotionError;
use softstop::integrator::Start;

/// One motion to follow, from drive period 0 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Job {
    /// Which of the machines.
    pub machine: usize,
    /// State at time 0.
    pub start: Start,
    /// Drive periods to follow it.
    pub periods: u64,
}

/// What became of a job.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// State at the end.
    pub end: Start,
    /// Impacts on the way.
    pub impacts: u64,
    /// Drive periods that the safe engine followed, in part or whole.
    pub handed_over: u64,
    /// Why it ended early, if it did.
    pub error: Option<MotionError>,
}

/// The instruction set that the lanes use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Instructions {
    /// The widest that the processor has.
    Widest,
    /// At most 256-bit registers.
    Avx2,
    /// No vector instructions but those that every processor of its kind has.
    Portable,
    /// One motion after another, each alone in one register of at most 256 bits.
    OneByOne,
}

/// Follows all jobs on this thread.
///
/// # Panics
/// If a job names a machine that is not there.
pub fn run(machines: &[Machine], jobs: &[Job], watch: &mut impl Watch) -> Vec<Outcome> {
    run_with(Instructions::Widest, machines, jobs, watch)
}

/// The same with the instruction set chosen.
pub fn run_with(
    instructions: Instructions,
    machines: &[Machine],
    jobs: &[Job],
    watch: &mut impl Watch,
) -> Vec<Outcome> {
    engine::run(machines, jobs, Listener::of(watch), instructions)
}
