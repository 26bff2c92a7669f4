//! The task of `softstop optimize` as a TOML file: the names of the command line.

use std::path::PathBuf;

use serde::Deserialize;
use softstop_console::failure::Failure;
use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::Format;
use toml::{Table, Value};

use super::named::Named;

/// The file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Task {
    /// Machine file, seen from the task's folder, or `unloaded` or `loaded`.
    pub machine: Option<PathBuf>,
    /// Without or with a strip: the paper's machine.
    pub regime: Option<Regime>,
    /// Distance M from both ends of the zone as a share of its width, 0 to 0.5.
    pub margin: Option<f64>,
    /// Values held, by the keys of the machine's file.
    pub fix: Table,
    /// Ranges searched: `clearance = [2, 22]`.
    pub bounds: Table,
    /// The rest of the paper's machine.
    pub scene: SceneSettings,
    /// Seed of the search.
    pub seed: Option<u64>,
    /// Zones that the search may compute.
    pub evaluations: Option<u64>,
    /// Output folder.
    pub output: Option<PathBuf>,
    /// How to print the result.
    pub format: Option<Format>,
}

impl Task {
    /// What it says of the searched values, each as a range.
    pub(super) fn words(&self) -> Result<Vec<Named<[f64; 2]>>, Failure> {
        let mut words = Vec::new();
        for (table, read) in [
            (&self.fix, value as fn(&Value) -> Option<[f64; 2]>),
            (&self.bounds, range),
        ] {
            flatten(table, "", &mut |name, value| {
                let value = read(value).ok_or_else(|| {
                    Failure::usage(format!(
                        "{name} = {value}: fix holds a number, bounds a range [low, high]"
                    ))
                })?;
                words.push(Named { name, value });
                Ok(())
            })?;
        }
        Ok(words)
    }
}

/// Visits the values of a table and of those in it, by their dotted names.
fn flatten(
    table: &Table,
    path: &str,
    visit: &mut impl FnMut(String, &Value) -> Result<(), Failure>,
) -> Result<(), Failure> {
    for (key, value) in table {
        let name = format!("{path}{key}");
        match value {
            Value::Table(inner) => flatten(inner, &format!("{name}."), visit)?,
            value => visit(name, value)?,
        }
    }
    Ok(())
}

fn number(value: &Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| value.as_integer().map(|integer| integer as f64))
}

fn value(value: &Value) -> Option<[f64; 2]> {
    number(value).map(|number| [number, number])
}

fn range(value: &Value) -> Option<[f64; 2]> {
    match value.as_array()?.as_slice() {
        [low, high] => Some([number(low)?, number(high)?]),
        _ => None,
    }
}
