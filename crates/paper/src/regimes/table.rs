//! The map and its boundaries as tables.

use anyhow::Result;

use super::boundaries::{Boundaries, hardest};
use super::{MAPS, Named, middle};
use crate::figure;
use softstop_explore::basin::cells::RegimeMap;

/// A row for each run of cells of the same motion: from the middle of the first cell to that of the last.
pub(super) fn runs(maps: &[RegimeMap]) -> Result<Vec<u8>> {
    let columns = "machine,way,rho,eta_from,eta_to,motion";
    let mut lines = Vec::new();
    for (map, Named { machine, way, .. }) in maps.iter().zip(&MAPS) {
        let rows = map.cells.len() / map.columns;
        for (row, cells) in map.cells.chunks(map.columns).enumerate() {
            let rho = middle(map.rho, row, rows);
            let mut from = 0;
            for run in cells.chunk_by(|a, b| a == b) {
                let to = from + run.len() - 1;
                let ends = [from, to].map(|column| middle(map.eta, column, map.columns));
                from = to + 1;
                lines.push((machine, way, rho, ends, run[0].to_string()));
            }
        }
    }
    figure::table(columns, lines)
}

/// A row for each point of a boundary.
pub(super) fn boundaries(boundaries: &[Boundaries; 2]) -> Result<Vec<u8>> {
    let columns = "machine,boundary,curve,eta,rho,before_impact_velocity";
    let mut lines = Vec::new();
    for (machine, own) in ["unloaded", "loaded"].into_iter().zip(boundaries) {
        let grazing = own.grazing.iter();
        lines.extend(grazing.map(|&(eta, rho)| (machine, "g0", 0, [eta, rho], None)));
        for (name, curves) in [("s_PD", &own.flips), ("s_SN", &own.folds)] {
            for (number, curve) in curves.iter().enumerate() {
                lines.extend(curve.points.iter().map(|point| {
                    let velocity = Some(hardest(point));
                    (machine, name, number, point.parameters, velocity)
                }));
            }
        }
    }
    figure::table(columns, lines)
}
