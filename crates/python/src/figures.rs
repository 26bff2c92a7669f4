//! Figures of a machine's z = 1 motion with exact derivatives by its parameters.

use pyo3::prelude::*;
use softstop::{Machine as Stated, Parameter};
use softstop_console::budget::Budget;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_dynamics::figure::Figure;
use softstop_dynamics::zone::find_with_monitor;
use softstop_dynamics::{CycleMetrics, Orbit, derivatives};
use softstop_optimize::robust::rates;

use crate::errors::{MachineError, SoftstopError, of_failure, of_machine};
use crate::machine::Machine;
use crate::supervise::supervise;

/// figures(machine, names, by)
/// --
///
/// Values of figures of the hardest stable z = 1 motion, and their derivatives by keys of the machine, all in its own units.
#[pyfunction]
pub fn figures(
    py: Python<'_>,
    machine: &Machine,
    names: Vec<String>,
    by: Vec<String>,
) -> PyResult<(Vec<f64>, Vec<Vec<f64>>)> {
    let stated = &machine.stated;
    let is_offered = |it: &Figure| it.is_of_motion() && *it != Figure::Cost;
    let named = |name: &String| {
        let figure = Figure::named(name).filter(is_offered);
        figure.ok_or_else(|| {
            let all = Figure::ALL.iter().filter(|it| is_offered(it));
            let all: Vec<&str> = all.map(|it| it.name()).collect();
            MachineError::new_err(format!(
                "{name}: no such figure; there are {}",
                all.join(", ")
            ))
        })
    };
    let figures: Vec<Figure> = names.iter().map(named).collect::<PyResult<_>>()?;
    let directions: Vec<Direction> = by
        .iter()
        .map(|key| direction(stated, key))
        .collect::<PyResult<_>>()?;
    let found = supervise(py, &None, || {
        Budget::MACHINE.limit(|| {
            let orbit =
                find_with_monitor(&stated.scene, &interrupt::watch).map_err(anyhow::Error::from)?;
            let stroke = CycleMetrics::of(&orbit)?;
            Ok::<_, Failure>((orbit, stroke))
        })
    })?;
    let (orbit, stroke) = found.map_err(of_failure)?;
    let to_own = |figure: &Figure, value: f64| stated.to_own(figure.dimension(), value);
    let values = figures.iter().map(|figure| {
        let value = figure.of_motion(&orbit, &stroke).unwrap_or(f64::NAN);
        to_own(figure, value)
    });
    let values = values.collect();
    if directions.is_empty() {
        return Ok((values, vec![Vec::new(); figures.len()]));
    }
    let rates = derivatives(&figures, (&orbit, &stroke), &directions)?;
    let rows = figures.iter().zip(rates);
    let rows = rows.map(|(figure, row)| {
        let rates = row.into_iter();
        rates.map(|rate| to_own(figure, rate)).collect()
    });
    Ok((values, rows.collect()))
}

/// What changes of all parameters, in SI units, as a key of the machine goes on by one of its own units.
type Direction = Vec<(Parameter, f64)>;

/// All parameters are linear in each key, so a difference is the derivative; where some follow others by expressions, a small
/// central one is, to its square.
fn direction(machine: &Stated, key: &str) -> PyResult<Direction> {
    let (parameter, factor) = machine
        .free_parameter(key)
        .map_err(|error| of_machine(&error))?;
    let value = machine.value(parameter).unwrap_or(0.0);
    let share = if machine.ties.is_empty() { 0.5 } else { 1e-5 };
    let step = if value == 0.0 { 2.0 } else { value.abs() } * share;
    let moved = |by: f64| {
        let mut machine = machine.clone();
        machine.set(parameter, value + by);
        machine.scene
    };
    let (before, after) = (moved(-step), moved(step));
    let change = |it: Parameter| {
        Some((
            it,
            (it.get(&after)? - it.get(&before)?) / (2.0 * step) * factor,
        ))
    };
    let all = Parameter::ALL.into_iter().filter_map(change);
    Ok(all.filter(|(_, change)| *change != 0.0).collect())
}

/// Derivatives of figures in SI units along directions.
fn derivatives(
    figures: &[Figure],
    (orbit, stroke): (&Orbit, &CycleMetrics),
    directions: &[Direction],
) -> PyResult<Vec<Vec<f64>>> {
    let mut parameters: Vec<Parameter> = directions.iter().flatten().map(|(it, _)| *it).collect();
    parameters.sort();
    parameters.dedup();
    let slopes = derivatives::differentiate_orbit(orbit, &parameters);
    let slopes = slopes.map_err(|error| SoftstopError::new_err(error.to_string()))?;
    let row = |figure: &Figure| {
        let none =
            || SoftstopError::new_err(format!("{}: has no exact derivative here", figure.name()));
        let rates = rates((*figure, None), &slopes, (orbit, stroke)).ok_or_else(none)?;
        let along = |direction: &Direction| {
            let parts = direction.iter().map(|(parameter, change)| {
                let index = parameters.binary_search(parameter).unwrap_or(0);
                rates[index] * change
            });
            parts.sum()
        };
        Ok(directions.iter().map(along).collect())
    };
    figures.iter().map(row).collect()
}
