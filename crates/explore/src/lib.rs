//! The commands that look at one machine, each with its own picture: [`orbit`], [`zone`], [`simulate`],
//! [`motions`], [`continuation`], [`sweep`], [`basin`], [`stops`] and [`fidelity`].
#![forbid(unsafe_code)]

pub mod basin;
pub mod continuation;
pub mod fidelity;
pub mod motions;
pub mod orbit;
pub mod simulate;
pub mod stops;
pub mod sweep;
pub mod zone;
