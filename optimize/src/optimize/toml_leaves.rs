//! Values in tables of TOML, by their dotted names.

use serde::de::DeserializeOwned;
use softstop::internals::{did_you_mean, nearest_name, with_near_word};
use softstop::{Machine, Parameter};
use softstop_console::failure::Failure;
use toml::{Table, Value};

/// Keys of a table that says something of one parameter.
const WORDS: [&str; 10] = [
    "values",
    "follows",
    "factor",
    "offset",
    "least",
    "most",
    "half_width",
    "distribution",
    "cpk",
    "sigma",
];

/// Lists of slopes, which are no numbers.
const SLOPES: [&str; 4] = [
    "stop.loading",
    "stop.unloading",
    "stop.below.loading",
    "stop.below.unloading",
];

/// The parameter of a key in a table of a task, which may be changed by itself, and the key's unit in the machine's own.
///
/// # Errors
/// [`Failure::Usage`] naming table and key.
pub(super) fn free_parameter(
    machine: &Machine,
    table: &str,
    key: &str,
) -> Result<(Parameter, f64), Failure> {
    machine.free_parameter(key).map_err(|error| {
        let what = slopes(key).or_else(|| misspelt_word(machine, key));
        Failure::usage(format!("{table}.{}", what.unwrap_or(error.to_string())))
    })
}

/// What a table of words says of a key, unless a word has the wrong value, or one is missing.
///
/// # Errors
/// [`Failure::Usage`] naming an unknown word, and the known one that it may mean.
pub(super) fn read_words<T: DeserializeOwned>(
    key: &str,
    words: &Table,
) -> Result<Option<T>, Failure> {
    match words.clone().try_into() {
        Ok(said) => Ok(Some(said)),
        Err(error) => match error.message() {
            message if message.starts_with("unknown ") => Err(Failure::usage(format!(
                "{key}: {}",
                with_near_word(message)
            ))),
            _ => Ok(None),
        },
    }
}

/// Why a key of slopes stands for no parameter; none if it is another one.
pub(super) fn slopes(key: &str) -> Option<String> {
    let is_slopes = SLOPES.iter().any(|it| key.starts_with(it));
    is_slopes.then(|| {
        format!("{key}: the slopes of a piecewise linear stop stay as the machine states them: only single numbers can vary")
    })
}

/// What a key may mean that ends with a word which says nothing of its parameter.
fn misspelt_word(machine: &Machine, key: &str) -> Option<String> {
    let (parameter, word) = key.rsplit_once('.')?;
    machine.parameter(parameter).ok()?;
    let meant = nearest_name(word, &WORDS)?;
    Some(format!("{key}: unknown word{}", did_you_mean(Some(meant))))
}

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
