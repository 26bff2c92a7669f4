//! What a task requires of the design: the table `[require]`.

use std::ops::RangeInclusive;

use serde::Deserialize;
use softstop::{Dimension, Machine};
use softstop_console::failure::Failure;
use softstop_dynamics::attractors::Region;
use softstop_dynamics::run_up::Way;
use toml::{Table, Value};

use super::objective::{Goal, known, lacks};
use super::toml_leaves::{number, percent, read_words};
use super::ways::{Bounds, ways};
use crate::design::figure::{Figure, Sense};
use crate::design::problem::{Problem, VIOLATING};
use crate::design::requirement::{Requirement, Scope};

/// The key of the reserve.
pub(super) const RESERVE: &str = "tolerance_reserve";
/// The key of the share that may violate a requirement, and the least such share.
pub(super) const SHARE: &str = "violating";
const LEAST_SHARE: f64 = 1e-5;
/// Positions and velocities of starts at most, in the machine's own units: as large as its values may be.
const FARTHEST: f64 = 1e24;
/// The key of the box of starts.
pub(super) const STARTS: &str = "starts";

/// Reads what `[require]` says into a problem, but for the margin: that from both ends of the zone as a share of its width, if it is
/// stated.
pub(super) fn read_requirements(
    problem: &mut Problem,
    goal: &Goal,
    table: &Table,
) -> Result<Option<f64>, Failure> {
    let machine = &problem.machine;
    let stated = |key: &str, usual: f64, allowed: RangeInclusive<f64>, what: &str| {
        let Some(value) = table.get(key) else {
            return Ok(usual);
        };
        let stated = number(value).or_else(|| percent(value).filter(|_| key == SHARE));
        let stated = stated.filter(|it| allowed.contains(it));
        stated.ok_or_else(|| Failure::usage(format!("require.{key} = {value}: must be {what}")))
    };
    let reserve = stated(RESERVE, 1.0, 1.0..=10.0, "a number in [1, 10]")?;
    let violating = stated(
        SHARE,
        VIOLATING,
        LEAST_SHARE..=0.5,
        "a share from 0.00001 to 0.5, or \"0.27 %\"",
    )?;
    let (run_up, run_up_bounds) = ways(machine, table.get(Figure::RunUp.name()))?;
    let others = [RESERVE, SHARE, STARTS];
    let one = |(name, value): (&String, &Value)| {
        let figure = known("require.", name, &others)?;
        let wrong = |what: &str| Failure::usage(format!("require.{name} = {value}: {what}"));
        let what = match figure {
            Figure::RunUp => {
                "must be true or false, how many ways there must be, or { ways = [\"frequency_raised\"], \
                 ramp_rate = NUMBER, force = NUMBER, least = NUMBER }"
            }
            _ => "must be a number, or { least = NUMBER, most = NUMBER, at = \"drawing\" }",
        };
        let mut scope = Scope::default();
        let (least, most) = match (value, figure.sense()) {
            (Value::Boolean(is_any), _) if figure == Figure::RunUp => {
                (Some(f64::from(*is_any)), None)
            }
            (Value::Table(words), _) => {
                let stated = match figure {
                    Figure::RunUp => run_up_bounds,
                    _ => read_words(&format!("require.{name}"), words)?,
                };
                let bounds: Bounds = stated.ok_or_else(|| wrong(what))?;
                scope = bounds.at.unwrap_or_default();
                (bounds.least, bounds.most)
            }
            (value, sense) => match (
                number(value).or_else(|| percent(value).filter(|_| is_share(figure))),
                sense,
            ) {
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
        allowed(figure, given).map_err(|what| wrong(&what))?;
        if figure == Figure::RunUp && least > Some(run_up.ways.len() as f64) {
            return Err(wrong(&format!(
                "only {} ways are permitted; ways = [...] says which",
                run_up.ways.len()
            )));
        }
        let si = |bound: f64| machine.to_si(figure.dimension(), bound);
        Ok(Requirement {
            figure,
            least: least.map(si),
            most: most.map(si),
            scope,
        })
    };
    let figures = table
        .iter()
        .filter(|(name, _)| !others.contains(&name.as_str()));
    let all: Result<Vec<Requirement>, Failure> = figures.map(one).collect();
    let mut all = all?;
    for requirement in &all {
        if let Some(lacks) = lacks(machine, goal, requirement.figure) {
            let name = requirement.figure.name();
            return Err(Failure::usage(format!("require.{name}: {lacks}")));
        }
    }
    let share = all.extract_if(.., |it| it.figure == Figure::Share).next();
    match share {
        Some(share) if share.most.is_some() => Err(Failure::usage(
            "require.margin: can be at least so much, not at most",
        )),
        share => {
            let starts = table.get(STARTS).map(|it| starts(machine, it));
            problem.starts = starts.transpose()?;
            problem.requirements = all;
            (problem.reserve, problem.violating) = (reserve, violating);
            problem.run_up = run_up;
            Ok(share.and_then(|it| it.least))
        }
    }
}

/// `{ position = [-0.02, 0.02], velocity = [-1, 1] }`, in the machine's own units.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Starts {
    position: [f64; 2],
    velocity: [f64; 2],
}

/// Reads the box of starts.
fn starts(machine: &Machine, value: &Value) -> Result<Region, Failure> {
    let stated: Option<Starts> = match value {
        Value::Table(words) => read_words("require.starts", words)?,
        _ => None,
    };
    let is_range = |[low, high]: [f64; 2]| low < high && low >= -FARTHEST && high <= FARTHEST;
    let stated = stated.filter(|it| is_range(it.position) && is_range(it.velocity));
    let Starts { position, velocity } = stated.ok_or_else(|| {
        Failure::usage(format!(
            "require.{STARTS} = {value}: must be {{ position = [LOW, HIGH], velocity = [LOW, HIGH] }}, within 1e24, each HIGH above its LOW"
        ))
    })?;
    Ok(Region {
        position: position.map(|it| machine.to_si(Dimension::Length, it)),
        velocity: velocity.map(|it| machine.to_si(Dimension::Velocity, it)),
    })
}

/// True for a figure that may be stated in per cent.
fn is_share(figure: Figure) -> bool {
    matches!(figure, Figure::Certainty | Figure::Share)
}

/// Where bounds of a figure can lie.
fn allowed(figure: Figure, bounds: impl Iterator<Item = f64>) -> Result<(), String> {
    let most = match figure {
        Figure::Share => 0.5,
        Figure::Certainty | Figure::Multiplier => 1.0,
        Figure::RunUp => Way::ALL.len() as f64,
        Figure::MissingStrips => 100.0,
        _ => return Ok(()),
    };
    for bound in bounds {
        if !(0.0..=most).contains(&bound) {
            return Err(match figure {
                Figure::RunUp => {
                    format!("must be true or false, or how many ways there must be, {most} at most")
                }
                _ => format!("must be in [0, {most}]"),
            });
        }
        let is_count = matches!(figure, Figure::MissingStrips | Figure::RunUp);
        if is_count && bound.fract() != 0.0 {
            return Err("must be a whole number".to_owned());
        }
    }
    Ok(())
}
