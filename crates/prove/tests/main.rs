//! Proofs and what they rest on.

mod intervals;
mod proofs;
