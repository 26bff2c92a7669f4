//! What the rows of the table are made of.

use softstop_fmi::variable::{Dependencies, Variable};

use crate::machine::Machine;
use crate::tangent::Tangent;

pub(super) use softstop_fmi::rows::*;

/// One row of the table.
pub(crate) type Row = Variable<Machine, Tangent>;

/// Dependencies of an output that the forces on the mass change at once.
pub(super) const fn at_once(initial: &'static [&'static str]) -> Dependencies {
    let inputs = &["force", "base.acceleration", "drive.amplitude"];
    Dependencies { inputs, initial }
}

/// Dependencies of an output that the amplitude of the drive changes at once.
pub(super) const fn with_drive(initial: &'static [&'static str]) -> Dependencies {
    let inputs = &["drive.amplitude"];
    Dependencies { inputs, initial }
}
