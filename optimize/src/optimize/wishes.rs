//! What a task wishes of the design: the tables `[vary]`, `[tolerance]` and `[objective]`.

use serde::Deserialize;
use softstop::internals::{did_you_mean, nearest};
use softstop::{Machine, Parameter};
use softstop_console::failure::Failure;
use toml::{Table, Value};

use super::leaves::{flatten, number, range};
use super::named::Named;
use crate::design::figure::{Figure, Sense};
use crate::design::problem::{Link, Objective, Tolerance, Width};

/// What `[vary]` says of one parameter.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Variable {
    /// It is searched from one value to another; a single value is held.
    Range([f64; 2]),
    /// It is one of these.
    Catalogue(Vec<f64>),
    /// It follows another parameter.
    Follows(Follow),
}

/// `{ follows = "stop.stiffness", factor = 2e-5 }`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Follow {
    follows: String,
    factor: f64,
    #[serde(default)]
    offset: f64,
}

/// What `[vary]` holds, in the file's order of keys.
pub(super) fn variables(table: &Table) -> Result<Vec<Named<Variable>>, Failure> {
    let mut found = Vec::new();
    leaves(table, |name, value| {
        let wrong = || {
            Failure::usage(format!(
                "vary.{name} = {value}: must be a range [low, high], a number to hold, {{ values = [a, b, c] }} of \
                 a catalogue, or {{ follows = KEY, factor = NUMBER }}; numbers alone, in the machine's own units"
            ))
        };
        let variable = match value {
            Value::Table(words) if words.contains_key("values") && words.len() == 1 => {
                let values = words["values"]
                    .as_array()
                    .map(|values| values.iter().map(number));
                let values: Option<Vec<f64>> = values.and_then(Iterator::collect);
                let mut values = values.filter(|it| !it.is_empty()).ok_or_else(wrong)?;
                values.sort_by(f64::total_cmp);
                values.dedup();
                Variable::Catalogue(values)
            }
            Value::Table(words) => {
                let follow = words.clone().try_into().map_err(|_| wrong())?;
                Variable::Follows(follow)
            }
            value => {
                let held = number(value).map(|value| [value, value]);
                Variable::Range(range(value).or(held).ok_or_else(wrong)?)
            }
        };
        found.push(Named {
            name,
            value: variable,
        });
        Ok(())
    })?;
    Ok(found)
}

/// Visits what a table says of each parameter; `{ values = … }` and `{ follows = … }` are said of one.
fn leaves(
    table: &Table,
    mut visit: impl FnMut(String, &Value) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let says = |value: &Table| {
        ["values", "follows", "factor", "least", "most"]
            .iter()
            .any(|key| value.contains_key(*key))
    };
    flatten(table, "", &says, &mut visit)
}

/// The parameter of a key of `[vary]` and the key's unit in the machine's own.
pub(super) fn parameter(machine: &Machine, name: &str) -> Result<(Parameter, f64), Failure> {
    let stated = machine.stated(name);
    stated.map_err(|error| Failure::usage(format!("vary.{error}")))
}

/// The link of one parameter to another, in the machine's own units.
pub(super) fn link(machine: &Machine, name: &str, follow: &Follow) -> Result<Link, Failure> {
    let (parameter, unit) = self::parameter(machine, name)?;
    let (follows, other) = self::parameter(machine, &follow.follows)?;
    if [parameter, follows].contains(&Parameter::Frequency) {
        return Err(Failure::usage(format!(
            "vary.{name}: the drive's frequency follows nothing, and nothing follows it: it is found along the zone"
        )));
    }
    if !(follow.factor.is_finite() && follow.offset.is_finite()) || parameter == follows {
        return Err(Failure::usage(format!(
            "vary.{name}: must follow another parameter by a finite factor and offset"
        )));
    }
    Ok(Link {
        parameter,
        follows,
        factor: follow.factor * unit / other,
        offset: follow.offset * unit,
    })
}

/// `[tolerance]`: half-widths in the machine's own units, or shares of the value such as `"2 %"`.
pub(super) fn tolerances(machine: &Machine, table: &Table) -> Result<Vec<Tolerance>, Failure> {
    let mut found: Vec<Tolerance> = Vec::new();
    leaves(table, |name, value| {
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
        Ok(())
    })?;
    Ok(found)
}

/// `[objective]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Goal {
    maximise: Option<String>,
    minimise: Option<String>,
}

/// What is sought: the highest before-impact velocity, if nothing is said.
pub(super) fn objective(machine: &Machine, goal: &Goal) -> Result<Objective, Failure> {
    let (name, sense, says) = match (&goal.maximise, &goal.minimise) {
        (None, None) => return Ok(Objective::default()),
        (Some(name), None) => (name, Sense::Least, "maximise"),
        (None, Some(name)) => (name, Sense::Most, "minimise"),
        (Some(_), Some(_)) => {
            return Err(Failure::usage(
                "objective: only one of maximise and minimise can be given",
            ));
        }
    };
    let figure = known(&format!("objective.{says} = "), name)?;
    let is_sought = matches!(
        figure,
        Figure::Velocity
            | Figure::ImpactEnergy
            | Figure::ImpactPower
            | Figure::StrokeWork
            | Figure::DriveForce
            | Figure::DrivePower
            | Figure::StopForce
    );
    if !is_sought {
        return Err(Failure::usage(format!(
            "objective.{says} = {name}: must be velocity, impact_energy, impact_power, stroke_work, drive_force, \
             drive_power or stop_force; what else counts goes to [require]"
        )));
    }
    if let Some(lacks) = lacks(machine, figure) {
        return Err(Failure::usage(format!(
            "objective.{says} = {name}: this machine has no {lacks}"
        )));
    }
    Ok(Objective { figure, sense })
}

pub(super) fn known(place: &str, name: &str) -> Result<Figure, Failure> {
    Figure::named(name).ok_or_else(|| {
        let names: Vec<&'static str> = Figure::ALL.iter().map(|it| it.name()).collect();
        let meant = did_you_mean(nearest(name, &names));
        Failure::usage(format!(
            "{place}{name}: unknown figure{meant}; known are {}",
            names.join(", ")
        ))
    })
}

/// What a machine would have to have for a figure.
pub(super) fn lacks(machine: &Machine, figure: Figure) -> Option<&'static str> {
    let scene = &machine.scene;
    match figure {
        Figure::CutThrough | Figure::MissingStrips | Figure::StrokeWork
            if scene.piercing.is_none() =>
        {
            Some("strip (piercing.thickness)")
        }
        Figure::RigidGap if scene.rigid.is_none() => Some("rigid stop behind (rigid.travel)"),
        Figure::DriveForce
            if Parameter::Amplitude.is_unit() && machine.value(Parameter::Amplitude).is_none() =>
        {
            Some("drive amplitude of its own: it speaks ratios, whose unit of force is F0")
        }
        _ => None,
    }
}
