//! Legends: signs, and what they stand for.

use crate::canvas::{Area, Canvas};
use crate::chart::{Corner, Legend, Panel};
use crate::grid::GAP;
use crate::index::width;
use crate::mark::{Align, Sign};
use crate::stroke::Point;
use crate::style;

/// Length of a sign with the room behind it, and heights of a line and of one more, in units of the letters.
const SIGN: f64 = 2.8;
const LINE: f64 = 1.6;
const MORE: f64 = 1.35;
/// Room behind an entry that another one follows.
const BEHIND: f64 = 20.0;

/// Signs and their name; a second line of a name stands below the first, which is bold then.
struct Entry {
    signs: Vec<Sign>,
    lines: Vec<String>,
    width: f64,
    height: f64,
}

/// What explains the layers of some panels.
pub(crate) struct Key {
    entries: Vec<Entry>,
    letters: u32,
}

impl Key {
    /// That of all named layers, each name once.
    pub(crate) fn new<'a>(panels: impl IntoIterator<Item = &'a Panel>, letters: u32) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for layer in panels.into_iter().flat_map(|panel| &panel.layers) {
            let Some(sign) = layer.sign.filter(|_| !layer.name.is_empty()) else {
                continue;
            };
            let lines: Vec<String> = layer.name.lines().map(str::to_owned).collect();
            match entries.iter_mut().find(|entry| entry.lines == lines) {
                Some(entry) if entry.signs.contains(&sign) => {}
                Some(entry) => entry.signs.push(sign),
                None => entries.push(Entry::new(sign, lines, letters)),
            }
        }
        Self { entries, letters }
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Width and height of the entries below each other.
    fn column(&self) -> (f64, f64) {
        let widths = self.entries.iter().map(|it| it.width);
        let heights = self.entries.iter().map(|it| it.height);
        (widths.fold(0.0, f64::max), heights.sum())
    }

    /// Where the entries are in lines of this width, and the height of all lines.
    fn flow(&self, room: f64) -> (Vec<Point>, f64) {
        let (mut x, mut y, mut high, mut places) = (0.0, 0.0, 0.0f64, Vec::new());
        for entry in &self.entries {
            if x > 0.0 && x + entry.width > room {
                (x, y, high) = (0.0, y + high, 0.0);
            }
            places.push((x, y));
            x += entry.width + BEHIND;
            high = high.max(entry.height);
        }
        (places, y + high)
    }

    /// Room that it needs beside, above and below what is so wide.
    pub(crate) fn room(&self, legend: Legend, wide: f64) -> [f64; 3] {
        let lines = || self.flow(wide).1 + 0.5 * GAP;
        match legend {
            _ if self.is_empty() => [0.0; 3],
            Legend::Right => [GAP + self.column().0, 0.0, 0.0],
            Legend::Above => [0.0, lines(), 0.0],
            Legend::Below => [0.0, 0.0, lines()],
            Legend::Inside(_) => [0.0; 3],
        }
    }

    /// Height below which it does not fit beside something.
    pub(crate) fn height(&self, legend: Legend) -> f64 {
        match legend {
            Legend::Right => self.column().1,
            _ => 0.0,
        }
    }

    /// Draws it beside, above, below or inside an area, at the edge of a larger one.
    pub(crate) fn draw(&self, canvas: &mut Canvas, legend: Legend, inner: Area, outer: Area) {
        if self.is_empty() {
            return;
        }
        let (left, top, width, height) = inner;
        let (right, bottom) = (left + width, top + height);
        let (wide, high) = self.column();
        let (lower, end) = (outer.1 + outer.3, outer.0 + outer.2);
        let (lines, tall) = self.flow(width);
        let at = match legend {
            Legend::Right => (end - wide, top),
            Legend::Above => (left, outer.1),
            Legend::Below => (left, lower - tall),
            Legend::Inside(corner) => {
                let (inner, lower) = (right - wide - GAP, bottom - high - GAP);
                let (x, y) = match corner {
                    Corner::TopLeft => (left + GAP, top + 6.0),
                    Corner::TopRight => (inner, top + 6.0),
                    Corner::BottomLeft => (left + GAP, lower),
                    Corner::BottomRight => (inner, lower),
                };
                let plate = (x - 4.0, y, wide + 8.0, high + 6.0);
                canvas.tint(plate, style::PAPER, 0.82);
                (x, y)
            }
        };
        let is_flowing = matches!(legend, Legend::Above | Legend::Below);
        let mut below = 0.0;
        for (entry, (x, y)) in self.entries.iter().zip(lines) {
            let (x, y) = if is_flowing { (x, y) } else { (0.0, below) };
            entry.draw(canvas, (at.0 + x, at.1 + y), self.letters);
            below += entry.height;
        }
    }
}

impl Entry {
    fn new(sign: Sign, lines: Vec<String>, letters: u32) -> Self {
        let texts = lines.iter().map(|text| width(letters, text));
        let size = f64::from(letters);
        Self {
            signs: vec![sign],
            width: SIGN * size + texts.fold(0.0, f64::max),
            height: size * (LINE + MORE * (lines.len().max(1) - 1) as f64),
            lines,
        }
    }

    /// With its upper left corner at a place.
    fn draw(&self, canvas: &mut Canvas, (left, top): Point, letters: u32) {
        let size = f64::from(letters);
        let mut line = top + 1.1 * size;
        for sign in &self.signs {
            canvas.sign((left, line), letters, *sign);
        }
        for (index, text) in self.lines.iter().enumerate() {
            let place = (left + SIGN * size, line);
            match self.lines.len() > 1 && index == 0 {
                true => canvas.heading(place, letters, text),
                false => canvas.text(place, letters, Align::Left, text),
            }
            line += MORE * size;
        }
    }
}
