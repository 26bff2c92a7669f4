//! Periodic motions of impact oscillators and what becomes of them: [`orbit`] (z = p/n, Floquet
//! multipliers, exponents) → [`continuation`] (branches, folds, flips, grazings) → [`zone`] (where
//! impacts and rest coexist) → [`attractors`], [`basin`], [`sweep`], [`transitions`] (what is seen from
//! many starts), told in one vocabulary ([`motion`]), and [`models`] (how simple a model of a scene may be).
#![forbid(unsafe_code)]

pub mod attractors;
pub mod basin;
pub mod continuation;
mod extremes;
pub mod models;
pub mod motion;
pub mod orbit;
mod peak;
pub mod sweep;
pub mod transitions;
pub mod watch;
pub mod zone;

/// What sibling crates share beyond this page, without any promise.
#[doc(hidden)]
pub mod internals {
    pub use crate::orbit::turn::turns;
    pub use crate::peak::highest;
}

pub use nalgebra;
pub use softstop;
