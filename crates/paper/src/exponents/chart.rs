//! The largest Lyapunov exponent beneath the bifurcation diagram.

use super::{Found, Place};
use crate::diagram::{WAYS, by_way, dots};
use softstop_draw::{Align, Axis, Chart, Layer, Legend, Mark, Panel, Stroke, style};

/// Widths of the columns and height of the panels.
const WIDTHS: [f64; 2] = [580.0, 416.0];
const HEIGHT: f64 = 330.0;
const DOT: f64 = 0.7;

/// The whole range and a part of it, in the whole z = 1 up to its fold and points to mark on it with their names.
pub(super) fn chart(
    parts: &[Found],
    branch: &[Place],
    marks: &[(String, Place)],
    explanation: String,
) -> Chart {
    let mut panels: Vec<Panel> = Vec::new();
    for (column, part) in parts.iter().enumerate() {
        let mut own = [panel(part, column, 0), panel(part, column, 1)];
        let zero = Layer::horizontal(0.0, Stroke::solid(style::INK, 1.0), "");
        own[1].layers.push(zero);
        if column == 0 {
            for (row, panel) in own.iter_mut().enumerate() {
                let curve = branch.iter().map(|at| (at[0], at[1 + row]));
                let curve = Layer::line(curve, Stroke::solid(style::DESIGN, 1.8));
                panel.layers.push(curve);
                panel.layers.extend(marks.iter().flat_map(|(_, at)| {
                    let spot = Layer::marks([(at[0], at[1 + row])], Mark::Hollow, style::INK);
                    let line = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
                    [Layer::vertical(at[0], line, ""), spot.sized(4.5)]
                }));
            }
            let beyond = Layer::text((0.965, 0.0), Align::Left, "chaos: λ > 0, at the right");
            own[1].layers.push(beyond.moved(0.0, -8.0).plated());
            own[1].layers.extend(marks.iter().map(|(name, at)| {
                let (shift, align) = match at[0] < 1.2 {
                    true => (-9.0, Align::Right),
                    false => (9.0, Align::Left),
                };
                Layer::text((at[0], at[2]), align, name).moved(shift, 20.0)
            }));
        }
        panels.extend(own);
    }
    let title = "Stability of the motions along ρ = 10: the largest Lyapunov exponent λ";
    Chart {
        subtitle: explanation,
        legend: Legend::Above,
        shares_x: true,
        ..Chart::new(title, panels)
    }
}

/// The diagram or the exponents of a part.
fn panel(part: &Found, column: usize, row: usize) -> Panel {
    let points = part.ways.iter().flatten();
    let top = points
        .map(|point| point.step.hardest_impact())
        .fold(1.0, f64::max);
    let (name, range) = match row {
        0 => ("before-impact velocity X′₋", (-0.04 * top, 1.08 * top)),
        _ => ("λ per unit of τ", part.asked.exponents),
    };
    let [up, down] = &part.ways;
    let ways = by_way(up, down, |point| &point.step);
    let layers = ways.into_iter().zip(WAYS).map(|(points, (name, color))| {
        let settled = points.into_iter().filter(|it| it.step.is_settled());
        let dots = settled.flat_map(|point| match row {
            0 => dots(&point.step),
            _ => vec![(point.step.value, point.exponent.0)],
        });
        let radius = [DOT, 1.4 * DOT][row];
        Layer::dots(dots, radius, color).named(name)
    });
    Panel {
        at: (column, row),
        size: (WIDTHS[column], HEIGHT),
        x: Axis::new("drive frequency η = ω/Ω").range(part.asked.part.range),
        y: Axis::new(name).range(range),
        layers: layers.collect(),
        ..Panel::default()
    }
}
