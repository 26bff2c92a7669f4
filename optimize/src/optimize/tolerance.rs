//! What of a design cannot be made exactly: the table `[tolerance]`.

use softstop::Machine;
use softstop_console::failure::Failure;
use toml::{Table, Value};

use super::toml_leaves::{leaves, number};
use crate::design::problem::{Tolerance, Width};

/// `[tolerance]`: half-widths in the machine's own units, or shares of the value such as `"2 %"`.
pub(super) fn tolerances(machine: &Machine, table: &Table) -> Result<Vec<Tolerance>, Failure> {
    let mut found: Vec<Tolerance> = Vec::new();
    for (name, value) in leaves(table) {
        let stated = machine.stated(&name);
        let (parameter, unit) =
            stated.map_err(|error| Failure::usage(format!("tolerance.{error}")))?;
        let width = match value {
            Value::String(share) => {
                let share = share.trim().strip_suffix('%').map(str::trim);
                let share = share.and_then(|share| share.parse().ok());
                share.map(|share: f64| Width::Share(share / 100.0))
            }
            value => number(value).map(|width| Width::Own(width * unit)),
        };
        let width = width.filter(Width::is_allowed).ok_or_else(|| {
            Failure::usage(format!(
                "tolerance.{name} = {value}: must be a half-width, finite and >= 0, or a share such as \"2 %\", below 100 %"
            ))
        })?;
        if found.iter().any(|other| other.parameter == parameter) {
            return Err(Failure::usage(format!("tolerance.{name}: is given twice")));
        }
        found.push(Tolerance { parameter, width });
    }
    Ok(found)
}
