//! Coloured shapes: dots, lines with dashes that go on over corners, arrows, words on a plate, badges.

use kuva::render::render::{PathData, Primitive};

use super::{Align, Pen};

/// Mean width of a letter in units of its size, of the letters in use.
const LETTER: f64 = 0.61;
/// Length and half the width of an arrow's head, in units of the line's width, and the least of both.
const HEAD: (f64, f64) = (6.0, 2.6);

/// A line's colour, its width, and the lengths of dashes and gaps.
#[derive(Debug, Clone, Copy)]
pub struct Stroke {
    pub color: &'static str,
    pub width: f64,
    pub dashes: Option<(f64, f64)>,
}

impl Stroke {
    /// Without gaps.
    pub const fn solid(color: &'static str, width: f64) -> Self {
        Self {
            color,
            width,
            dashes: None,
        }
    }

    /// With dashes and gaps of these lengths.
    pub const fn dashed(color: &'static str, width: f64, dashes: (f64, f64)) -> Self {
        Self {
            color,
            width,
            dashes: Some(dashes),
        }
    }
}

/// About how wide a text of this size is.
pub fn width(size: u32, text: &str) -> f64 {
    LETTER * f64::from(size) * text.chars().count() as f64
}

impl Pen {
    /// A line through points.
    pub fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let pieces = match stroke.dashes {
            Some(dashes) => dashed(points, dashes),
            None => vec![points.to_vec()],
        };
        for points in pieces {
            self.scene.add(Primitive::PolyLine {
                points,
                stroke: stroke.color.into(),
                stroke_width: stroke.width,
                stroke_dasharray: None,
            });
        }
    }

    /// A line with a head at its end.
    pub fn arrow(&mut self, from: (f64, f64), to: (f64, f64), stroke: Stroke) {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = x.hypot(y);
        if length == 0.0 {
            return;
        }
        let (x, y) = (x / length, y / length);
        let (long, wide) = (
            HEAD.0 * stroke.width.max(1.0),
            HEAD.1 * stroke.width.max(1.0),
        );
        let neck = (to.0 - long * x, to.1 - long * y);
        if length > long {
            self.line(&[from, neck], stroke);
        }
        let sides = [
            (neck.0 - wide * y, neck.1 + wide * x),
            (neck.0 + wide * y, neck.1 - wide * x),
        ];
        self.area(&[to, sides[0], sides[1]], stroke.color);
    }

    /// A filled polygon.
    fn area(&mut self, corners: &[(f64, f64)], color: &str) {
        let mut course: String = corners
            .iter()
            .enumerate()
            .map(|(index, (x, y))| format!("{}{x:.2} {y:.2}", if index == 0 { 'M' } else { 'L' }))
            .collect();
        course.push('Z');
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: course,
            fill: Some(color.into()),
            stroke: kuva::render::color::Color::None,
            stroke_width: 0.0,
            opacity: None,
            stroke_dasharray: None,
        })));
    }

    /// A filled rectangle: left, top, width, height.
    pub fn tint(&mut self, area: super::Area, color: &str, opacity: f64) {
        let (x, y, width, height) = area;
        self.scene.add(Primitive::Rect {
            x,
            y,
            width,
            height,
            fill: color.into(),
            stroke: None,
            stroke_width: None,
            opacity: Some(opacity),
        });
    }

    /// Words in a colour; on a white plate if they stand among points.
    pub fn words(
        &mut self,
        (x, y): (f64, f64),
        size: u32,
        align: Align,
        (color, plate): (&str, bool),
        text: &str,
    ) {
        if plate {
            let (width, height) = (width(size, text) + 4.0, 1.2 * f64::from(size));
            let left = match align {
                Align::Left => x - 2.0,
                Align::Right => x - width + 2.0,
                Align::Middle | Align::Upwards => x - 0.5 * width,
            };
            self.tint(
                (left, y - 0.95 * f64::from(size), width, height),
                "#ffffff",
                0.82,
            );
        }
        let (anchor, rotate) = align.anchor();
        self.scene.add(Primitive::Text {
            x,
            y,
            content: text.to_owned(),
            size,
            anchor,
            rotate,
            bold: false,
            color: Some(color.into()),
        });
    }

    /// A number in a white circle.
    pub fn badge(&mut self, (x, y): (f64, f64), size: u32, text: &str) {
        self.spot((x, y), 0.88 * f64::from(size));
        self.text((x, y + 0.36 * f64::from(size)), size, Align::Middle, text);
    }
}

/// The dashes of a line, which go on over its corners.
fn dashed(points: &[(f64, f64)], (dash, gap): (f64, f64)) -> Vec<Vec<(f64, f64)>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    let (mut left, mut draws) = (dash, true);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let mut length = (to.0 - from.0).hypot(to.1 - from.1);
        while length > left {
            let share = left / length;
            from = (
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            );
            length -= left;
            if draws {
                piece.push(from);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![from];
            }
            draws = !draws;
            left = if draws { dash } else { gap };
        }
        left -= length;
        if draws {
            piece.push(to);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}
