//! Values in tables of TOML, by their dotted names.

use toml::{Table, Value};

/// Keys of a table that says something of one parameter.
const WORDS: [&str; 7] = [
    "values",
    "follows",
    "factor",
    "least",
    "most",
    "half_width",
    "sigma",
];

/// What a table says of each parameter, by the dotted names of the parameters; `{ values = … }`, `{ follows = … }` and
/// `{ half_width = … }` are said of one.
pub(super) fn leaves(table: &Table) -> Vec<(String, &Value)> {
    let says = |value: &Table| WORDS.iter().any(|key| value.contains_key(*key));
    let mut all = Vec::new();
    for (key, value) in table {
        match value {
            Value::Table(inner) if !says(inner) => {
                let inner = leaves(inner).into_iter();
                all.extend(inner.map(|(name, value)| (format!("{key}.{name}"), value)));
            }
            value => all.push((key.clone(), value)),
        }
    }
    all
}

/// A number, whole or not.
pub(super) fn number(value: &Value) -> Option<f64> {
    let whole = || value.as_integer().map(|integer| integer as f64);
    value.as_float().or_else(whole)
}

/// A share as text, `"50 %"`.
pub(super) fn percent(value: &Value) -> Option<f64> {
    let text = value.as_str()?;
    let share: f64 = text.trim().strip_suffix('%')?.trim().parse().ok()?;
    Some(share / 100.0)
}
