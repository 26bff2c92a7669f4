//! What the rows of the table are made of.

use softstop::tangent::Sensitivity;

use crate::start::{SLOPES, Slot};
use crate::units::{Enumeration, Quantity};
use crate::variables::{Access, Dependencies, Kind, RealKind, Variable, View};

/// A number far above any machine's, below which no intermediate result overflows.
pub(super) const LARGE: f64 = 1e12;
/// Stands for "greater than zero" in ranges that the standard can only close.
pub(super) const SMALL: f64 = 1e-12;

pub(super) const fn real(quantity: &'static Quantity) -> RealKind {
    RealKind {
        quantity: Some(quantity),
        display_unit: None,
        min: None,
        max: None,
        nominal: None,
    }
}

pub(super) const fn within(quantity: &'static Quantity, min: f64, max: f64) -> RealKind {
    RealKind {
        min: Some(min),
        max: Some(max),
        ..real(quantity)
    }
}

pub(super) const fn bare(min: f64, max: f64) -> RealKind {
    RealKind {
        quantity: None,
        display_unit: None,
        min: Some(min),
        max: Some(max),
        nominal: None,
    }
}

pub(super) const fn nominal(kind: RealKind, nominal: f64) -> RealKind {
    RealKind {
        nominal: Some(nominal),
        ..kind
    }
}

pub(super) const fn shown_in(kind: RealKind, unit: &'static str) -> RealKind {
    RealKind {
        display_unit: Some(unit),
        ..kind
    }
}

const fn parameter(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: Kind,
    tunable: bool,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind,
        access: Access::Parameter { slot, tunable },
    }
}

pub(super) const fn fixed(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: RealKind,
    description: &'static str,
) -> Variable {
    parameter(reference, name, slot, Kind::Real(kind), false, description)
}

pub(super) const fn tunable(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: RealKind,
    description: &'static str,
) -> Variable {
    parameter(reference, name, slot, Kind::Real(kind), true, description)
}

pub(super) const fn choice(
    reference: u32,
    name: &'static str,
    slot: Slot,
    items: &'static Enumeration,
    description: &'static str,
) -> Variable {
    let kind = Kind::Enumeration(items);
    parameter(reference, name, slot, kind, false, description)
}

pub(super) const fn flag(
    reference: u32,
    name: &'static str,
    slot: Slot,
    description: &'static str,
) -> Variable {
    parameter(reference, name, slot, Kind::Boolean, false, description)
}

/// How many elements of the arrays of slopes are in use.
pub(super) const fn slope_count(
    reference: u32,
    name: &'static str,
    slot: Slot,
    min: i32,
    description: &'static str,
) -> Variable {
    let kind = Kind::Count {
        min,
        max: Some(SLOPES as i32),
    };
    parameter(reference, name, slot, kind, false, description)
}

/// The rows of an array of fixed parameters, one element for each slope.
macro_rules! slopes {
    ($first:literal, $name:literal, $slot:expr, $kind:expr, $description:literal) => {
        slopes!(@rows $first, $name, $slot, $kind, $description; 1 2 3 4 5 6 7 8)
    };
    (@rows $first:literal, $name:literal, $slot:expr, $kind:expr, $description:literal;
        $($number:literal)*) => {{
        const ROWS: [Variable; SLOPES] = [$(fixed(
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
type Reading = (fn(&View) -> f64, fn(&Sensitivity) -> f64);

pub(super) const fn continuous(
    reference: u32,
    name: &'static str,
    kind: RealKind,
    (value, sensitivity): Reading,
    derivatives: &'static [fn(&View) -> f64],
    depends: Dependencies,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Real(kind),
        access: Access::Continuous {
            value,
            derivatives,
            sensitivity,
            depends,
        },
    }
}

pub(super) const fn discrete(
    reference: u32,
    name: &'static str,
    kind: RealKind,
    (value, sensitivity): Reading,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Real(kind),
        access: Access::Discrete { value, sensitivity },
    }
}

pub(super) const fn count(
    reference: u32,
    name: &'static str,
    value: fn(&View) -> i32,
    description: &'static str,
) -> Variable {
    Variable {
        reference,
        name,
        description,
        kind: Kind::Count { min: 0, max: None },
        access: Access::Integer {
            value,
            depends: after(&[]),
        },
    }
}

/// Dependencies of an output that follows the motion only: no input changes it at once.
pub(super) const fn after(initial: &'static [&'static str]) -> Dependencies {
    Dependencies {
        inputs: &[],
        initial,
    }
}

/// Dependencies of an output that the external force changes at once.
pub(super) const fn at_once(initial: &'static [&'static str]) -> Dependencies {
    Dependencies {
        inputs: &["force"],
        initial,
    }
}
