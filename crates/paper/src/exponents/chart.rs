//! The largest Lyapunov exponent beneath the bifurcation diagram.

use super::{Place, Point};
use crate::diagram::{WAYS, by_way, dots};
use crate::figure::Figure;
use softstop_draw::{Align, Chart, Layer, Mark, Stroke, style};

const DOT: f64 = 0.7;

/// The whole range and a part of it, each up and down, in the whole z = 1 up to its fold and points to mark on it with
/// their names.
pub(super) fn chart(
    figure: &Figure,
    parts: &[[Vec<Point>; 2]],
    branch: &[Place],
    marks: &[(String, Place)],
) -> Chart {
    let mut chart = figure.chart.clone();
    for (index, panel) in chart.panels.iter_mut().enumerate() {
        let (ways, row) = (&parts[index / 2], index % 2);
        panel.layers = layers(ways, row);
        match row {
            0 => {
                let steps = ways.iter().flatten().map(|point| &point.step);
                let top = steps.map(|step| step.hardest_impact()).fold(1.0, f64::max);
                panel.y.ends = [-0.04 * top, 1.08 * top].map(Some);
            }
            _ => {
                let zero = Layer::horizontal(0.0, Stroke::solid(style::INK, 1.0), "");
                panel.layers.push(zero);
            }
        }
        if index < 2 {
            let curve = branch.iter().map(|at| (at[0], at[1 + row]));
            let curve = Layer::line(curve, Stroke::solid(style::DESIGN, 1.8));
            panel.layers.push(curve);
            panel.layers.extend(marks.iter().flat_map(|(_, at)| {
                let spot = Layer::marks([(at[0], at[1 + row])], Mark::Hollow, style::INK);
                let line = Stroke::dashed(style::ASIDE, 0.9, (3.0, 3.0));
                [Layer::vertical(at[0], line, ""), spot.sized(4.5)]
            }));
        }
        if index == 1 {
            let beyond = Layer::text((0.965, 0.0), Align::Left, "chaos: λ > 0, at the right");
            panel.layers.push(beyond.moved(0.0, -8.0).plated());
            panel.layers.extend(marks.iter().map(|(name, at)| {
                let (shift, align) = match at[0] < 1.2 {
                    true => (-9.0, Align::Right),
                    false => (9.0, Align::Left),
                };
                Layer::text((at[0], at[2]), align, name).moved(shift, 20.0)
            }));
        }
    }
    chart
}

/// The diagram or the exponents of a part.
fn layers([up, down]: &[Vec<Point>; 2], row: usize) -> Vec<Layer> {
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
    layers.collect()
}
