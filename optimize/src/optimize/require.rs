//! What a task requires of the design: the table `[require]`.

use serde::Deserialize;
use softstop::Machine;
use softstop_console::failure::Failure;
use softstop_dynamics::run_up::Way;
use toml::{Table, Value};

use super::objective::{known, lacks};
use super::toml_leaves::number;
use crate::design::figure::{Figure, Sense};
use crate::design::requirement::Requirement;

/// `{ least = 10, most = 12 }`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Bounds {
    least: Option<f64>,
    most: Option<f64>,
}

/// `[require]`, in SI units, and apart from it the least distance from both ends of the zone as a share of its width.
pub(super) fn requirements(
    machine: &Machine,
    table: &Table,
) -> Result<(Vec<Requirement>, Option<f64>), Failure> {
    let one = |(name, value): (&String, &Value)| {
        let figure = known("require.", name)?;
        let wrong = |what: &str| Failure::usage(format!("require.{name} = {value}: {what}"));
        let what = match figure {
            Figure::RunUp => "must be true or false, or how many ways there must be",
            _ => "must be a number, or { least = NUMBER, most = NUMBER }",
        };
        let (least, most) = match (value, figure.sense()) {
            (Value::Boolean(true), _) if figure == Figure::RunUp => (Some(1.0), None),
            (Value::Boolean(false), _) if figure == Figure::RunUp => (Some(0.0), None),
            (Value::Table(words), _) => {
                let bounds: Bounds = words.clone().try_into().map_err(|_| wrong(what))?;
                (bounds.least, bounds.most)
            }
            (value, sense) => match (number(value), sense) {
                (Some(least), Sense::Least) => (Some(least), None),
                (Some(most), Sense::Most) => (None, Some(most)),
                (None, _) => return Err(wrong(what)),
            },
        };
        let given = [least, most].into_iter().flatten();
        if given.clone().count() == 0 || given.clone().any(|bound| !bound.is_finite()) {
            return Err(wrong("must have a finite bound"));
        }
        if let (Some(least), Some(most)) = (least, most)
            && least > most
        {
            return Err(wrong("least must be <= most"));
        }
        allowed(figure, given).map_err(wrong)?;
        let si = |bound: f64| machine.to_si(figure.dimension(), bound);
        Ok(Requirement {
            figure,
            least: least.map(si),
            most: most.map(si),
        })
    };
    let all: Result<Vec<Requirement>, Failure> = table.iter().map(one).collect();
    let mut all = all?;
    for requirement in &all {
        if let Some(lacks) = lacks(machine, requirement.figure) {
            let name = requirement.figure.name();
            return Err(Failure::usage(format!(
                "require.{name}: this machine has no {lacks}"
            )));
        }
    }
    let share = all.extract_if(.., |it| it.figure == Figure::Share).next();
    match share {
        Some(share) if share.most.is_some() => Err(Failure::usage(
            "require.margin: can be at least so much, not at most",
        )),
        share => Ok((all, share.and_then(|it| it.least))),
    }
}

/// Where bounds of a figure can lie.
fn allowed(figure: Figure, bounds: impl Iterator<Item = f64>) -> Result<(), &'static str> {
    let (low, high, words) = match figure {
        Figure::Share => (0.0, 0.5, "must be in [0, 0.5]"),
        Figure::Certainty => (0.0, 1.0, "must be in [0, 1]"),
        Figure::Multiplier => (0.0, 1.0, "must be in [0, 1]"),
        Figure::RunUp => (
            0.0,
            Way::ALL.len() as f64,
            "must be true or false, or how many ways there must be, 6 at most",
        ),
        Figure::MissingStrips => (0.0, 100.0, "must be in [0, 100]"),
        _ => return Ok(()),
    };
    for bound in bounds {
        if !(low..=high).contains(&bound) {
            return Err(words);
        }
        let is_count = matches!(figure, Figure::MissingStrips | Figure::RunUp);
        if is_count && bound.fract() != 0.0 {
            return Err("must be a whole number");
        }
    }
    Ok(())
}
