//! The impact oscillator as a unit of FMI 2.0 and 3.0, for co-simulation and model exchange.
//!
//! One table (`table`) says what the unit offers: value references, names, units, ranges and how each
//! value is read; [`StartValues`] are scenes in other words, and [`Machine`] is the motion. All else,
//! the XML, the package and the C functions, is `softstop-fmi`'s.

mod drive;
mod exchange;
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
pub use softstop_fmi::{Options, Standard, description, guid_of, package, parameter_set};
pub use start::{NotServed, StartValues, slot};
pub use tangent::Tangent;

/// The functions of FMI 2.0, which its library exports.
pub mod fmi2 {
    softstop_fmi::fmi2_functions!(crate::Machine);
}

/// The functions of FMI 3.0, which its library exports.
pub mod fmi3 {
    softstop_fmi::fmi3_functions!(crate::Machine);
}

/// Name, description and start values of an FMU.
pub type Imprint = softstop_fmi::Imprint<Machine>;

/// All variables.
pub fn table() -> &'static softstop_fmi::Table<Machine, Tangent> {
    &Machine::about().table
}

/// The GUID of this very library.
pub fn library_guid() -> String {
    softstop_fmi::library_guid::<Machine>()
}
