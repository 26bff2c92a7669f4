//! Units that make a machine of softstop.fmu: its drive.

mod difference;
mod drive;
mod extrapolation;
mod package;
mod signal;

pub use difference::Direction;
pub use drive::Drive;
