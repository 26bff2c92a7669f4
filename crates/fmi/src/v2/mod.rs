//! FMI 2.0 for co-simulation: its 34 C functions, for any unit.
//!
//! Here the functions are generic; [`export`](crate::export) makes the C functions of one unit.
#![allow(
    unsafe_code,
    reason = "the C interface: pointers of the importer and exported symbols"
)]

mod component;
#[macro_use]
mod export;
mod functions;
mod guard;
mod pointers;

pub use component::{CallbackFunctions, Logger};
pub use functions::*;
#[doc(hidden)]
pub use libc::{c_char, c_int, c_uint, c_void, size_t};
