//! The impact oscillator as a co-simulation unit of FMI 2.0 and 3.0.
//!
//! One table (`table`) says what the unit offers: value references, names, units, ranges and how each
//! value is read; [`StartValues`] are scenes in other words, and [`Machine`] is the motion. All else,
//! the XML, the package and the C functions, is `softstop-fmi`'s.

mod drive;
mod external;
mod machine;
mod signal;
mod start;
mod step;
mod table;
mod tangent;
mod unit;
mod units;

pub use machine::Machine;
use softstop_fmi::Unit;
pub use softstop_fmi::{Standard, description, guid_of, package, parameter_set};
pub use start::{NotServed, StartValues, slot};
pub use tangent::Tangent;

/// Name, description and start values of an FMU.
pub type Imprint = softstop_fmi::Imprint<Machine>;

/// All variables.
pub fn table() -> &'static softstop_fmi::Table<Machine, Tangent> {
    &Machine::about().table
}

/// The GUID of this very library, or nothing if its description cannot be written.
pub fn library_guid() -> Option<String> {
    softstop_fmi::library_guid::<Machine>()
}
