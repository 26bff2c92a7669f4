//! What the C functions of both standards have in common: pointers, the guard against panics, the handle of an instance
//! with its log, states kept for the importer, and the macros that make C functions.
#![allow(
    unsafe_code,
    reason = "the C interface: pointers of the importer and exported symbols"
)]

pub(crate) mod component;
#[macro_use]
mod export;
pub(crate) mod guard;
pub(crate) mod pointers;
#[macro_use]
mod shared;
pub(crate) mod state;

pub use libc::{c_char, c_int, c_uint, c_void, size_t};
