//! The map over two parameters.

use softstop_draw::{Layer, Mark, Panel, style};

use super::{axis, stroke};
use crate::page::data::Map;
use crate::page::figure::{Figure, points};
use crate::page::words::{capital, quantity};

/// Half the size of the design's mark.
const MARK: f64 = 8.0;
/// Corners of a box about its middle, in half widths, round to the first.
const CORNERS: [(f64, f64); 5] = [
    (-1.0, -1.0),
    (1.0, -1.0),
    (1.0, 1.0),
    (-1.0, 1.0),
    (-1.0, -1.0),
];

/// The picture.
pub(in crate::page) fn figure(map: &Map, size: (f64, f64)) -> Figure {
    let [x, y] = map.design;
    let values = map.cells.iter().map(|value| value.unwrap_or(f64::NAN));
    let mut layers = vec![Layer::shades(map.columns.max(1), values, map.shade.line())];
    layers.extend(map.curves.iter().map(|curve| {
        let dashes = stroke(curve.role).dashes;
        Layer::contour(points(&curve.points), dashes).named(&curve.name)
    }));
    layers.extend(map.tolerance.map(|[across, up]| {
        let corners = CORNERS.map(|(a, b)| (x + a * across, y + b * up));
        Layer::contour(corners, None)
    }));
    let design = Layer::marks([(x, y)], Mark::Diamond, style::OPTIMUM);
    layers.push(design.sized(MARK).named("design"));
    let panel = Panel {
        x: axis(&map.x).range(map.x_range.into()),
        y: axis(&map.y).range(map.y_range.into()),
        layers,
        ..Panel::default()
    };
    let title = format!(
        "{} over {} and {}",
        capital(&map.shade.name),
        map.x.name,
        map.y.name
    );
    Figure::new(size, title, [panel], caption(map))
}

fn caption(map: &Map) -> String {
    let [x, y] = map.design;
    let place = format!(
        "The design stands at {} and {}.",
        quantity(x, &map.x.unit),
        quantity(y, &map.y.unit)
    );
    let widths = map
        .tolerance
        .unwrap_or_default()
        .into_iter()
        .zip([&map.x.unit, &map.y.unit]);
    let widths = widths.filter(|(width, _)| *width > 0.0);
    let widths = widths.map(|(width, unit)| format!("±{}", quantity(width, unit)));
    let widths: Vec<String> = widths.collect();
    let tolerance = match widths.is_empty() {
        true => String::new(),
        false => format!(
            " The box about it is its tolerance, {}.",
            widths.join(" and ")
        ),
    };
    format!(
        "Colour: {} of the stable motion with one impact a period, in the hysteresis zone (from g₀ to s_SN) and below it; no colour: no such motion. {place}{tolerance}",
        map.shade.line()
    )
}
