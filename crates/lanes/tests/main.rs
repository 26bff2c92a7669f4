//! The tests of the lanes, as one program.

mod batch;
mod parallel;
mod random;
