//! Proofs by interval arithmetic that periodic motions of impact oscillators exist, are the only ones near, are stable, and
//! cross nothing but what their sequence says; and of their folds, flips and grazings.
//!
//! [`Certificate::new`] takes a motion that floating point has found. [`motion`] writes it from event to event: the unknowns
//! are drive angle, position and velocity of each event, the equations are the closed forms of the arcs between. [`krawczyk`] proves a
//! zero of these in [`interval`] arithmetic, [`arcs`] that the arcs end where the sequence says.
#![forbid(unsafe_code)]

mod approximate;
pub mod arcs;
mod certificate;
pub mod elementary;
pub mod interval;
pub mod krawczyk;
pub mod machine;
pub mod motion;
pub mod number;

pub use approximate::Touch;
pub use certificate::{Certificate, Claim, ProvenEvent};
pub use interval::Interval;

use softstop::MotionError;
use thiserror::Error;

/// Why there is no proof.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ProofError {
    /// The machine or its motion is of a kind that is not treated.
    #[error("no proof: {0}")]
    Unsupported(&'static str),
    /// Newton's method does not converge.
    #[error("no proof: Newton's method finds no such motion near the one found")]
    NoConvergence,
    /// Krawczyk's test fails.
    #[error("no proof: Krawczyk's test holds in no box around the motion")]
    NoBox,
    /// The motion may repeat after fewer drive periods.
    #[error("no proof: the motion may repeat after fewer drive periods")]
    ShorterPeriod,
    /// An arc does not lead to the event at its end.
    #[error("no proof: arc {arc} does not lead to the event at its end")]
    Sequence {
        /// The arc, counted from 0.
        arc: usize,
    },
    /// Another event on an arc is not excluded.
    #[error("no proof: another event on arc {arc} is not excluded")]
    NotClear {
        /// The arc, counted from 0.
        arc: usize,
    },
    /// Trace or determinant of the monodromy matrix have no bounds.
    #[error("no proof: trace and determinant of the monodromy matrix have no bounds")]
    Unbounded,
    /// The motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
}
