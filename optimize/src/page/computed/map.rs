//! The before-impact velocity over the drive's frequency and another parameter.

use rayon::prelude::*;
use softstop::{Dimension, Parameter, Scene};
use softstop_console::interrupt;
use softstop_draw::around;
use softstop_dynamics::zone;

use super::{Motions, label_of, velocity};
use crate::design::Design;
use crate::page::data::{Curve, Map, Role};

/// Cells across and upwards.
const CELLS: (usize, usize) = (96, 40);

/// The map with this parameter, in the machine's own units, from the lower to the upper end of a range. No tolerance.
pub fn map(design: &Design, parameter: Parameter, [low, high]: [f64; 2]) -> Map {
    let machine = &design.machine;
    let own = |frequency: f64| machine.to_own(Dimension::Frequency, frequency);
    let value = |row: usize| low + (high - low) * (row as f64 + 0.5) / CELLS.1 as f64;
    let at = |row: usize| {
        let mut machine = machine.clone();
        machine.set(parameter, value(row));
        machine.scene
    };
    let scenes: Vec<Scene> = (0..CELLS.1).map(at).collect();
    let zones = zone::hysteresis_soon(&scenes, &interrupt::watch);
    let zones: Vec<_> = zones.into_iter().map(Result::ok).collect();
    let motions = zones.par_iter();
    let motions: Vec<Option<Motions>> =
        motions.map(|zone| zone.as_ref().map(Motions::of)).collect();
    let bound = |role: Role, row: usize| match role {
        Role::Grazing => Some(zones[row].as_ref()?.frequency_g0),
        Role::Fold => Some(zones[row].as_ref()?.frequency_sn),
        _ => motions[row].as_ref()?.flip,
    };
    let bounds = [
        ("g₀", Role::Grazing),
        ("s_SN", Role::Fold),
        ("s_PD", Role::Flip),
    ];
    let curves: Vec<Curve> = bounds
        .into_iter()
        .flat_map(|(name, role)| {
            let rows: Vec<usize> = (0..CELLS.1).collect();
            let known =
                rows.chunk_by(|a, b| bound(role, *a).is_some() == bound(role, *b).is_some());
            let points = known.map(|rows| {
                let points = rows
                    .iter()
                    .filter_map(|row| Some([own(bound(role, *row)?), value(*row)]));
                points.collect::<Vec<_>>()
            });
            let lines: Vec<_> = points.filter(|points| points.len() > 1).collect();
            lines.into_iter().map(move |points| Curve {
                name: name.to_owned(),
                role,
                points,
            })
        })
        .collect();
    let frequencies = curves
        .iter()
        .flat_map(|curve| curve.points.iter().map(|point| point[0]));
    let (left, right) = around(frequencies.chain([design.frequency()]), 0.05);
    let column = |column: usize| left + (right - left) * (column as f64 + 0.5) / CELLS.0 as f64;
    let cell = |motions: &Option<Motions>, at: usize| {
        motions
            .as_ref()?
            .velocity_at(machine.to_si(Dimension::Frequency, column(at)))
    };
    Map {
        x: label_of(machine, Parameter::Frequency),
        y: label_of(machine, parameter),
        shade: velocity(machine),
        x_range: [left, right],
        y_range: [low, high],
        columns: CELLS.0,
        cells: motions
            .iter()
            .flat_map(|row| (0..CELLS.0).map(move |at| cell(row, at)))
            .collect(),
        curves,
        design: [
            design.frequency(),
            machine.value(parameter).unwrap_or(f64::NAN),
        ],
        tolerance: None,
    }
}
