//! Legends: signs, and what they stand for.

use crate::chart::Panel;
use crate::index::width;
use crate::pen::{Align, Pen};
use crate::shapes::Sign;
use crate::stroke::Point;

/// Length of a sign with the room behind it, and heights of a line and of one more, in units of the letters.
const SIGN: f64 = 2.8;
const LINE: f64 = 1.6;
const MORE: f64 = 1.35;
/// Room behind an entry that another one follows.
const BEHIND: f64 = 20.0;

/// Signs and their name; a second line of a name stands below the first, which is bold then.
pub(crate) struct Entry {
    signs: Vec<Sign>,
    lines: Vec<String>,
}

/// The entries of all named layers, each name once.
pub(crate) fn entries<'a>(panels: impl Iterator<Item = &'a Panel>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for layer in panels.flat_map(|panel| &panel.layers) {
        let Some(sign) = layer.sign().filter(|_| !layer.name.is_empty()) else {
            continue;
        };
        let lines: Vec<String> = layer.name.lines().map(str::to_owned).collect();
        match entries.iter_mut().find(|entry| entry.lines == lines) {
            Some(entry) if entry.signs.contains(&sign) => {}
            Some(entry) => entry.signs.push(sign),
            None => entries.push(Entry {
                signs: vec![sign],
                lines,
            }),
        }
    }
    entries
}

impl Entry {
    fn width(&self, letters: u32) -> f64 {
        let texts = self.lines.iter().map(|text| 0.92 * width(letters, text));
        SIGN * f64::from(letters) + texts.fold(0.0, f64::max)
    }

    fn height(&self, letters: u32) -> f64 {
        f64::from(letters) * (LINE + MORE * (self.lines.len() - 1) as f64)
    }

    /// With its upper left corner at a place.
    fn draw(&self, pen: &mut Pen, (left, top): Point, letters: u32) {
        let size = f64::from(letters);
        let mut line = top + 1.1 * size;
        for sign in &self.signs {
            pen.sign((left, line), letters, *sign);
        }
        for (index, text) in self.lines.iter().enumerate() {
            let place = (left + SIGN * size, line);
            match self.lines.len() > 1 && index == 0 {
                true => pen.heading(place, letters, Align::Left, text),
                false => pen.text(place, letters, Align::Left, text),
            }
            line += MORE * size;
        }
    }
}

/// Width and height of entries below each other.
pub(crate) fn column(entries: &[Entry], letters: u32) -> (f64, f64) {
    let widths = entries.iter().map(|it| it.width(letters));
    let heights = entries.iter().map(|it| it.height(letters));
    (widths.fold(0.0, f64::max), heights.sum())
}

/// Entries below each other.
pub(crate) fn draw_column(pen: &mut Pen, (left, mut top): Point, letters: u32, entries: &[Entry]) {
    for entry in entries {
        entry.draw(pen, (left, top), letters);
        top += entry.height(letters);
    }
}

/// Where entries stand in lines of this width, and the height of all lines.
fn flow(entries: &[Entry], letters: u32, room: f64) -> (Vec<Point>, f64) {
    let (mut x, mut y, mut high, mut places) = (0.0, 0.0, 0.0f64, Vec::new());
    for entry in entries {
        let wide = entry.width(letters);
        if x > 0.0 && x + wide > room {
            (x, y, high) = (0.0, y + high, 0.0);
        }
        places.push((x, y));
        x += wide + BEHIND;
        high = high.max(entry.height(letters));
    }
    (places, y + high)
}

/// Height of entries in lines of this width.
pub(crate) fn height(entries: &[Entry], letters: u32, room: f64) -> f64 {
    flow(entries, letters, room).1
}

/// Entries in lines of this width.
pub(crate) fn draw_lines(
    pen: &mut Pen,
    (left, top): Point,
    letters: u32,
    room: f64,
    entries: &[Entry],
) {
    let places = flow(entries, letters, room).0;
    for (entry, (x, y)) in entries.iter().zip(places) {
        entry.draw(pen, (left + x, top + y), letters);
    }
}
