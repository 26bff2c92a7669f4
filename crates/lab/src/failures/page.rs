//! A page of the atlas: a map for each method, the strip of the exact one, the legend.

use crate::methods::Verdict;

use super::heat::{DASHES, Grid, color};
use crate::failures::{Atlas, Axes, Map};
use softstop_draw::pen::{Align, Pen};

/// Width of a map in pixels, about, and room between maps beside each other.
const MAP: f64 = 168.0;
const GAP: f64 = 18.0;
/// Room left of the first map, right of the last, above the first row.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 26.0;
const TOP: f64 = 96.0;
/// Between rows: numbers of one and headings of the next.
const BETWEEN: f64 = 56.0;
/// Below the last row of maps: the exact method and the legend.
const BELOW: f64 = 74.0;
/// Height of the strip of the exact method.
const STRIP: f64 = 18.0;
/// Fewest maps that a page is made wide for, so that the legend fits.
const NARROWEST: usize = 5;
/// Width of a column of the legend, and entries in it.
const LEGEND: f64 = 166.0;
const LEGEND_ROWS: usize = 3;

/// The page as an SVG document.
pub(super) fn page(atlas: &Atlas) -> String {
    let maps = atlas.maps.chunk_by(|a, b| a.family.row() == b.family.row());
    let rows: Vec<&[Map]> = maps.collect();
    let points = atlas.axes.stiffness.len() as f64;
    let cell = (MAP / points).round().max(1.0);
    let width = cell * points + GAP;
    let height = cell * atlas.axes.step.len() as f64 + BETWEEN;
    let across = rows.iter().map(|row| row.len()).fold(NARROWEST, usize::max);
    let bottom = TOP + rows.len() as f64 * height;
    let right = LEFT + across as f64 * width;
    let mut pen = Pen::new(right - GAP + RIGHT, bottom + BELOW);
    headings(&mut pen, atlas);
    for (row, maps) in rows.into_iter().enumerate() {
        let top = TOP + row as f64 * height;
        for (column, map) in maps.iter().enumerate() {
            let grid = Grid {
                axes: &atlas.axes,
                corner: (LEFT + column as f64 * width, top),
                cell: (cell, cell),
            };
            draw(&mut pen, &grid, atlas, map);
            if column == 0 {
                grid.step_axis(&mut pen);
                let middle = top + 0.5 * grid.size().1;
                let row = map.family.row();
                pen.heading((LEFT - 72.0, middle), 14, Align::Upwards, row);
                pen.text((LEFT - 48.0, middle), 12, Align::Upwards, "step h/T");
            }
        }
    }
    exact(&mut pen, atlas, cell, bottom);
    legend(&mut pen, atlas, (LEFT + width + GAP, bottom - 14.0));
    pen.svg()
}

fn headings(pen: &mut Pen, atlas: &Atlas) {
    let (view, percent) = (&atlas.view, 100.0 * atlas.tolerance);
    let periods = view.periods;
    let plural = if periods == 1.0 { "" } else { "s" };
    let below = format!(
        "Each cell is one run: step h as a share of the drive period T, over the stop's stiffness k, for {periods} \
         drive period{plural}. Errors up to {percent} % of the motion pass."
    );
    pen.heading((LEFT, 32.0), 19, Align::Left, &view.title);
    pen.text((LEFT, 54.0), 13, Align::Left, &below);
}

fn draw(pen: &mut Pen, grid: &Grid<'_>, atlas: &Atlas, map: &Map) {
    let (left, top, width, _) = grid.area();
    grid.verdicts(pen, &map.columns);
    let contacts = atlas.columns.iter().map(|column| column.contact);
    grid.line(pen, &contacts.collect::<Vec<_>>(), Some(DASHES));
    grid.line(pen, &map.limit, None);
    pen.frame(grid.area());
    grid.stiffness_axis(pen);
    let place = (left + 0.5 * width, top - 8.0);
    pen.heading(place, 13, Align::Middle, map.family.title());
}

/// The strip of the exact method, the same for all steps; blank where nothing else knows the true motion.
fn exact(pen: &mut Pen, atlas: &Atlas, cell: f64, top: f64) {
    let axes = Axes {
        stiffness: atlas.axes.stiffness.clone(),
        step: vec![1.0],
    };
    let grid = Grid {
        axes: &axes,
        corner: (LEFT, top),
        cell: (cell, STRIP),
    };
    let columns = atlas.columns.iter();
    let cells = columns.map(|column| Vec::from_iter(column.exact));
    grid.verdicts(pen, &cells.collect::<Vec<_>>());
    pen.frame(grid.area());
    grid.stiffness_axis(pen);
    let middle = LEFT + 0.5 * grid.size().0;
    pen.heading((middle, top - 8.0), 13, Align::Middle, "exact: no step");
    let below = (middle, top + STRIP + 36.0);
    pen.text(below, 12, Align::Middle, "stiffness k (N/m)");
}

/// Colours and lines, beside the strip.
fn legend(pen: &mut Pen, atlas: &Atlas, (left, top): (f64, f64)) {
    let place = |index: usize| {
        let (row, column) = (index % LEGEND_ROWS, index / LEGEND_ROWS);
        (left + LEGEND * column as f64, top + 24.0 * row as f64)
    };
    let occurs = |verdict: Verdict| {
        let mut cells = atlas.maps.iter().flat_map(|map| &map.columns).flatten();
        cells.any(|cell| cell.verdict == verdict)
    };
    let mut shown = Verdict::ALL.to_vec();
    shown.retain(|verdict| *verdict != Verdict::Unsuited || occurs(*verdict));
    for (index, verdict) in shown.iter().enumerate() {
        let (x, y) = place(index);
        let swatch = (x, y, 22.0, 14.0);
        pen.fill(&[swatch], color(*verdict));
        pen.frame(swatch);
        pen.text((x + 30.0, y + 11.5), 12, Align::Left, verdict.name());
    }
    let lines = [
        (None, "longest stable step in contact, theory"),
        (Some(DASHES), "step as long as the shortest contact"),
    ];
    let first = shown.len().next_multiple_of(LEGEND_ROWS);
    for (index, (dashes, name)) in lines.into_iter().enumerate() {
        let (x, y) = place(first + index);
        pen.rimmed(&[(x, y + 7.0), (x + 26.0, y + 7.0)], dashes);
        pen.text((x + 34.0, y + 11.5), 12, Align::Left, name);
    }
}
