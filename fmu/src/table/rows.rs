//! What the rows of the table are made of.

use softstop_fmi::variable::{Dependencies, Kind, Variable};

use crate::machine::Machine;
use crate::start::slot::SLOPES;
use crate::tangent::Tangent;

pub(super) use softstop_fmi::rows::*;

/// One row of the table.
pub(crate) type Row = Variable<Machine, Tangent>;

/// How many elements of the arrays of slopes are in use.
pub(super) const fn count_of_slopes(min: i32) -> Kind {
    let max = Some(SLOPES as i32);
    Kind::Count { min, max }
}

/// The rows of an array of fixed parameters, one element for each slope.
macro_rules! slopes {
    ($first:literal, $name:literal, $slot:expr, $kind:expr, $description:literal) => {
        slopes!(@rows $first, $name, $slot, $kind, $description; 1 2 3 4 5 6 7 8)
    };
    (@rows $first:literal, $name:literal, $slot:expr, $kind:expr, $description:literal;
        $($number:literal)*) => {{
        const ROWS: [Row; SLOPES] = [$(fixed(
            $first + $number - 1,
            concat!($name, "[", $number, "]"),
            $slot.element($number - 1),
            $kind,
            $description,
        )),*];
        &ROWS
    }};
}
pub(super) use slopes;

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
