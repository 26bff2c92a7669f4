//! Points A and B over each other: "small difference between working and unloaded regime" (Peterka 2003, section 3).

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::shapes::Sign;
use softstop_draw::style;

use super::cycle::Cycle;
use crate::figure::ends;

const PAGE: (f64, f64) = (1240.0, 520.0);
/// Where the panels are: time series, phase trajectory, the part of it near the stop.
const AREAS: [Area; 3] = [
    (76.0, 96.0, 400.0, 350.0),
    (556.0, 96.0, 290.0, 350.0),
    (926.0, 96.0, 290.0, 350.0),
];
const LETTERS: u32 = 14;
const CURVES: [Stroke; 2] = [
    Stroke::solid(style::DESIGN, 2.0),
    Stroke::dashed(style::OPTIMUM, 2.0, (7.0, 3.0)),
];
const FACE: Stroke = Stroke::dashed(style::ASIDE, 1.2, (6.0, 4.0));
/// How far before the clearance the near part begins, in units of the larger depth.
const BEFORE: f64 = 0.6;

/// The picture as an SVG document; both have the same clearance and period.
pub(super) fn svg(cycles: &[Cycle; 2]) -> String {
    let mut pen = Pen::page(PAGE.0, PAGE.1);
    let scene = &cycles[1].orbit.scene;
    let (eta, rho, period) = (scene.excitation.frequency, scene.clearance, scene.period());
    let title = format!("Fig. 7, A over B: η = {eta}, ρ = {rho}, z = 1");
    heading(&mut pen, (36.0, 38.0), &title, "time from drive angle 0");
    let points = || cycles.iter().flat_map(|cycle| &cycle.points);
    let (low, high) = ends(points().map(|at| at.position));
    let (slow, fast) = ends(points().map(|at| at.velocity));
    let depth = high - rho;
    let room = |(low, high): (f64, f64)| (low - 0.08 * (high - low), high + 0.08 * (high - low));
    let near = (rho - BEFORE * depth, high + 0.2 * depth);
    let panels = [
        ((0.0, 1.0), room((low, high)), ["time τ / T", "position X"]),
        (
            room((low, high)),
            room((slow, fast)),
            ["position X", "velocity X′"],
        ),
        (
            near,
            room((slow, fast)),
            ["position X near the stop", "velocity X′"],
        ),
    ];
    let faces = scene.piercing.map_or(vec![rho], |strip| {
        vec![
            rho,
            rho + strip.thickness,
            rho + strip.thickness + strip.travel,
        ]
    });
    for (index, (x, y, [across, up])) in panels.into_iter().enumerate() {
        let panel = Panel::new(AREAS[index], x, y);
        let axes = Axes::new(LETTERS, Some(across), up, (4, 6));
        panel.ground(&mut pen, &axes);
        for face in &faces {
            let line = match index {
                0 => [(x.0, *face), (x.1, *face)],
                _ => [(*face, y.0), (*face, y.1)],
            };
            panel.curve(&mut pen, &line, FACE);
        }
        for (cycle, stroke) in cycles.iter().zip(CURVES) {
            let place = |at: &super::Point| match index {
                0 => (at.time / period, at.position),
                _ => (at.position, at.velocity),
            };
            let places: Vec<(f64, f64)> = cycle.points.iter().map(place).collect();
            panel.curve(&mut pen, &places, stroke);
        }
        panel.axes(&mut pen, &axes);
    }
    let panel = Panel::new(AREAS[2], near, room((slow, fast)));
    for (face, name) in faces.iter().zip(["ρ", "ρ + σ", "ρ + σ + ν"]) {
        let place = (panel.across(*face), AREAS[2].1 - 8.0);
        pen.text(place, LETTERS - 1, Align::Middle, name);
    }
    let names = ["A, unloaded", "B, loaded"].map(str::to_owned);
    let signs = CURVES.map(Sign::Line).into_iter().zip(names);
    pen.legend((AREAS[1].0, 62.0), LETTERS, &signs.collect::<Vec<_>>());
    pen.svg()
}
