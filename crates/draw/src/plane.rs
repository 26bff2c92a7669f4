//! A panel of coloured cells with its axes: a map over two quantities.

use super::pen::{Align, Area, Pen};

/// A panel: where it lies on the page, and what its axes span.
#[derive(Debug, Clone, Copy)]
pub struct Plane {
    pub area: Area,
    /// Values at the left and right edge.
    pub x: (f64, f64),
    /// Values at the lower and upper edge.
    pub y: (f64, f64),
    /// Size of letters.
    pub letters: u32,
}

/// A point of the page or of the axes.
type Point = (f64, f64);

/// Numbers on an axis.
const TICKS: f64 = 6.0;
/// Length of a tick.
const TICK: f64 = 6.0;

impl Plane {
    /// Where a point of the axes lies on the page.
    pub fn place(&self, (x, y): Point) -> Point {
        let (left, top, width, height) = self.area;
        (
            left + width * share(self.x, x),
            top + height * (1.0 - share(self.y, y)),
        )
    }

    /// Fills it with rows of cells, the lowest row first; runs of one colour are one rectangle.
    pub fn cells(&self, pen: &mut Pen, columns: usize, colors: &[&str]) {
        let (left, top, width, height) = self.area;
        let rows = colors.len() / columns;
        let (wide, high) = (width / columns as f64, height / rows as f64);
        let mut tiles = Vec::new();
        for (row, colors) in colors.chunks(columns).enumerate() {
            let above = top + height - high * (row + 1) as f64;
            let mut from = 0;
            for run in colors.chunk_by(|a, b| a == b) {
                let area = (
                    left + wide * from as f64,
                    above,
                    wide * run.len() as f64,
                    high,
                );
                tiles.push((area, run[0]));
                from += run.len();
            }
        }
        pen.mosaic(&tiles);
    }

    /// Frame, ticks with their numbers, and names.
    pub fn axes(&self, pen: &mut Pen, across: &str, up: &str) {
        let (left, top, width, height) = self.area;
        let letters = f64::from(self.letters);
        pen.frame(self.area);
        for value in ticks(self.x) {
            let (x, y) = self.place((value, self.y.0));
            pen.tick((x, y), (x, y + TICK));
            let below = (x, y + TICK + 1.1 * letters);
            pen.text(below, self.letters, Align::Middle, &number(value));
        }
        let mut widest = 0;
        for value in ticks(self.y) {
            let (x, y) = self.place((self.x.0, value));
            pen.tick((x - TICK, y), (x, y));
            let beside = (x - TICK - 4.0, y + 0.35 * letters);
            let text = number(value);
            widest = widest.max(text.chars().count());
            pen.text(beside, self.letters, Align::Right, &text);
        }
        let below = (left + 0.5 * width, top + height + TICK + 2.6 * letters);
        pen.text(below, self.letters, Align::Middle, across);
        let room = TICK + (0.62 * widest as f64 + 1.0) * letters;
        let beside = (left - room, top + 0.5 * height);
        pen.text(beside, self.letters, Align::Upwards, up);
    }

    /// The parts of a curve that lie inside; with lengths of dashes and gaps it is dashed.
    pub fn curve(&self, pen: &mut Pen, points: &[Point], dashes: Option<(f64, f64)>) {
        for piece in self.inside(points) {
            let places: Vec<Point> = piece.into_iter().map(|point| self.place(point)).collect();
            match dashes {
                None => pen.curve(&places, None),
                Some(lengths) => {
                    for dash in dashed(&places, lengths) {
                        pen.curve(&dash, None);
                    }
                }
            }
        }
    }

    /// True if a point lies inside.
    pub fn holds(&self, (x, y): Point) -> bool {
        (0.0..=1.0).contains(&share(self.x, x)) && (0.0..=1.0).contains(&share(self.y, y))
    }

    /// The pieces of a line inside.
    fn inside(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        for pair in points.windows(2) {
            let Some((from, to)) = self.clipped(pair[0], pair[1]) else {
                continue;
            };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&from) => piece.push(to),
                _ => pieces.push(vec![from, to]),
            }
        }
        pieces
    }

    /// The part of a segment inside (Liang and Barsky 1984).
    fn clipped(&self, from: Point, to: Point) -> Option<(Point, Point)> {
        let way = (to.0 - from.0, to.1 - from.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let edges = [
            (-way.0, from.0 - self.x.0),
            (way.0, self.x.1 - from.0),
            (-way.1, from.1 - self.y.0),
            (way.1, self.y.1 - from.1),
        ];
        for (towards, room) in edges {
            if towards < 0.0 {
                enter = enter.max(room / towards);
            } else if towards > 0.0 {
                leave = leave.min(room / towards);
            } else if room < 0.0 {
                return None;
            }
        }
        let at = |share: f64| (from.0 + share * way.0, from.1 + share * way.1);
        let begin = if enter == 0.0 { from } else { at(enter) };
        let end = if leave == 1.0 { to } else { at(leave) };
        (enter < leave).then_some((begin, end))
    }
}

/// The dashes of a line, evenly long however its points lie: the renderer begins anew at each of them.
fn dashed(points: &[Point], (dash, gap): (f64, f64)) -> Vec<Vec<Point>> {
    let mut dashes: Vec<Vec<Point>> = Vec::new();
    let mut done = 0.0;
    for pair in points.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let way = (to.0 - from.0, to.1 - from.1);
        let length = way.0.hypot(way.1);
        let mut at = 0.0;
        while at < length {
            let phase = (done + at) % (dash + gap);
            let rest = if phase < dash { dash } else { dash + gap } - phase;
            let next = (at + rest.max(1e-6)).min(length);
            let point = |at: f64| (from.0 + way.0 * at / length, from.1 + way.1 * at / length);
            if phase < dash {
                match dashes.last_mut() {
                    Some(last) if phase > 0.0 && at == 0.0 => last.push(point(next)),
                    _ => dashes.push(vec![point(at), point(next)]),
                }
            }
            at = next;
        }
        done += length;
    }
    dashes
}

/// Where a value lies on an axis, from 0 to 1.
fn share((from, to): (f64, f64), value: f64) -> f64 {
    (value - from) / (to - from)
}

/// Round numbers on an axis.
fn ticks((from, to): (f64, f64)) -> Vec<f64> {
    let rough = (to - from) / TICKS;
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let step = steps
        .into_iter()
        .find(|step| *step >= 0.999 * rough)
        .unwrap_or(rough);
    // An end that is a tick but for rounding is one.
    let first = (from / step - 1e-9).ceil() as i64;
    let last = (to / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A number in print.
pub fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_cut_at_the_edges_and_comes_back() {
        let plane = Plane {
            area: (0.0, 0.0, 100.0, 100.0),
            x: (0.0, 1.0),
            y: (0.0, 1.0),
            letters: 10,
        };
        let line = [
            (-1.0, 0.5),
            (0.5, 0.5),
            (0.5, 2.0),
            (0.75, 2.0),
            (0.75, 0.0),
        ];
        let pieces = plane.inside(&line);
        assert_eq!(
            pieces,
            [
                vec![(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)],
                vec![(0.75, 1.0), (0.75, 0.0)]
            ]
        );
        assert_eq!(ticks((0.9, 1.0)).len(), 6);
    }
}
