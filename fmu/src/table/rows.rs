//! What the rows of the table are made of.

use softstop_fmi::Quantity;
use softstop_fmi::variable::{Access, Dependencies, Kind, RealKind, Slot, Variable};

use crate::machine::Machine;
use crate::start::slot::SLOPES;
use crate::tangent::Tangent;

/// One row of the table.
pub(crate) type Row = Variable<Machine, Tangent>;

/// A number far above any machine's, below which no intermediate result overflows.
pub(super) const LARGE: f64 = 1e12;
/// Stands for "greater than zero" in ranges that the standard can only close.
pub(super) const SMALL: f64 = 1e-12;

pub(super) const fn real(quantity: &'static Quantity) -> Kind {
    Kind::Real(RealKind::any(Some(quantity)))
}

pub(super) const fn within(quantity: &'static Quantity, min: f64, max: f64) -> Kind {
    between(Some(quantity), min, max)
}

pub(super) const fn bare(min: f64, max: f64) -> Kind {
    between(None, min, max)
}

const fn between(quantity: Option<&'static Quantity>, min: f64, max: f64) -> Kind {
    Kind::Real(RealKind {
        min: Some(min),
        max: Some(max),
        ..RealKind::any(quantity)
    })
}

pub(super) const fn nominal(mut kind: Kind, nominal: f64) -> Kind {
    if let Kind::Real(real) = &mut kind {
        real.nominal = Some(nominal);
    }
    kind
}

pub(super) const fn shown_in(mut kind: Kind, unit: &'static str) -> Kind {
    if let Kind::Real(real) = &mut kind {
        real.display_unit = Some(unit);
    }
    kind
}

/// How many elements of the arrays of slopes are in use.
pub(super) const fn count_of_slopes(min: i32) -> Kind {
    let max = Some(SLOPES as i32);
    Kind::Count { min, max }
}

pub(super) const fn row(
    reference: u32,
    name: &'static str,
    kind: Kind,
    access: Access<Machine, Tangent>,
    description: &'static str,
) -> Row {
    Row {
        reference,
        name,
        description,
        kind,
        access,
    }
}

pub(super) const fn fixed(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: Kind,
    description: &'static str,
) -> Row {
    let tunable = false;
    let access = Access::Parameter { slot, tunable };
    row(reference, name, kind, access, description)
}

/// The same parameter, to be set between steps.
pub(super) const fn tunable(mut row: Row) -> Row {
    if let Access::Parameter { tunable, .. } = &mut row.access {
        *tunable = true;
    }
    row
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

/// How a real output and its derivative along a direction are read.
type Reading = (fn(&Machine) -> f64, fn(&Tangent) -> f64);

pub(super) const fn continuous(
    reference: u32,
    name: &'static str,
    kind: Kind,
    depends: Dependencies,
    (value, tangent): Reading,
    derivatives: &'static [fn(&Machine) -> f64],
    description: &'static str,
) -> Row {
    let access = Access::Continuous {
        value,
        derivatives,
        tangent,
        depends,
    };
    row(reference, name, kind, access, description)
}

pub(super) const fn discrete(
    reference: u32,
    name: &'static str,
    kind: Kind,
    (value, tangent): Reading,
    description: &'static str,
) -> Row {
    let access = Access::Discrete { value, tangent };
    row(reference, name, kind, access, description)
}

pub(super) const fn count(
    reference: u32,
    name: &'static str,
    value: fn(&Machine) -> i32,
    description: &'static str,
) -> Row {
    let depends = after(&[]);
    let kind = Kind::Count { min: 0, max: None };
    let access = Access::Integer { value, depends };
    row(reference, name, kind, access, description)
}

/// Dependencies of an output that follows the motion only: no input changes it at once.
pub(super) const fn after(initial: &'static [&'static str]) -> Dependencies {
    let inputs = &[];
    Dependencies { inputs, initial }
}

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
