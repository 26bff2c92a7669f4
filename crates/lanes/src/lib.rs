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
//! whose returns to the same impact provably lead to a limit past no other guard.
//!
//! A lane turns cos and sin of the drive angle on with the motion, and takes them anew from the time since the
//! beginning of its drive period every few periods of its own: the drive never drifts, and a motion does not depend on
//! its neighbours, nor on the width of the registers. Nothing in the loop calls the mathematical
//! library, and no closure stands in it: one that is not inlined would lose the instruction set.
//!
//! # What limits the speed
//!
//! Instructions of 16 motions with AVX-512 from impact to impact, mean of the drive periods 17 to 32. The machine is the
//! paper's at eta 0.95 to 1.4, from (0, 14) without a strip and from (6.9, 9.5) with one:
//!
//! | | unloaded | with a strip |
//! |---|---|---|
//! | fused multiply-adds | 908 | 1,538 |
//! | additions, multiplications | 1,064 | 1,663 |
//! | divisions, roots | 46 | 80 |
//! | comparisons, minima, signs | 511 | 653 |
//! | moves, broadcasts, blends, masks | 1,967 | 2,790 |
//! | scalar: addresses, masks, jumps | 1,146 | 1,243 |
//! | all | 5,643 | 7,968 |
//!
//! That is 353 instructions for a motion and a period. A period takes 2 decisions about a window, with a strip also 2.6
//! direct steps. A decision for 8 lanes computes some 540 operations, in 1.7 rounds of 480 instructions. Of all periods
//! in the sweep of `softstop-lab throughput` 72 % are extrapolated. The rest is chaos (12 % of the motions and over a
//! third of the time) and the first some 60 periods of the others.
//!
//! A prototype in C++ for this machine alone (closed form, 40 samples a period), on motions at neighbouring frequencies:
//!
//! | eta from | 0.97 | 1.05 | 1.15 | 1.25 | 1.36 |
//! |---|---|---|---|---|---|
//! | instructions | 4,265 | 4,238 | 3,659 | 3,294 | 6 |
//! | of them multiplications, fused or not | 1,225 | 1,125 | 942 | 862 | 3 |
//! | prototype: instructions | 2,922 | 2,576 | 2,445 | 2,531 | 675 |
//! | prototype: multiplications | 1,129 | 1,090 | 1,042 | 1,091 | 253 |
//!
//! At 1.36 nothing meets the stop any more. In chaos lanes wait for each other's decisions. The prototype has no proofs (a
//! seventh of all operations at eta 1.15; it misses 15 of 224,676 impacts), no tests whether a motion repeats (an eighth),
//! no other machines (damping, stiffness, side and restitution are constants there), no ends of drive periods and jobs,
//! and no laws from the machine's numbers (0.5 us, as much as 13 of the 200 periods). Instructions were counted by single
//! steps or by callgrind, which no command of the project repeats. `engine.rs` lists what was tried and dropped.

mod arc_bounds;
mod batch_observer;
mod bounce_trains;
mod contact_release;
mod contact_series;
mod contact_state;
mod contact_step_length;
mod contraction_certificate;
mod contraction_norm;
mod cubic;
mod cycle;
mod cycle_state;
mod cycle_windows;
mod decide_window;
mod direct_step;
mod engine;
mod extrapolate_limit;
mod follow_contacts;
mod free_and_steady_parts;
mod guard_interval;
mod guard_search;
mod hand_over_lanes;
mod instruction_set;
mod job;
mod lane_laws;
mod lane_states;
mod lanes;
mod local_taylor;
mod lowered_machine;
mod move_lanes;
mod nearby_zero;
mod phase_constants;
mod phase_guards;
mod phase_order;
mod polynomial;
mod post_impact_state;
mod record_returns;
mod return_bounds;
mod return_history;
mod return_settings;
mod run_batch;
mod safe_engine;
mod scan_windows;
mod sine_cosine;
mod skip_contactless;
mod window_ahead;
mod window_guard;

pub use batch_observer::BatchObserver;
pub use instruction_set::{InstructionLimit, Registers};
pub use job::{Job, Outcome};
pub use lowered_machine::LoweredMachine;
pub use run_batch::{run, run_one_by_one, run_parallel, run_with};
