//! The frame of a panel: where values are on the page, and what of points, curves and cells lies inside.

use std::collections::{BTreeMap, BTreeSet};

use crate::canvas::Area;
use crate::stroke::Point;

/// Points in one square of this size are one.
const GRAIN: f64 = 0.5;

/// Two axes on the page.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    /// Where it is.
    pub(crate) area: Area,
    /// Range of the axis across.
    pub(crate) x: (f64, f64),
    /// Range of the axis upwards.
    pub(crate) y: (f64, f64),
}

impl Frame {
    /// Where a value of the axis across is.
    pub(crate) fn x_of(&self, x: f64) -> f64 {
        self.area.0 + self.area.2 * (x - self.x.0) / (self.x.1 - self.x.0)
    }

    /// Where a value of the axis upwards is.
    pub(crate) fn y_of(&self, y: f64) -> f64 {
        self.area.1 + self.area.3 * (self.y.1 - y) / (self.y.1 - self.y.0)
    }

    /// Where a point is.
    pub(crate) fn place(&self, (x, y): Point) -> Point {
        (self.x_of(x), self.y_of(y))
    }

    /// Its lower end on the page.
    pub(crate) fn bottom(&self) -> f64 {
        self.area.1 + self.area.3
    }

    /// Its right end on the page.
    pub(crate) fn right(&self) -> f64 {
        self.area.0 + self.area.2
    }

    /// True if a point lies inside.
    pub(crate) fn holds(&self, (x, y): Point) -> bool {
        (self.x.0..=self.x.1).contains(&x) && (self.y.0..=self.y.1).contains(&y)
    }

    /// The place inside that is nearest to a point.
    pub(crate) fn clamp(&self, (x, y): Point) -> Point {
        (x.clamp(self.x.0, self.x.1), y.clamp(self.y.0, self.y.1))
    }

    /// Places of the points inside; those that would hide each other are one.
    pub(crate) fn dots(&self, points: impl Iterator<Item = Point>) -> Vec<Point> {
        let square = |point| {
            let (x, y) = self.place(point);
            ((x / GRAIN).round() as i64, (y / GRAIN).round() as i64)
        };
        let inside = points.filter(|point| self.holds(*point));
        let squares: BTreeSet<(i64, i64)> = inside.map(square).collect();
        let squares = squares.into_iter();
        squares
            .map(|(x, y)| (x as f64 * GRAIN, y as f64 * GRAIN))
            .collect()
    }

    /// Rows of cells that fill it, the lowest row first, as few rectangles of each colour: runs of one colour, joined with
    /// the same runs of the row below; edges lie on half units. What has no colour has no rectangle.
    pub(crate) fn cells<'a>(
        &self,
        columns: usize,
        colors: &[&'a str],
    ) -> BTreeMap<&'a str, Vec<Area>> {
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
        areas.remove("");
        areas
    }

    /// The pieces of a curve that lie inside, on the page.
    pub(crate) fn inside(&self, points: &[Point]) -> Vec<Vec<Point>> {
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
#[cfg(test)]
mod tests {
    use super::Frame;

    /// A square of this side, both axes from 0 to 1.
    fn frame(side: f64) -> Frame {
        let range = (0.0, 1.0);
        Frame {
            area: (0.0, 0.0, side, side),
            x: range,
            y: range,
        }
    }

    #[test]
    fn lines_are_cut_at_the_frame() {
        let frame = frame(1.0);
        let cut = frame.clip((-1.0, 0.5), (3.0, 0.5));
        assert_eq!(cut, Some(((0.0, 0.5), (1.0, 0.5))));
        assert_eq!(frame.clip((0.0, 2.0), (1.0, 3.0)), None);
    }

    #[test]
    fn a_curve_that_leaves_comes_back_as_another_piece() {
        let frame = frame(100.0);
        let line = [
            (-1.0, 0.5),
            (0.5, 0.5),
            (0.5, 2.0),
            (0.75, 2.0),
            (0.75, 0.0),
        ];
        assert_eq!(
            frame.inside(&line),
            [
                vec![(0.0, 50.0), (50.0, 50.0), (50.0, 0.0)],
                vec![(75.0, 0.0), (75.0, 100.0)]
            ]
        );
    }
}
