//! A panel of a drawing: two axes, and what is drawn between them.

use std::collections::{BTreeMap, BTreeSet};

pub use crate::axes::Axes;
use crate::pen::{self, Align, Area, Pen, Stroke};
use crate::stroke::Point;
use crate::style;

/// Length of a tick.
const TICK: f64 = 5.0;
/// Points in one square of this size are one.
const GRAIN: f64 = 0.5;
/// Colour of the lines behind.
const GRID: &str = "#e9e9e9";

/// Two axes.
#[derive(Debug, Clone, Copy)]
pub struct Panel {
    /// Where it is.
    pub area: Area,
    /// Range of the axis across.
    pub x: (f64, f64),
    /// Range of the axis upwards.
    pub y: (f64, f64),
}

impl Panel {
    /// A panel at this place, with the ranges of both axes.
    pub const fn new(area: Area, x: (f64, f64), y: (f64, f64)) -> Self {
        Self { area, x, y }
    }

    /// Where a value of the axis across is.
    pub fn across(&self, x: f64) -> f64 {
        self.area.0 + self.area.2 * (x - self.x.0) / (self.x.1 - self.x.0)
    }

    /// Where a value of the axis upwards is.
    pub fn height(&self, y: f64) -> f64 {
        self.area.1 + self.area.3 * (self.y.1 - y) / (self.y.1 - self.y.0)
    }

    /// Where a point is.
    pub fn place(&self, (x, y): Point) -> Point {
        (self.across(x), self.height(y))
    }

    /// Its bottom on the page.
    pub fn bottom(&self) -> f64 {
        self.area.1 + self.area.3
    }

    /// Its right end on the page.
    pub fn right(&self) -> f64 {
        self.area.0 + self.area.2
    }

    /// The lines behind what is drawn.
    pub fn ground(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let line = Stroke::solid(GRID, 1.0);
        for (value, _) in axes.marks(self.x, axes.ticks.0) {
            let x = self.across(value);
            pen.line(&[(x, self.area.1), (x, self.bottom())], line);
        }
        for (value, _) in axes.marks(self.y, axes.ticks.1) {
            let y = self.height(value);
            pen.line(&[(self.area.0, y), (self.right(), y)], line);
        }
    }

    /// Frame, ticks, numbers and names.
    pub fn axes(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let (left, top, width, height) = self.area;
        let size = f64::from(axes.letters);
        for (value, name) in axes.marks(self.x, axes.ticks.0) {
            let x = self.across(value);
            pen.tick((x, self.bottom()), (x, self.bottom() + TICK));
            if axes.across.is_some() {
                let place = (x, self.bottom() + TICK + 1.1 * size);
                pen.text(place, axes.letters, Align::Middle, &name);
            }
        }
        if let Some(name) = axes.across {
            let place = (left + 0.5 * width, self.bottom() + TICK + 2.7 * size);
            pen.text(place, axes.letters + 1, Align::Middle, name);
        }
        let mut widest = 0.0f64;
        for (value, name) in axes.marks(self.y, axes.ticks.1) {
            let y = self.height(value);
            pen.tick((left - TICK, y), (left, y));
            let place = (left - TICK - 4.0, y + 0.36 * size);
            pen.text(place, axes.letters, Align::Right, &name);
            widest = widest.max(pen::width(axes.letters, &name));
        }
        let place = (left - TICK - 8.0 - widest - 0.5 * size, top + 0.5 * height);
        pen.text(place, axes.letters + 1, Align::Upwards, axes.upwards);
        pen.frame(self.area);
    }

    /// Dots inside the panel; those that would hide each other are one.
    pub fn dots(
        &self,
        pen: &mut Pen,
        points: impl Iterator<Item = Point>,
        radius: f64,
        color: &str,
    ) {
        let inside = points.filter(|point| self.holds(*point));
        let square = |point| {
            let (x, y) = self.place(point);
            ((x / GRAIN).round() as i64, (y / GRAIN).round() as i64)
        };
        let seen: BTreeSet<(i64, i64)> = inside.map(square).collect();
        let place = |(x, y)| (x as f64 * GRAIN, y as f64 * GRAIN);
        let places: Vec<Point> = seen.into_iter().map(place).collect();
        if !places.is_empty() {
            pen.dots(&places, radius, color);
        }
    }

    /// Rows of cells that fill it, the lowest row first, in few rectangles: runs of one colour, joined with the same runs of
    /// the row below; edges lie on half units. What has no colour stays as it is.
    pub fn cells(&self, pen: &mut Pen, columns: usize, colors: &[&str]) {
        let (left, _, width, height) = self.area;
        let rows = colors.len() / columns;
        let edge = |place: f64| (2.0 * place).round() / 2.0;
        let across = |column: usize| edge(left + width * column as f64 / columns as f64);
        let up = |row: usize| edge(self.bottom() - height * row as f64 / rows as f64);
        let mut areas: BTreeMap<&str, Vec<Area>> = BTreeMap::new();
        // The first row of each run of the row before.
        let mut open: BTreeMap<(usize, usize, &str), usize> = BTreeMap::new();
        for row in 0..=rows {
            let mut runs = BTreeMap::new();
            let mut from = 0;
            let cells = colors.get(row * columns..(row + 1) * columns);
            for run in cells.unwrap_or_default().chunk_by(|a, b| a == b) {
                let key = (from, from + run.len(), run[0]);
                runs.insert(key, open.remove(&key).unwrap_or(row));
                from += run.len();
            }
            for ((from, to, color), first) in std::mem::replace(&mut open, runs) {
                let (left, top) = (across(from), up(row));
                let area = (left, top, across(to) - left, up(first) - top);
                areas.entry(color).or_default().push(area);
            }
        }
        for (color, areas) in areas.iter().filter(|it| !it.0.is_empty()) {
            pen.fill(areas, color);
        }
    }

