//! Where an arc ends: the first crossing of any guard, guaranteed.
//!
//! The motion is scanned in windows. A window is passed only when a bound on the fourth derivative proves that no guard
//! rises through zero in it; otherwise it is halved down to the reach of one Taylor polynomial, on which the first rise
//! is found with a certificate. Nothing is concluded from the signs at window ends alone.

mod first_crossing;
mod first_rise;
mod guard;
mod guard_ends;
mod node_derivatives;
mod rise_verdict;
mod single_rise;
mod step_crossing;

pub use first_crossing::first_crossing;
pub use guard::Guard;
pub(crate) use node_derivatives::is_clear_by_start_derivatives;

use serde::{Deserialize, Serialize};

use crate::flow::ScanNode;

/// A crossing found on an arc: when, of which guard, and in which state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FoundCrossing {
    /// Time since departure in s.
    pub elapsed: f64,
    /// Which of the guards it is.
    pub guard: usize,
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
}

/// What a search has shown of the first crossing on an arc.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum NextEvent {
    /// This crossing is the first.
    Crossing(FoundCrossing),
    /// There is none up to the node that the search has reached.
    ClearUntil(ScanNode),
    /// There is none up to the end of the course, this many seconds after departure.
    Ends(f64),
    /// There is none at all.
    Never,
    /// The motion left the range of floating-point numbers.
    Unbounded(ScanNode),
}
