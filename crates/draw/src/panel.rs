//! A panel of a drawing: two axes, and what is drawn between them.

use std::collections::BTreeSet;

use super::pen::{Align, Area, Pen, Stroke};
use super::style;

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

/// How axes are written.
#[derive(Debug, Clone, Copy)]
pub struct Axes<'a> {
    /// Size of the numbers.
    pub letters: u32,
    /// Name below, if numbers and name are to be there.
    pub across: Option<&'a str>,
    /// Name at the left.
    pub upwards: &'a str,
    /// About how many numbers along each axis.
    pub ticks: (usize, usize),
}

impl Panel {
    /// Where a value of the axis across is.
    pub fn across(&self, x: f64) -> f64 {
        self.area.0 + self.area.2 * (x - self.x.0) / (self.x.1 - self.x.0)
    }

    /// Where a value of the axis upwards is.
    pub fn height(&self, y: f64) -> f64 {
        self.area.1 + self.area.3 * (self.y.1 - y) / (self.y.1 - self.y.0)
    }

    /// Where a point is.
    pub fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
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
        for (value, _) in ticks(self.x, axes.ticks.0) {
            let x = self.across(value);
            pen.line(&[(x, self.area.1), (x, self.bottom())], line);
        }
        for (value, _) in ticks(self.y, axes.ticks.1) {
            let y = self.height(value);
            pen.line(&[(self.area.0, y), (self.right(), y)], line);
        }
    }

    /// Frame, ticks, numbers and names.
    pub fn axes(&self, pen: &mut Pen, axes: &Axes<'_>) {
        let (left, top, width, height) = self.area;
        let size = f64::from(axes.letters);
        for (value, name) in ticks(self.x, axes.ticks.0) {
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
        for (value, name) in ticks(self.y, axes.ticks.1) {
            let y = self.height(value);
            pen.tick((left - TICK, y), (left, y));
            pen.text(
                (left - TICK - 4.0, y + 0.36 * size),
                axes.letters,
                Align::Right,
                &name,
            );
            widest = widest.max(super::pen::width(axes.letters, &name));
        }
        let place = (left - TICK - 8.0 - widest - 0.5 * size, top + 0.5 * height);
        pen.text(place, axes.letters + 1, Align::Upwards, axes.upwards);
        pen.frame(self.area);
    }

    /// Dots inside the panel; those that would hide each other are one.
    pub fn dots(
        &self,
        pen: &mut Pen,
        points: impl Iterator<Item = (f64, f64)>,
        radius: f64,
        color: &str,
    ) {
        let inside = points.filter(|&(x, y)| {
            (self.x.0..=self.x.1).contains(&x) && (self.y.0..=self.y.1).contains(&y)
        });
        let square = |point| {
            let (x, y) = self.place(point);
            ((x / GRAIN).round() as i64, (y / GRAIN).round() as i64)
        };
        let seen: BTreeSet<(i64, i64)> = inside.map(square).collect();
        let places: Vec<(f64, f64)> = seen
            .into_iter()
            .map(|(x, y)| (x as f64 * GRAIN, y as f64 * GRAIN))
            .collect();
        if !places.is_empty() {
            pen.dots(&places, radius, color);
        }
    }

    /// As much of a curve as lies inside.
    pub fn curve(&self, pen: &mut Pen, points: &[(f64, f64)], stroke: Stroke) {
        let mut piece: Vec<(f64, f64)> = Vec::new();
        for pair in points.windows(2) {
            let Some((from, to)) = self.clip(pair[0], pair[1]) else {
                continue;
            };
            if piece.last() != Some(&from) {
                self.piece(pen, &piece, stroke);
                piece = vec![from];
            }
            piece.push(to);
        }
        self.piece(pen, &piece, stroke);
    }

    fn piece(&self, pen: &mut Pen, points: &[(f64, f64)], stroke: Stroke) {
        let places: Vec<(f64, f64)> = points.iter().map(|point| self.place(*point)).collect();
        if places.len() > 1 {
            pen.line(&places, stroke);
        }
    }

    /// The part of a straight line that lies inside (Liang and Barsky 1984).
    fn clip(&self, from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
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

/// Round values in a range, about so many, and how they are written.
fn ticks((low, high): (f64, f64), count: usize) -> Vec<(f64, String)> {
    let rough = (high - low) / count.max(1) as f64;
    let power = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|factor| factor * power >= 0.999 * rough);
    let step = factor.unwrap_or(10.0) * power;
    let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    let (first, last) = (
        (low / step - 1e-6).ceil() as i64,
        (high / step + 1e-6).floor() as i64,
    );
    let written = |index: i64| {
        let value = index as f64 * step;
        (value, format!("{value:.decimals$}").replace('-', "−"))
    };
    (first..=last).map(written).collect()
}

/// The heading of a page and a line that explains it.
pub fn heading(pen: &mut Pen, (left, top): (f64, f64), title: &str, explanation: &str) {
    pen.heading((left, top), 20, Align::Left, title);
    pen.words(
        (left, top + 22.0),
        13,
        Align::Left,
        (style::ASIDE, false),
        explanation,
    );
}

#[cfg(test)]
mod tests {
    use super::{Panel, ticks};

    #[test]
    fn ticks_are_round_and_inside() {
        let names = |range, count| -> Vec<String> {
            ticks(range, count).into_iter().map(|tick| tick.1).collect()
        };
        assert_eq!(
            names((0.8, 1.0), 4),
            ["0.80", "0.85", "0.90", "0.95", "1.00"]
        );
        assert_eq!(names((-1.0, 1.0), 4), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(names((0.0, 25.0), 5), ["0", "5", "10", "15", "20", "25"]);
    }

    #[test]
    fn lines_are_cut_at_the_frame() {
        let panel = Panel {
            area: (0.0, 0.0, 1.0, 1.0),
            x: (0.0, 1.0),
            y: (0.0, 1.0),
        };
        let cut = panel.clip((-1.0, 0.5), (3.0, 0.5));
        assert_eq!(cut, Some(((0.0, 0.5), (1.0, 0.5))));
        assert_eq!(panel.clip((0.0, 2.0), (1.0, 3.0)), None);
    }
}