    /// As much of a curve as lies inside.
    pub fn curve(&self, pen: &mut Pen, points: &[Point], stroke: Stroke) {
        for piece in self.inside(points) {
            pen.line(&piece, stroke);
        }
    }

    /// The ground between two curves that lie inside: places across, lower and upper values.
    pub fn band(&self, pen: &mut Pen, places: &[(f64, [f64; 2])], color: &str, opacity: f64) {
        let edge = |end: usize| {
            let edge = places.iter();
            edge.map(move |(x, ends)| self.place((*x, ends[end])))
        };
        let corners: Vec<Point> = edge(0).chain(edge(1).rev()).collect();
        pen.area(&corners, color, Some(opacity));
    }

    /// The same, seen on any ground; with lengths of dashes and gaps it is dashed.
    pub fn rimmed(&self, pen: &mut Pen, points: &[Point], dashes: Option<(f64, f64)>) {
        for piece in self.inside(points) {
            pen.rimmed(&piece, dashes);
        }
    }

    /// Words in the middle of a panel that has nothing else to show.
    pub fn message(&self, pen: &mut Pen, letters: u32, words: &str) {
        let (left, top, width, height) = self.area;
        let place = (left + 0.5 * width, top + 0.5 * height);
        pen.words(place, letters, Align::Middle, (style::ASIDE, false), words);
    }

    /// True if a point lies inside.
    pub fn holds(&self, (x, y): Point) -> bool {
        (self.x.0..=self.x.1).contains(&x) && (self.y.0..=self.y.1).contains(&y)
    }

    /// The pieces of a curve that lie inside, on the page.
    fn inside(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        for pair in points.windows(2) {
            let Some((from, to)) = self.clip(pair[0], pair[1]) else {
                continue;
            };
            let (from, to) = (self.place(from), self.place(to));
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&from) => piece.push(to),
                _ => pieces.push(vec![from, to]),
            }
        }
        pieces
    }

    /// The part of a straight line that lies inside (Liang and Barsky 1984).
    fn clip(&self, from: Point, to: Point) -> Option<(Point, Point)> {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let borders = [
            (-x, from.0 - self.x.0),
            (x, self.x.1 - from.0),
            (-y, from.1 - self.y.0),
            (y, self.y.1 - from.1),
        ];
        let (mut begin, mut end) = (0.0f64, 1.0f64);
        for (rate, room) in borders {
            if rate == 0.0 && room < 0.0 {
                return None;
            }
            match rate {
                rate if rate < 0.0 => begin = begin.max(room / rate),
                rate if rate > 0.0 => end = end.min(room / rate),
                _ => {}
            }
        }
        let at = |share: f64| match share {
            0.0 => from,
            1.0 => to,
            share => (from.0 + share * x, from.1 + share * y),
        };
        (begin < end).then(|| (at(begin), at(end)))
    }
}

/// The heading of a page and a line that explains it.
pub fn heading(pen: &mut Pen, (left, top): (f64, f64), title: &str, explanation: &str) {
    pen.heading((left, top), 20, Align::Left, title);
    let (place, grey) = ((left, top + 22.0), (style::ASIDE, false));
    pen.words(place, 13, Align::Left, grey, explanation);
}

#[cfg(test)]
mod tests {
    use super::Panel;

    #[test]
    fn lines_are_cut_at_the_frame() {
        let panel = Panel::new((0.0, 0.0, 1.0, 1.0), (0.0, 1.0), (0.0, 1.0));
        let cut = panel.clip((-1.0, 0.5), (3.0, 0.5));
        assert_eq!(cut, Some(((0.0, 0.5), (1.0, 0.5))));
        assert_eq!(panel.clip((0.0, 2.0), (1.0, 3.0)), None);
    }

    #[test]
    fn a_curve_that_leaves_comes_back_as_another_piece() {
        let panel = Panel::new((0.0, 0.0, 100.0, 100.0), (0.0, 1.0), (0.0, 1.0));
        let line = [
            (-1.0, 0.5),
            (0.5, 0.5),
            (0.5, 2.0),
            (0.75, 2.0),
            (0.75, 0.0),
        ];
        assert_eq!(
            panel.inside(&line),
            [
                vec![(0.0, 50.0), (50.0, 50.0), (50.0, 0.0)],
                vec![(75.0, 0.0), (75.0, 100.0)]
            ]
        );
    }
}
