//! Units that make a machine of softstop.fmu: its drive and its feeder.

mod difference;
mod drive;
mod extrapolation;
mod feeder;
mod package;
mod signal;

pub use difference::Direction;
pub use drive::Drive;
pub use feeder::Feeder;
