//! The impact oscillator as an FMI 2.0 co-simulation unit, and the packager that writes it.
//!
//! One table ([`variables`]) says what the unit offers: value references, names, units, ranges and
//! how each value is read. The XML ([`model_description`]), the documentation and the C functions
//! all follow from it. [`Instance`] is one running unit in safe Rust; the module `ffi` puts the C
//! functions of the standard around it and is, with the block of start values, the only unsafe
//! code.

mod blob;
mod derivatives;
mod document;
mod error;
pub mod ffi;
mod guid;
mod instance;
mod log;
pub mod model_description;
pub mod package;
mod sensitivity;
mod settings;
pub mod start;
mod status;
mod step;
pub mod units;
mod values;
pub mod variables;

pub use error::Fault;
pub use guid::{guid_of, library_guid};
pub use instance::{Instance, Lifecycle};
pub use start::{NotServed, Slot, StartValues, library_start_values};
pub use status::Status;
pub use step::StepReport;
