//! The map and its boundaries as tables.

use anyhow::Context;
use softstop_dynamics::continuation::Curve;

use super::boundaries::{Boundaries, hardest};
use super::middle;
use softstop_console::failure::Failure;
use softstop_explore::basin::cells::RegimeMap;

/// What the maps are called, panel by panel: machine, way.
const MAPS: [[&str; 2]; 6] = [
    ["unloaded", "up"],
    ["unloaded", "down"],
    ["unloaded", "up, zoom"],
    ["unloaded", "hardest of several starts"],
    ["loaded", "up"],
    ["loaded", "down"],
];

fn finish(table: csv::Writer<Vec<u8>>) -> Result<Vec<u8>, Failure> {
    let content = table.into_inner().map_err(csv::IntoInnerError::into_error);
    Ok(content.context("cannot write the table")?)
}

/// A row for each run of cells of the same motion: from the middle of the first cell to that of the last.
pub(super) fn runs(maps: &[RegimeMap]) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = ["machine", "way", "rho", "eta_from", "eta_to", "motion"];
    table
        .write_record(header)
        .context("cannot write the table")?;
    for (map, [machine, way]) in maps.iter().zip(MAPS) {
        let rows = map.cells.len() / map.columns;
        for (row, cells) in map.cells.chunks(map.columns).enumerate() {
            let rho = middle(map.rho, row, rows);
            let mut from = 0;
            for run in cells.chunk_by(|a, b| a == b) {
                let to = from + run.len() - 1;
                let [begin, end] = [from, to].map(|column| middle(map.eta, column, map.columns));
                from = to + 1;
                table
                    .serialize((machine, way, rho, begin, end, run[0].to_string()))
                    .context("cannot write the table")?;
            }
        }
    }
    finish(table)
}

/// A row for each point of a boundary.
pub(super) fn boundaries(boundaries: &[Boundaries; 2]) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = [
        "machine",
        "boundary",
        "curve",
        "eta",
        "rho",
        "before_impact_velocity",
    ];
    table
        .write_record(header)
        .context("cannot write the table")?;
    for (machine, own) in ["unloaded", "loaded"].into_iter().zip(boundaries) {
        for (eta, rho) in &own.grazing {
            table
                .serialize((machine, "g0", 0, eta, rho, None::<f64>))
                .context("cannot write the table")?;
        }
        for (name, curves) in [("s_PD", &own.flips), ("s_SN", &own.folds)] {
            for (number, curve) in curves.iter().enumerate() {
                points(&mut table, (machine, name, number), curve)?;
            }
        }
    }
    finish(table)
}

fn points(
    table: &mut csv::Writer<Vec<u8>>,
    (machine, name, number): (&str, &str, usize),
    curve: &Curve,
) -> Result<(), Failure> {
    for point in &curve.points {
        let [eta, rho] = point.parameters;
        table
            .serialize((machine, name, number, eta, rho, Some(hardest(point))))
            .context("cannot write the table")?;
    }
    Ok(())
}
