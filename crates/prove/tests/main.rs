//! Proofs and what they rest on.

mod proofs;
