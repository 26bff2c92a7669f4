//! Values in tables of TOML, by their dotted names.

use softstop_console::failure::Failure;
use toml::{Table, Value};

/// Visits the values of a table and of those in it that are not values themselves, by their dotted names.
pub(super) fn flatten(
    table: &Table,
    path: &str,
    is_value: &impl Fn(&Table) -> bool,
    visit: &mut impl FnMut(String, &Value) -> Result<(), Failure>,
) -> Result<(), Failure> {
    for (key, value) in table {
        let name = format!("{path}{key}");
        match value {
            Value::Table(inner) if !is_value(inner) => {
                flatten(inner, &format!("{name}."), is_value, visit)?;
            }
            value => visit(name, value)?,
        }
    }
    Ok(())
}

/// A number, whole or not.
pub(super) fn number(value: &Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| value.as_integer().map(|integer| integer as f64))
}

/// `[low, high]`.
pub(super) fn range(value: &Value) -> Option<[f64; 2]> {
    match value.as_array()?.as_slice() {
        [low, high] => Some([number(low)?, number(high)?]),
        _ => None,
    }
}
