//! The largest Lyapunov exponent beneath the bifurcation diagram.

use super::{Part, Place, Point};
use crate::diagram::{dots, same};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::style;

/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
const WIDTH: f64 = 1200.0;
/// Left and right ends of the columns, tops of the rows, and their height.
const COLUMNS: [(f64, f64); 2] = [(84.0, 664.0), (756.0, 1172.0)];
const TOPS: [f64; 2] = [112.0, 466.0];
const HEIGHT: f64 = 330.0;
const LETTERS: u32 = 14;
const DOT: f64 = 0.7;
/// Colours: both ways, up only, down only.
const COLOURS: [&str; 3] = ["#444444", style::DESIGN, style::OPTIMUM];

/// The picture as PNG: the whole range and a part of it, in the whole z = 1 up to its fold and points to mark on it
/// with their names.
pub(super) fn png(
    parts: &[Part],
    branch: &[Place],
    marks: &[(String, Place)],
    explanation: &str,
) -> Result<Vec<u8>, String> {
    let mut pen = Pen::new(WIDTH, TOPS[1] + HEIGHT + 58.0);
    let title = "Stability of the motions along ρ = 10: the largest Lyapunov exponent λ";
    heading(&mut pen, (COLUMNS[0].0, 30.0), title, explanation);
    legend(&mut pen, 80.0);
    for (index, (part, (left, right))) in parts.iter().zip(COLUMNS).enumerate() {
        let is_whole = index == 0;
        let points = part.ways.iter().flatten();
        let top = points.map(|point| point.step.hardest()).fold(1.0, f64::max);
        let ranges = [(-0.04 * top, 1.08 * top), part.exponents];
        let panels = [0, 1].map(|row: usize| {
            let area = (left, TOPS[row], right - left, HEIGHT);
            Panel::new(area, part.range, ranges[row])
        });
        let ticks = (if is_whole { 10 } else { 5 }, 5);
        let frequency = Some("drive frequency η = ω/Ω");
        let axes = [
            Axes::new(LETTERS, None, "before-impact velocity X′₋", ticks),
            Axes::new(LETTERS, frequency, "λ per unit of τ", ticks),
        ];
        let [diagram, exponents] = &panels;
        diagram.ground(&mut pen, &axes[0]);
        exponents.ground(&mut pen, &axes[1]);
        curves(&mut pen, part, &panels);
        if is_whole {
            for (row, panel) in panels.iter().enumerate() {
                let curve = branch.iter().map(|at| (at[0], at[1 + row]));
                let curve: Vec<(f64, f64)> = curve.collect();
                panel.curve(&mut pen, &curve, Stroke::solid(COLOURS[1], 1.8));
            }
            let beyond = "chaos: λ > 0, at the right";
            let place = (exponents.across(0.965), exponents.height(0.0) - 8.0);
            pen.words(place, LETTERS - 1, Align::Left, (style::INK, true), beyond);
        }
        let zero = [(part.range.0, 0.0), (part.range.1, 0.0)];
        exponents.curve(&mut pen, &zero, Stroke::solid(style::INK, 1.0));
        for (name, at) in marks.iter().filter(|_| is_whole) {
            mark(&mut pen, &panels, name, *at);
        }
        diagram.axes(&mut pen, &axes[0]);
        exponents.axes(&mut pen, &axes[1]);
    }
    pen.png_at(SCALE)
}

fn curves(pen: &mut Pen, part: &Part, [diagram, exponents]: &[Panel; 2]) {
    let classed = classed(part);
    for way in [1, 2, 0] {
        let own = classed.iter().filter(|(class, _)| *class == way);
        let settled = own
            .map(|(_, point)| point)
            .filter(|it| it.step.is_settled());
        let velocities = settled.clone().flat_map(|point| dots(&point.step));
        diagram.dots(pen, velocities, DOT, COLOURS[way]);
        let values = settled.map(|point| (point.step.value, point.exponent.0));
        exponents.dots(pen, values, 1.4 * DOT, COLOURS[way]);
    }
}

fn mark(pen: &mut Pen, panels: &[Panel; 2], name: &str, [eta, values @ ..]: Place) {
    let [diagram, exponents] = panels;
    let line = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
    let x = diagram.across(eta);
    pen.line(&[(x, diagram.area.1), (x, exponents.bottom())], line);
    for (panel, value) in panels.iter().zip(values) {
        pen.spot((x, panel.height(value)), 4.5);
    }
    let (shift, align) = match eta < 1.2 {
        true => (-9.0, Align::Right),
        false => (9.0, Align::Left),
    };
    let place = (x + shift, exponents.height(values[1]) + 20.0);
    pen.words(place, LETTERS - 1, align, (style::INK, false), name);
}

/// Points with 0 if they are the same on both ways (shown once), 1 for up, 2 for down.
fn classed(part: &Part) -> Vec<(usize, &Point)> {
    let mut points = Vec::new();
    for (up, down) in part.ways[0].iter().zip(&part.ways[1]) {
        match (same(&up.step, &down.step), up.step.motion.regime()) {
            (false, _) => points.extend([(1, up), (2, down)]),
            (true, None) => points.extend([(0, up), (0, down)]),
            (true, Some(_)) => points.push((0, up)),
        }
    }
    points
}

fn legend(pen: &mut Pen, y: f64) {
    let names = ["up and down", "up only", "down only"];
    let mut x = COLUMNS[0].0;
    for (color, name) in COLOURS.into_iter().zip(names) {
        pen.tint((x, y - 11.0, 12.0, 12.0), color, 1.0);
        pen.text((x + 18.0, y), LETTERS, Align::Left, name);
        x += 18.0 + width(LETTERS, name) + 22.0;
    }
}
