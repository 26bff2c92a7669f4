//! Operating points beside that of the drawing: the tables `[[case]]`.

use std::fmt::Display;
use std::iter::zip;

use softstop::internals::{did_you_mean, nearest_name};
use softstop::{Machine, Parameter};
use softstop_console::failure::Failure;
use toml::Table;

use super::toml_leaves::{leaves, number};
use super::vary::SearchSpace;
use crate::design::case::{Case, DRAWING};
use crate::design::problem::{Tolerance, Width};

/// Keys of a case that are no parameters.
const NAME: &str = "name";
const WEIGHT: &str = "weight";
/// The largest weight.
const HEAVIEST: f64 = 1e6;

/// Reads the cases of a task.
pub(super) fn cases(machine: &Machine, tables: &[Table]) -> Result<Vec<Case>, Failure> {
    let mut all: Vec<Case> = Vec::new();
    for (table, index) in zip(tables, 1..) {
        let case = case(machine, table, index)?;
        if all.iter().any(|it| it.name == case.name) {
            let name = format!("{:?}", case.name);
            return Err(wrong(index, NAME, name, "is the name of another case"));
        }
        all.push(case);
    }
    Ok(all)
}

/// A failure in a case, counted from 1.
fn in_case(index: usize, what: impl Display) -> Failure {
    Failure::usage(format!("case.{index}.{what}"))
}

/// A failure at the value of a key of a case, counted from 1.
fn wrong(index: usize, key: &str, value: impl Display, what: &str) -> Failure {
    in_case(index, format_args!("{key} = {value}: {what}"))
}

/// Reads a case, counted from 1.
fn case(machine: &Machine, table: &Table, index: usize) -> Result<Case, Failure> {
    let mut case = Case {
        name: index.to_string(),
        weight: 1.0,
        changes: Vec::new(),
    };
    for (key, value) in leaves(table) {
        let wrong = |what: &str| wrong(index, &key, value, what);
        let is_name = |name: &&str| {
            !name.trim().is_empty() && !name.contains(char::is_control) && *name != DRAWING
        };
        match &*key {
            NAME => {
                let name = value.as_str().filter(is_name);
                let what = "must be a name in one line, and not that of the drawing";
                let name = name.ok_or_else(|| wrong(what))?;
                name.clone_into(&mut case.name);
            }
            WEIGHT => {
                let weight = number(value).filter(|it| (0.0..=HEAVIEST).contains(it));
                let what = "must be a number in [0, 1e6]; 0 asks for all that is required and counts nothing";
                case.weight = weight.ok_or_else(|| wrong(what))?;
            }
            _ => {
                let stated = machine.free_parameter(&key);
                let (parameter, unit) =
                    stated.map_err(|error| match nearest_name(&key, &[NAME, WEIGHT]) {
                        None => in_case(index, error),
                        meant => in_case(
                            index,
                            format_args!("{key}: unknown key{}", did_you_mean(meant)),
                        ),
                    })?;
                let own = number(value).ok_or_else(|| wrong("must be a number"))? * unit;
                let checked = parameter
                    .about()
                    .allowed
                    .check(machine.name(parameter), own);
                checked.map_err(|error| in_case(index, error))?;
                if parameter == Parameter::Phase {
                    return Err(wrong("has no effect: it shifts the drive in time alone"));
                }
                if case.value(parameter).is_some() {
                    return Err(wrong("is given twice"));
                }
                case.changes.push((parameter, own));
            }
        }
    }
    let mut changed = machine.clone();
    for (parameter, value) in &case.changes {
        changed.set(*parameter, *value);
    }
    changed.validate().map_err(|error| in_case(index, error))?;
    Ok(case)
}

/// Refuses cases that change what is searched, or nothing.
pub(super) fn check(
    (machine, cases): (&Machine, &[Case]),
    searched: &SearchSpace,
    tolerances: &[Tolerance],
) -> Result<(), Failure> {
    for (case, index) in zip(cases, 1..) {
        for (parameter, value) in &case.changes {
            let name = machine.name(*parameter);
            let wrong = |what: &str| Err(wrong(index, name, value, what));
            let is_own = |it: Parameter| it == *parameter;
            let mut axes = searched.axes.iter().filter(|it| !it.range.is_held());
            if axes.any(|it| is_own(it.parameter)) {
                return wrong("is searched; a case changes only what is not");
            }
            if *parameter == Parameter::Frequency && !searched.frequency.is_held() {
                return wrong(
                    "is searched, and each case runs at the frequency of the drawing; a case has its own where [vary] holds that",
                );
            }
            if let Some(link) = searched.links.iter().find(|it| is_own(it.parameter)) {
                return wrong(&format!("follows {}", machine.name(link.follows)));
            }
            let is_share = |it: &Tolerance| !it.is_exact() && matches!(it.width, Width::Share(_));
            let mut own = tolerances.iter().filter(|it| is_own(it.parameter));
            let is_zero = *value == 0.0 || machine.value(*parameter) == Some(0.0);
            if is_zero && own.any(is_share) {
                return wrong("has a tolerance that is a share of it, and of 0 there is none");
            }
        }
        let drawn = |parameter: Parameter| {
            let mut axes = searched.axes.iter();
            let held = axes
                .find(|it| it.parameter == parameter)
                .map(|it| it.range.low);
            let frequency = (parameter == Parameter::Frequency).then_some(searched.frequency.low);
            frequency.or(held).or(machine.value(parameter))
        };
        let mut changes = case.changes.iter();
        if changes.all(|(parameter, value)| drawn(*parameter) == Some(*value)) {
            return Err(Failure::usage(format!(
                "case.{index}: changes nothing of the machine; \"{}\" needs a parameter with another value",
                case.name
            )));
        }
    }
    Ok(())
}
