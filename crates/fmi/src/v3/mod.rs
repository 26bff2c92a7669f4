//! FMI 3.0 for co-simulation and model exchange: all 75 C functions of the standard, for any unit.
//!
//! Here the functions are generic; [`export_fmi3`] makes the C functions of one unit. Those of scheduled
//! execution, and of what the units do not have, answer with an error and one log line.
#![allow(
    unsafe_code,
    non_snake_case,
    clippy::missing_safety_doc,
    clippy::too_many_arguments,
    reason = "the C interface: pointers of the importer, exported symbols, and the standard's names and contracts"
)]

mod absent;
mod arrays;
mod functions;
mod host;
mod intermediate;
mod values;

pub use absent::*;
pub use functions::*;
pub use host::{
    ClockUpdateCallback, IntermediateUpdateCallback, LogMessageCallback, PreemptionCallback,
};
pub use values::*;
