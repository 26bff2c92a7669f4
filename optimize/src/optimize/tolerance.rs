//! What of a design cannot be made exactly: the table `[tolerance]`.

use serde::Deserialize;
use softstop::Machine;
use softstop::internals::plain_number;
use softstop_console::failure::Failure;
use toml::{Table, Value};

use super::toml_leaves::{free_parameter, leaves, number, percent, read_words};
use crate::design::problem::{Tolerance, Width};
use crate::robust::Distribution;

/// Standard deviations in the half-width of a tolerance for each 1 of the process capability Cpk, of a centred process.
const DEVIATIONS: f64 = 3.0;

/// `{ half_width = 1e-4, distribution = "normal", cpk = 1.33 }` or `{ sigma = 3e-5 }`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ToleranceTable {
    half_width: Option<Value>,
    sigma: Option<Value>,
    distribution: Option<Shape>,
    cpk: Option<f64>,
}

/// How values lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    /// Anywhere within the tolerance.
    Box,
    /// Normally.
    Normal,
}

impl ToleranceTable {
    /// The width as it is stated, and what it is the half of.
    fn read(self) -> Option<(Value, Distribution)> {
        let shape = self.distribution;
        match (self.half_width, self.sigma, self.cpk) {
            (None, Some(sigma), None) if shape != Some(Shape::Box) => {
                Some((sigma, Distribution::Normal(1.0)))
            }
            (Some(half_width), None, cpk) if shape == Some(Shape::Normal) => {
                let cpk = Some(cpk.unwrap_or(1.0)).filter(|cpk| (0.1..=10.0).contains(cpk))?;
                Some((half_width, Distribution::Normal(DEVIATIONS * cpk)))
            }
            (Some(half_width), None, None) => Some((half_width, Distribution::Box)),
            _ => None,
        }
    }
}

/// `[tolerance]`: half-widths in the machine's own units, or shares of the value such as `"2 %"`, of boxes or of normal
/// distributions.
pub(super) fn tolerances(machine: &Machine, table: &Table) -> Result<Vec<Tolerance>, Failure> {
    let mut found: Vec<Tolerance> = Vec::new();
    for (name, value) in leaves(table) {
        let (parameter, unit) = free_parameter(machine, "tolerance", &name)?;
        let said = number(value).map_or_else(|| value.to_string(), plain_number);
        let wrong = |what: &str| Failure::usage(format!("tolerance.{name} = {said}: {what}"));
        let (stated, distribution) = match value {
            Value::Table(words) => {
                let stated: Option<ToleranceTable> =
                    read_words(&format!("tolerance.{name}"), words)?;
                stated.and_then(ToleranceTable::read).ok_or_else(|| {
                    wrong(
                        "must be { half_width = NUMBER, distribution = \"normal\", cpk = NUMBER }, Cpk from 0.1 to 10 and 1 \
                         if it is not stated, { half_width = NUMBER } or { sigma = NUMBER }",
                    )
                })?
            }
            value => (value.clone(), Distribution::Box),
        };
        let share = percent(&stated).map(Width::Share);
        let width = share.or_else(|| Some(Width::Own(number(&stated)? * unit)));
        let width = width.filter(Width::is_allowed).ok_or_else(|| {
            wrong("must be a half-width, finite and >= 0, or a share such as \"2 %\", below 100 %")
        })?;
        if found.iter().any(|other| other.parameter == parameter) {
            return Err(Failure::usage(format!("tolerance.{name}: is given twice")));
        }
        found.push(Tolerance {
            parameter,
            width,
            distribution,
        });
    }
    Ok(found)
}
