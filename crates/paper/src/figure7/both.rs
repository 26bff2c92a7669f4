//! Points A and B over each other: "small difference between working and unloaded regime" (Peterka 2003, section 3).

use softstop_draw::{Axis, Chart, Layer, Legend, Panel, Stroke, style};

use super::{Cycle, faces};
use crate::path::Point;

const CURVES: [(&str, Stroke); 2] = [
    ("A, unloaded", Stroke::solid(style::DESIGN, 2.0)),
    ("B, loaded", Stroke::dashed(style::OPTIMUM, 2.0, (7.0, 3.0))),
];
const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.2, (6.0, 4.0));
/// How far before the clearance the near part begins, in units of the larger depth.
const BEFORE: f64 = 0.6;

/// Time series, phase plane, and the part of it near the stop; both have the same clearance and period.
pub(super) fn chart(cycles: &[Cycle; 2]) -> Chart {
    let scene = &cycles[1].orbit.scene;
    let (eta, rho, period) = (scene.excitation.frequency, scene.clearance, scene.period());
    let highest = cycles[0]
        .orbit
        .max_position
        .max(cycles[1].orbit.max_position);
    let depth = highest - rho;
    let near = (rho - BEFORE * depth, highest + 0.2 * depth);
    let panel = |width, x, y: &str, show: &dyn Fn(&Point) -> (f64, f64), face: DrawFace| {
        let curves = cycles.iter().zip(CURVES);
        let curves = curves.map(|(cycle, (name, stroke))| {
            Layer::line(cycle.path.points.iter().map(show), stroke).named(name)
        });
        let faces = faces(scene).into_iter();
        Panel {
            size: (width, 350.0),
            x,
            y: Axis::new(y),
            layers: faces
                .map(|(at, name)| face(at, name))
                .chain(curves)
                .collect(),
            ..Panel::default()
        }
    };
    let series = |at: &Point| (at.time / period, at.position);
    let state = |at: &Point| (at.position, at.velocity);
    let time = Axis::new("time τ / T").range((0.0, 1.0));
    let close = Axis::new("position X near the stop").range(near);
    let across: DrawFace = |at, _| Layer::horizontal(at, FACE, "");
    let upwards: DrawFace = |at, _| Layer::vertical(at, FACE, "");
    let named: DrawFace = |at, name| Layer::vertical(at, FACE, name);
    let panels = [
        panel(400.0, time, "position X", &series, across),
        panel(
            290.0,
            Axis::new("position X"),
            "velocity X′",
            &state,
            upwards,
        ),
        panel(290.0, close, "velocity X′", &state, named),
    ];
    let title = format!("Fig. 7, A over B: η = {eta}, ρ = {rho}, z = 1");
    Chart {
        subtitle: "time from drive angle 0".to_owned(),
        legend: Legend::Above,
        ..Chart::new(title, panels).in_columns(3)
    }
}

/// The line at a position at which the law changes, and its name.
type DrawFace = fn(f64, &'static str) -> Layer;
