//! Variables of the table by type, range and name.

use softstop_fmi::Row;
use softstop_fmi::variable::Kind;
use softstop_fmu::{Machine, table};

use super::calls::{Type, reference};

pub fn is(kind: &Kind, wanted: Type) -> bool {
    match kind {
        Kind::Real(_) => wanted == Type::Real,
        Kind::Count { .. } | Kind::Enumeration(_) => wanted == Type::Integer,
        Kind::Boolean => wanted == Type::Boolean,
    }
}

pub fn find(reference: u32, wanted: Type) -> Option<&'static Row<Machine>> {
    table()
        .by_reference(reference)
        .filter(|variable| is(&variable.kind, wanted))
}

pub fn in_range(kind: &Kind, value: f64) -> bool {
    match kind {
        Kind::Real(_) => kind.contains(value),
        Kind::Count { min, max } => {
            value >= f64::from(*min) && max.is_none_or(|max| value <= f64::from(max))
        }
        Kind::Enumeration(items) => items.items.iter().any(|i| f64::from(i.value) == value),
        Kind::Boolean => true,
    }
}

pub fn is_initial(vr: u32) -> bool {
    vr == reference("initial.position") || vr == reference("initial.velocity")
}
