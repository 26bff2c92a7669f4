//! Many motions at once, one per lane of the processor's vector registers.
//!
//! The lanes go in lock-step through the same work, phase after phase: those that are in a phase scan windows of time
//! until each stands before one that may hold the phase's end; then all decide about that window, guess the crossing
//! from the cubic through its ends, take the exact flow to the guess and a step of Newton's method from there. Through a
//! phase with several ends they take a direct step, where the velocity keeps its sign up to the one that it leads to. Contacts under
//! a power law (n = 3/2, 2 or 5/2) go in Taylor steps, and wait for each other, since they take long. What a
//! lane concludes it concludes by certificates as the safe engine does, [`Motion`](softstop::internals::Motion); what
//! lies within rounding of two answers, or is not a plain crossing (rest, sticking, chatter), is handed to the safe
//! engine up to the end of the drive period. Machines with other power laws go there altogether.
//!
//! Motions that settle are leapt over, unless somebody watches them: those that meet nothing any more, and those
//! whose returns to the same impact provably lead to a limit past no other face.
//!
//! A lane turns cos and sin of the drive angle on with the motion, and takes them anew from the time since the
//! beginning of its drive period every few periods of its own: the drive never drifts, and a motion does not depend on
//! its neighbours, nor on the width of the registers. Nothing in the loop calls the mathematical
//! library, and no closure stands in it: one that is not inlined would lose the instruction set.

mod certificate;
mod constants;
mod contact;
mod contraction;
mod cubic;
mod cycle;
mod decide_window;
mod direct_step;
mod dispatch;
mod engine;
mod guard;
mod guard_interval;
mod job;
mod lanes;
mod law;
mod leap;
mod local;
mod machine;
mod observer;
mod outline;
mod parts;
mod place;
mod power;
mod reach;
mod registers;
mod release;
mod repeat;
mod returns;
mod root;
mod round;
mod run;
mod safe;
mod scan;
mod search;
mod state;
mod task;
mod taylor;
mod window;

pub use job::{Instructions, Job, Outcome};
pub use machine::Machine;
pub use observer::BatchObserver;
pub use registers::Registers;
pub use run::{run, run_parallel, run_with};
