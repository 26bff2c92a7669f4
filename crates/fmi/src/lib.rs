//! The boundary of FMI 2.0 and 3.0 for any unit, for co-simulation and model exchange, and the packager that writes its FMU.
//!
//! A [`Unit`] is a table of variables ([`variable`]) and a motion that can be advanced. The XML
//! ([`description`]), the documentation, the package ([`package`]) and its parameters as a file of their own
//! ([`parameter_set`]) follow from the table, and
//! [`export_fmi2`] and [`export_fmi3`] give the unit the C functions of a standard ([`v2`], [`v3`]). `Instance` is one running unit
//! in safe Rust; `v2`, `v3`, what they are made of (`abi`) and the block of start values are the only unsafe code.

#[macro_use]
#[doc(hidden)]
pub mod abi;
mod blob;
mod block;
mod derivatives;
pub mod description;
mod document;
mod element;
mod event;
mod exchange;
mod fault;
mod guid;
mod imprint;
mod instance;
mod lifecycle;
mod log;
mod options;
pub mod package;
pub mod parameter_set;
mod quantity;
mod reading;
mod reference;
pub mod rows;
mod sensitivity;
mod setting;
pub mod si;
mod signal;
mod solving;
mod standard;
mod step;
mod table;
mod terminal;
mod unit;
pub mod v2;
pub mod v3;
pub mod variable;

pub use block::Block;
pub use guid::{guid_of, library_guid};
pub use imprint::{Imprint, TextError};
pub use options::Options;
pub use quantity::{Enumeration, Item, Quantity, item};
pub use sensitivity::slope;
pub use signal::{Derivatives, HIGHEST_ORDER};
pub use standard::Standard;
pub use table::Table;
pub use terminal::{Flow, Terminal};
pub use unit::{About, Advance, Clock, Events, Known, Outcome, Row, State, StateSpace, Unit};
