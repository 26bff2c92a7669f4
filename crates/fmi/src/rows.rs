//! What the rows of a table are made of.

use crate::quantity::Quantity;
use crate::variable::{Access, Dependencies, Kind, Reading, RealKind, Slot, Value, Variable};

/// A number far above any machine's, below which no intermediate result overflows.
pub const LARGE: f64 = 1e12;
/// Stands for "greater than zero" in ranges that the standard can only close.
pub const SMALL: f64 = 1e-12;

/// A real number of a quantity.
pub const fn real(quantity: &'static Quantity) -> Kind {
    Kind::Real(RealKind::any(Some(quantity)))
}

/// A real number of a quantity within a range.
pub const fn within(quantity: &'static Quantity, min: f64, max: f64) -> Kind {
    between(Some(quantity), min, max)
}

/// A bare number within a range.
pub const fn bare(min: f64, max: f64) -> Kind {
    between(None, min, max)
}

const fn between(quantity: Option<&'static Quantity>, min: f64, max: f64) -> Kind {
    Kind::Real(RealKind {
        min: Some(min),
        max: Some(max),
        ..RealKind::any(quantity)
    })
}

/// A kind with this order of magnitude.
pub const fn nominal(mut kind: Kind, nominal: f64) -> Kind {
    if let Kind::Real(real) = &mut kind {
        real.nominal = Some(nominal);
    }
    kind
}

/// A kind that is shown in this unit by default.
pub const fn shown_in(mut kind: Kind, unit: &'static str) -> Kind {
    if let Kind::Real(real) = &mut kind {
        real.display_unit = Some(unit);
    }
    kind
}

/// Any row.
pub const fn row<U, T>(
    reference: u32,
    name: &'static str,
    kind: Kind,
    access: Access<U, T>,
    description: &'static str,
) -> Variable<U, T> {
    Variable {
        reference,
        name,
        description,
        kind,
        access,
    }
}

/// A parameter that is set before the start.
pub const fn fixed<U, T>(
    reference: u32,
    name: &'static str,
    slot: Slot,
    kind: Kind,
    description: &'static str,
) -> Variable<U, T> {
    let tunable = false;
    let access = Access::Parameter { slot, tunable };
    row(reference, name, kind, access, description)
}

/// A parameter that may be set between steps, too.
pub const fn tunable<U, T>(mut row: Variable<U, T>) -> Variable<U, T> {
    if let Access::Parameter { tunable, .. } = &mut row.access {
        *tunable = true;
    }
    row
}

/// A real output that varies continuously.
pub const fn continuous<U, T>(
    reference: u32,
    name: &'static str,
    kind: Kind,
    depends: Dependencies,
    (value, tangent): Reading<U, T>,
    derivatives: &'static [Value<U>],
    description: &'static str,
) -> Variable<U, T> {
    let access = Access::Continuous {
        value,
        derivatives,
        tangent,
        depends,
    };
    row(reference, name, kind, access, description)
}

/// A real output that changes at events only.
pub const fn discrete<U, T>(
    reference: u32,
    name: &'static str,
    kind: Kind,
    (value, tangent): Reading<U, T>,
    description: &'static str,
) -> Variable<U, T> {
    let access = Access::Discrete {
        value,
        tangent,
        depends: after(&[]),
    };
    row(reference, name, kind, access, description)
}

/// A number of things that only grows at events.
pub const fn count<U, T>(
    reference: u32,
    name: &'static str,
    value: fn(&U) -> i32,
    description: &'static str,
) -> Variable<U, T> {
    let depends = after(&[]);
    let kind = Kind::Count { min: 0, max: None };
    let access = Access::Integer { value, depends };
    row(reference, name, kind, access, description)
}

/// Dependencies of an output that follows the motion only: no input changes it at once.
pub const fn after(initial: &'static [&'static str]) -> Dependencies {
    let inputs = &[];
    Dependencies { inputs, initial }
}
