//! Many motions at once, one per lane of the processor's vector registers.
//!
//! The lanes go in lock-step through the same work, from crossing to crossing: they scan windows of time, counted
//! from the last crossing, until each has met one that may hold the next; then all expand their motion about the
//! instant before it, decide, and find the crossing. What a lane concludes it concludes by the certificates of the
//! safe engine, [`Motion`](softstop::internals::Motion); what lies within rounding of two answers, or is not a plain crossing (rest, sticking, chatter),
//! is handed to the safe engine up to the end of the drive period. Machines with power laws go there altogether.
//!
//! A lane keeps the time since the beginning of its drive period, and takes cos and sin of the drive angle from
//! it anew before each scan: the drive never drifts. Nothing in the loop calls the mathematical library.

mod cubic;
mod engine;
mod guard;
mod job;
mod judge;
mod lanes;
mod law;
mod local;
mod look;
mod machine;
mod parts;
mod registers;
mod root;
mod run;
mod safe;
mod scan;
mod state;
mod taylor;
mod watch;

pub use job::{Instructions, Job, Outcome};
pub use machine::Machine;
pub use registers::Registers;
pub use run::{run, run_parallel, run_with};
pub use watch::Watch;
