//! Which initial state leads to which motion.

use softstop_draw::{Layer, Mark, Panel, Sign, style};

use super::axis;
use crate::page::data::{Basin, BasinMotion};
use crate::page::figure::{Figure, HALF, points};

/// Radius of the spot where a motion passes the plane.
const SPOT: f64 = 4.5;

/// The picture.
pub(in crate::page) fn figure(basin: &Basin) -> Figure {
    let cells = basin.cells.iter();
    let colors = cells.map(|motion| basin.motions[usize::from(*motion)].color);
    let mut layers = vec![Layer::cells(basin.columns.max(1), colors)];
    let key = |motion: &BasinMotion| Layer::key(Sign::Patch(motion.color), &motion.name);
    layers.extend(basin.motions.iter().map(key));
    let half = |[low, high]: [f64; 2]| 0.5 * (high - low);
    layers.extend(basin.ball.map(|(radius, [x, y])| {
        let half = (radius * half(basin.x_range), radius * half(basin.y_range));
        Layer::ring((x, y), half)
    }));
    let spots = Layer::marks(points(&basin.spots), Mark::Hollow, style::INK);
    layers.push(spots.sized(SPOT));
    let panel = Panel {
        x: axis(&basin.x).range(basin.x_range.into()),
        y: axis(&basin.y).range(basin.y_range.into()),
        layers,
        ..Panel::default()
    };
    let shares = basin.motions.iter().map(|motion| {
        let [low, high] = motion.interval.map(|share| 100.0 * share);
        format!(
            "{} {:.1} % ({low:.1} to {high:.1})",
            motion.name,
            100.0 * motion.share
        )
    });
    let shares: Vec<String> = shares.collect();
    let ball = basin.ball.map_or(String::new(), |(radius, _)| {
        format!(" The ring is the largest ball inside the basin of the design: {radius:.3} of half of each axis.")
    });
    let caption = format!(
        "Shares of the initial states, with 95 % intervals: {}. The spot is the design at drive angle 0.{ball}",
        shares.join("; ")
    );
    Figure::new(HALF, "Which start leads to which motion", [panel], caption)
}
