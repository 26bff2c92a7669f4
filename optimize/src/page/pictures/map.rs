//! The map over two parameters.

use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Area, Pen};
use softstop_draw::scale::around;
use softstop_draw::shade;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;

use super::stroke;
use crate::page::data::Map;
use crate::page::figure::{EDGE, Figure, LETTERS, LINE, RIGHT, ROOM, Size, ends, finite, legend};
use crate::page::words::{capital, quantity};

/// Width of the scale of shades, and the room for its numbers at its left.
const SCALE: (f64, f64) = (16.0, 76.0);
/// Half the size of the design's mark.
const MARK: f64 = 8.0;

/// The picture.
pub(in crate::page) fn figure(map: &Map, size: Size) -> Figure {
    let mut pen = Pen::new(size.width, size.height);
    let right = size.width - RIGHT;
    let mark = Sign::Mark(Mark::Diamond, style::OPTIMUM);
    let mut entries: Vec<(Sign, String)> = vec![(mark, "design".to_owned())];
    for curve in &map.curves {
        if !entries.iter().any(|(_, name)| *name == curve.name) {
            entries.push((Sign::Line(stroke(curve.role)), curve.name.clone()));
        }
    }
    let top = legend(&mut pen, (ROOM.0, EDGE + 4.0), right, &entries) - LINE + 14.0;
    let wide = right - ROOM.0 - SCALE.0 - SCALE.1;
    let area = (ROOM.0, top, wide, size.height - top - ROOM.1);
    let panel = Panel::new(area, ends(map.x_range), ends(map.y_range));
    let axes = (map.x.line(), map.y.line());
    let axes = Axes::new(LETTERS, Some(&axes.0), &axes.1, (5, 5));
    panel.ground(&mut pen, &axes);
    let shown = map.cells.iter().flatten().copied();
    let range = around(shown, 0.0);
    cells(&mut pen, map, &panel, range);
    for curve in &map.curves {
        let stroke = stroke(curve.role);
        panel.rimmed(&mut pen, &finite(&curve.points), stroke.dashes);
    }
    let [x, y] = map.design;
    if let Some([across, up]) = map.tolerance {
        let corners = [
            (-1.0, -1.0),
            (1.0, -1.0),
            (1.0, 1.0),
            (-1.0, 1.0),
            (-1.0, -1.0),
        ];
        let corners = corners.map(|(a, b)| (x + a * across, y + b * up));
        panel.rimmed(&mut pen, &corners, None);
    }
    if panel.holds((x, y)) {
        pen.mark(panel.place((x, y)), Mark::Diamond, MARK + 2.0, "#ffffff");
        pen.mark(panel.place((x, y)), Mark::Diamond, MARK, style::OPTIMUM);
    }
    panel.axes(&mut pen, &axes);
    let bar = (right - SCALE.0, top, SCALE.0, area.3);
    shade::bar(&mut pen, bar, range, LETTERS, &map.shade.line());
    let title = format!(
        "{} over {} and {}",
        capital(&map.shade.name),
        map.x.name,
        map.y.name
    );
    Figure::new(&pen, size, &title, caption(map))
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

fn cells(pen: &mut Pen, map: &Map, panel: &Panel, range: (f64, f64)) {
    let columns = map.columns.max(1);
    let rows = map.cells.len() / columns;
    let (wide, tall) = (
        panel.area.2 / columns as f64,
        panel.area.3 / rows.max(1) as f64,
    );
    let mut areas: Vec<Vec<Area>> = vec![Vec::new(); shade::SHADES];
    for (index, value) in map.cells.iter().enumerate() {
        let Some(value) = value.filter(|value| value.is_finite()) else {
            continue;
        };
        let (column, row) = ((index % columns) as f64, (index / columns) as f64);
        let corner = (
            panel.area.0 + wide * column,
            panel.bottom() - tall * (row + 1.0),
        );
        areas[shade::shade(value, range)].push((
            round(corner.0),
            round(corner.1),
            round(wide + 0.4),
            round(tall + 0.4),
        ));
    }
    for (number, areas) in areas
        .iter()
        .enumerate()
        .filter(|(_, areas)| !areas.is_empty())
    {
        pen.fill(areas, &shade::color(number));
    }
}

fn round(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}
