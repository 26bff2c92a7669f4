//! Where an advance begins.

use serde::{Deserialize, Serialize};

use super::clock::Instant;
use super::motion::Motion;
use super::tallies::Counts;

/// Where the last advance began; the motion is itself, or data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum Checkpoint<M = Motion> {
    /// On the arc that is under way.
    OnArc(Instant),
    /// Some crossings ago.
    Before(Box<CheckpointState<M>>),
}

/// A machine as it was before an advance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct CheckpointState<M = Motion> {
    pub motion: M,
    pub counts: Counts,
    pub now: f64,
}

impl<M> Checkpoint<M> {
    /// This checkpoint with its motion made into another form.
    pub fn map<N, E>(&self, motion: impl Fn(&M) -> Result<N, E>) -> Result<Checkpoint<N>, E> {
        Ok(match self {
            Self::OnArc(instant) => Checkpoint::OnArc(*instant),
            Self::Before(origin) => Checkpoint::Before(Box::new(CheckpointState {
                motion: motion(&origin.motion)?,
                counts: origin.counts,
                now: origin.now,
            })),
        })
    }
}
