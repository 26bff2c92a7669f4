//! No more model than a scene needs: one machine with ever simpler stops, and how far each simpler model
//! is from it.
//!
//! A [`ModelHierarchy`] holds the models of one scene, each derived from it by the formulas of [`matching`] so that
//! it agrees with the scene's own contact ([`Contact`]) at one velocity, the *operating velocity*. What a
//! model gives are [`ObservedFigures`] of its motion, the bounds of its z = 1 motion among them
//! ([`StabilityBounds`](softstop_dynamics::zone::StabilityBounds));
//! [`ObservedFigures::error`] tells how far a [`Quantity`] of it is from that of the scene itself.

mod contact;
mod ladder;
pub mod matching;
mod observation;
mod operating;
mod quantity;

pub use contact::Contact;
pub use ladder::{ContactLaw, MatchedProperty, ModelHierarchy};
pub use observation::ObservedFigures;
pub use operating::{from_model, from_truth};
pub use quantity::{Quantity, cheapest};

use thiserror::Error;

use softstop::{MotionError, SceneError};

/// Why a rung has no model, or a model no answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FidelityError {
    /// No contact of this law behaves like the scene's own.
    #[error("no {rung} contact matches: {reason}")]
    Unmatched {
        /// The rung.
        rung: ContactLaw,
        /// Why not.
        reason: String,
    },
    /// The motion never touches the stop, so there is no velocity to match at.
    #[error("the motion has no impact, so there is no velocity at which to match")]
    NoImpact,
    /// Matching at a model's own velocity does not settle.
    #[error("matching at the model's own velocity does not settle: last {velocity} m/s")]
    Unsettled {
        /// The last before-impact velocity in m/s.
        velocity: f64,
    },
    /// A motion cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
}

impl From<SceneError> for FidelityError {
    fn from(error: SceneError) -> Self {
        Self::Motion(error.into())
    }
}
