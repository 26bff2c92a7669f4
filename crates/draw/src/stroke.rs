//! Lines: their colour, width and dashes.

use crate::style;

/// A point of a page or of axes.
pub(crate) type Point = (f64, f64);

/// A line's colour, its width, and the lengths of dashes and gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// As in SVG.
    pub color: &'static str,
    /// In pixels.
    pub width: f64,
    /// Lengths of dashes and gaps in pixels; none of a solid line.
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

/// A line that a light rim tells from any ground.
pub(crate) const RIMMED: Stroke = Stroke::solid(style::INK, 1.6);

/// The dashes of a line, which go on over its corners.
pub(crate) fn dashed(points: &[Point], (dash, gap): (f64, f64)) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
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
