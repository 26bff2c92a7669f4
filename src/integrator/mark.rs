//! Where an advance begins.

use super::clock::Instant;
use super::motion::Motion;
use super::tallies::Counts;

/// Where the last advance began.
#[derive(Debug, Clone)]
pub(super) enum Mark {
    /// On the arc that is under way.
    OnArc(Instant),
    /// Some crossings ago.
    Before(Box<Origin>),
}

/// A machine as it was before an advance.
#[derive(Debug, Clone)]
pub(super) struct Origin {
    pub motion: Motion,
    pub counts: Counts,
    pub now: f64,
}
