//! FMI 2.0: its 34 C functions for co-simulation, and the 10 more for model exchange, for any unit.
//!
//! Here the functions are generic; [`export_fmi2`] makes the C functions of one unit.
#![allow(
    unsafe_code,
    non_snake_case,
    clippy::missing_safety_doc,
    reason = "the C interface: pointers of the importer, exported symbols, and the standard's names and contracts"
)]

mod functions;
mod host;

pub use functions::*;
pub use host::{CallbackFunctions, EventInfo, Logger};
