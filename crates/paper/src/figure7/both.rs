//! Points A and B over each other: "small difference between working and unloaded regime" (Peterka 2003, section 3).

use anyhow::Result;
use softstop_draw::{Chart, Layer, Stroke, style};

use super::chart::{FACE, STATE};
use super::{Cycle, faces};
use crate::figure::Figure;
use crate::path::PathPoint;

const CURVES: [(&str, Stroke); 2] = [
    ("A, unloaded", Stroke::solid(style::DESIGN, 2.0)),
    ("B, loaded", Stroke::dashed(style::OPTIMUM, 2.0, (7.0, 3.0))),
];
/// How far before the clearance the near part begins, in units of the larger depth.
const BEFORE: f64 = 0.6;

/// Time series, phase plane, and the part of it near the stop; both have the same clearance and period.
pub(super) fn chart(figure: &Figure, cycles: &[Cycle; 2]) -> Result<Chart> {
    let scene = &cycles[1].orbit.scene;
    let (rho, period) = (scene.clearance, scene.period());
    let highest = cycles.iter().map(|it| it.orbit.max_position);
    let highest = highest.fold(f64::NEG_INFINITY, f64::max);
    let depth = highest - rho;
    let layers = |show: &dyn Fn(&PathPoint) -> (f64, f64), face: fn(f64, &str) -> Layer| {
        let curves = cycles.iter().zip(CURVES);
        let curves = curves.map(|(cycle, (name, stroke))| {
            Layer::line(cycle.path.points.iter().map(show), stroke).named(name)
        });
        let faces = faces(scene).into_iter();
        let faces = faces.map(|(at, name)| face(at, name));
        faces.chain(curves).collect()
    };
    let series = |at: &PathPoint| (at.time / period, at.position);
    let mut chart = figure.picture([
        layers(&series, |at, _| Layer::horizontal(at, FACE, "")),
        layers(&STATE, |at, _| Layer::vertical(at, FACE, "")),
        layers(&STATE, |at, name| Layer::vertical(at, FACE, name)),
    ])?;
    chart.panels[2].x.ends = [rho - BEFORE * depth, highest + 0.2 * depth].map(Some);
    Ok(chart)
}
