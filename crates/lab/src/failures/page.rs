//! A page of the atlas: a map for each method, the strip of the exact one, the legend.

use crate::methods::Verdict;

use super::heat::{DASHES, Grid};
use crate::failures::{Atlas, Axes, Map};
use softstop_draw::pen::{Align, Pen};

/// Width of a map in pixels, about.
const MAP: f64 = 168.0;
/// Between maps beside each other.
const GAP: f64 = 18.0;
/// Left of the first map.
const LEFT: f64 = 96.0;
/// Right of the last map.
const RIGHT: f64 = 26.0;
/// Above the first row.
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
pub fn page(atlas: &Atlas) -> String {
    Page::new(atlas).draw()
}

struct Page<'a> {
    atlas: &'a Atlas,
    rows: Vec<Vec<&'a Map>>,
    cell: f64,
    pen: Pen,
}

impl<'a> Page<'a> {
    fn new(atlas: &'a Atlas) -> Self {
        let mut rows: Vec<Vec<&Map>> = Vec::new();
        for map in &atlas.maps {
            let name = map.family.row();
            match rows.iter_mut().find(|row| row[0].family.row() == name) {
                Some(row) => row.push(map),
                None => rows.push(vec![map]),
            }
        }
        let points = atlas.axes.stiffness.len() as f64;
        let cell = (MAP / points).round().max(1.0);
        let across = rows.iter().map(Vec::len).fold(NARROWEST, usize::max) as f64;
        let down = rows.len() as f64;
        let map = cell * points;
        let height = cell * atlas.axes.step.len() as f64;
        Self {
            atlas,
            pen: Pen::new(
                LEFT + across * (map + GAP) - GAP + RIGHT,
                TOP + down * (height + BETWEEN) + BELOW,
            ),
            rows,
            cell,
        }
    }

    fn draw(mut self) -> String {
        self.headings();
        for (row, maps) in self.rows.clone().iter().enumerate() {
            self.row(row, maps);
        }
        let bottom = self.corner(self.rows.len(), 0).1;
        self.exact(bottom);
        self.legend(bottom);
        self.pen.svg()
    }

    fn grid(&self, corner: (f64, f64)) -> Grid<'a> {
        Grid {
            axes: &self.atlas.axes,
            corner,
            cell: (self.cell, self.cell),
        }
    }

    fn corner(&self, row: usize, column: usize) -> (f64, f64) {
        let (width, height) = self.grid((0.0, 0.0)).size();
        (
            LEFT + column as f64 * (width + GAP),
            TOP + row as f64 * (height + BETWEEN),
        )
    }

    fn headings(&mut self) {
        let view = &self.atlas.view;
        let unit = if view.periods == 1.0 {
            "drive period"
        } else {
            "drive periods"
        };
        let below = format!(
            "Each cell is one run: step h as a share of the drive period T, over the stop's stiffness k, for {} {unit}. \
             Errors up to {} % of the motion pass.",
            view.periods,
            100.0 * self.atlas.tolerance
        );
        self.pen.heading((LEFT, 32.0), 19, Align::Left, &view.title);
        self.pen.text((LEFT, 54.0), 13, Align::Left, &below);
    }

    fn row(&mut self, row: usize, maps: &[&Map]) {
        for (column, map) in maps.iter().enumerate() {
            let grid = self.grid(self.corner(row, column));
            self.map(&grid, map);
            if column == 0 {
                grid.step_axis(&mut self.pen);
                self.row_heading(&grid, map.family.row());
            }
        }
    }

    fn row_heading(&mut self, grid: &Grid<'_>, name: &str) {
        let (left, top, _, height) = grid.area();
        let middle = top + 0.5 * height;
        let place = |aside: f64| (left - aside, middle);
        self.pen.heading(place(72.0), 14, Align::Upwards, name);
        self.pen.text(place(48.0), 12, Align::Upwards, "step h/T");
    }

    fn map(&mut self, grid: &Grid<'_>, map: &Map) {
        let (left, top, width, _) = grid.area();
        let verdicts: Vec<Vec<Verdict>> = map
            .columns
            .iter()
            .map(|cells| cells.iter().map(|cell| cell.verdict).collect())
            .collect();
        let pen = &mut self.pen;
        grid.verdicts(pen, &verdicts);
        let contacts: Vec<Option<f64>> = self
            .atlas
            .columns
            .iter()
            .map(|column| column.contact)
            .collect();
        grid.line(pen, &contacts, Some(DASHES));
        grid.line(pen, &map.limit, None);
        pen.frame(grid.area());
        grid.stiffness_axis(pen);
        let heading = (left + 0.5 * width, top - 8.0);
        pen.heading(heading, 13, Align::Middle, map.family.title());
    }

    /// The strip of the exact method, the same for all steps; blank where nothing else knows the true motion.
    fn exact(&mut self, top: f64) {
        let axes = Axes {
            stiffness: self.atlas.axes.stiffness.clone(),
            step: vec![1.0],
        };
        let grid = Grid {
            axes: &axes,
            corner: (LEFT, top),
            cell: (self.cell, STRIP),
        };
        let columns = &self.atlas.columns;
        let verdicts: Vec<Vec<Verdict>> = columns
            .iter()
            .map(|column| column.exact.iter().map(|cell| cell.verdict).collect())
            .collect();
        let pen = &mut self.pen;
        grid.verdicts(pen, &verdicts);
        pen.frame(grid.area());
        grid.stiffness_axis(pen);
        let middle = LEFT + 0.5 * grid.size().0;
        pen.heading((middle, top - 8.0), 13, Align::Middle, "exact: no step");
        let below = (middle, top + STRIP + 36.0);
        pen.text(below, 12, Align::Middle, "stiffness k (N/m)");
    }

    /// Colours and lines, beside the strip.
    fn legend(&mut self, top: f64) {
        let left = self.corner(0, 1).0 + GAP;
        let top = top - 14.0;
        let place = |index: usize| {
            let (row, column) = (index % LEGEND_ROWS, index / LEGEND_ROWS);
            (left + LEGEND * column as f64, top + 24.0 * row as f64)
        };
        let mut shown = Verdict::ALL.to_vec();
        shown.retain(|verdict| *verdict != Verdict::Unsuited || self.occurs(*verdict));
        let mut index = 0;
        for verdict in shown {
            let (x, y) = place(index);
            let swatch = (x, y, 22.0, 14.0);
            self.pen.fill(&[swatch], super::heat::color(verdict));
            self.pen.frame(swatch);
            let text = (x + 30.0, y + 11.5);
            self.pen.text(text, 12, Align::Left, verdict.name());
            index += 1;
        }
        let lines = [
            (None, "longest stable step in contact, theory"),
            (Some(DASHES), "step as long as the shortest contact"),
        ];
        index = index.next_multiple_of(LEGEND_ROWS);
        for (dashes, name) in lines {
            let (x, y) = place(index);
            let line = [(x, y + 7.0), (x + 26.0, y + 7.0)];
            self.pen.rimmed(&line, dashes);
            self.pen.text((x + 34.0, y + 11.5), 12, Align::Left, name);
            index += 1;
        }
    }

    fn occurs(&self, verdict: Verdict) -> bool {
        let cells = self.atlas.maps.iter().flat_map(|map| &map.columns);
        cells.flatten().any(|cell| cell.verdict == verdict)
    }
}
