//! Shapes made of others: arrows, rings, rimmed lines, labels, badges.

use std::f64::consts::TAU;

use crate::pen::{Align, Pen, width};
use crate::stroke::{Point, Stroke};
use crate::style;

/// Width of the line and of the light rim that tells it from dark grounds.
const LINE: (f64, f64) = (1.6, 3.6);
/// Length and half the width of an arrow's head, in units of the line's width, and the least of both.
const HEAD: (f64, f64) = (6.0, 2.6);
/// Sides of the polygon that stands for an ellipse.
const SIDES: u32 = 180;

/// A filled shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Round.
    Circle,
    /// On its side.
    Square,
    /// On its base.
    Triangle,
    /// On a corner.
    Diamond,
    /// White with a rim of its colour.
    Hollow,
}

/// What an entry of a legend explains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sign {
    /// A colour.
    Patch(&'static str),
    /// A colour of a share of its opacity.
    Band(&'static str, f64),
    /// A line.
    Line(Stroke),
    /// A mark and its colour.
    Mark(Mark, &'static str),
    /// A ring.
    Ring,
}

impl Pen {
    /// A line that is seen on any ground, by its light rim; with lengths of dashes and gaps it is dashed.
    pub fn rimmed(&mut self, points: &[Point], dashes: Option<(f64, f64)>) {
        self.line(points, Stroke::solid("#ffffff", LINE.1));
        let ink = Stroke::solid(style::INK, LINE.0);
        self.line(points, Stroke { dashes, ..ink });
    }

    /// A line with a head at its end.
    pub fn arrow(&mut self, from: Point, to: Point, stroke: Stroke) {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let length = x.hypot(y);
        if length == 0.0 {
            return;
        }
        let (x, y) = (x / length, y / length);
        let unit = stroke.width.max(1.0);
        let (long, wide) = (HEAD.0 * unit, HEAD.1 * unit);
        let neck = (to.0 - long * x, to.1 - long * y);
        if length > long {
            self.line(&[from, neck], stroke);
        }
        let sides = [
            (neck.0 - wide * y, neck.1 + wide * x),
            (neck.0 + wide * y, neck.1 - wide * x),
        ];
        self.area(&[to, sides[0], sides[1]], stroke.color, None);
    }

    /// Text on a white ground, its middle at this place.
    pub fn label(&mut self, (x, y): Point, size: u32, text: &str) {
        let letters = f64::from(size);
        let width = width(size, text) + 4.0;
        let height = 1.15 * letters;
        let ground = (x - 0.5 * width, y - 0.5 * height, width, height);
        self.fill(&[ground], "#ffffff");
        self.text((x, y + 0.35 * letters), size, Align::Middle, text);
    }

    /// An ellipse that is seen on any ground; the half-axes are those along x and y.
    pub fn ring(&mut self, (cx, cy): Point, (across, up): (f64, f64)) {
        let point = |k: u32| {
            let (sin, cos) = (f64::from(k) / f64::from(SIDES) * TAU).sin_cos();
            (cx + across * cos, cy + up * sin)
        };
        let points: Vec<Point> = (0..=SIDES).map(point).collect();
        self.rimmed(&points, None);
    }

    /// A filled shape of this half-size about a place.
    pub fn mark(&mut self, (x, y): Point, mark: Mark, half: f64, color: &str) {
        let (sides, turn) = match mark {
            Mark::Circle => return self.dots(&[(x, y)], half, color),
            Mark::Hollow => return self.hollow((x, y), half, color),
            Mark::Square => (4, 0.125),
            Mark::Triangle => (3, 0.25),
            Mark::Diamond => (4, 0.0),
        };
        let corner = |k: u32| {
            let (sin, cos) = ((f64::from(k) / f64::from(sides) + turn) * TAU).sin_cos();
            (x + half * cos, y - half * sin)
        };
        let corners: Vec<Point> = (0..sides).map(corner).collect();
        self.area(&corners, color, None);
    }

    /// Signs and what they mean, downwards from a place.
    pub fn legend(&mut self, (left, top): Point, size: u32, entries: &[(Sign, String)]) {
        let letters = f64::from(size);
        for (row, (sign, text)) in entries.iter().enumerate() {
            let line = top + 1.6 * letters * row as f64;
            self.sign((left, line), size, *sign);
            self.text((left + 2.8 * letters, line), size, Align::Left, text);
        }
    }

    /// What stands before the words of a legend on a line.
    pub(crate) fn sign(&mut self, (left, line): Point, size: u32, sign: Sign) {
        let letters = f64::from(size);
        let (long, middle) = (2.2 * letters, line - 0.36 * letters);
        let centre = (left + 0.5 * long, middle);
        let side = 0.9 * letters;
        let patch = (
            centre.0 - 0.7 * letters,
            middle - 0.5 * side,
            1.4 * letters,
            side,
        );
        match sign {
            Sign::Patch(color) => {
                self.fill(&[patch], color);
                self.frame(patch);
            }
            Sign::Band(color, opacity) => self.tint(patch, color, opacity),
            Sign::Line(stroke) => self.line(&[(left, middle), (left + long, middle)], stroke),
            Sign::Mark(mark, color) => self.mark(centre, mark, 0.45 * letters, color),
            Sign::Ring => self.ring(centre, (0.55 * letters, 0.55 * letters)),
        }
    }

    /// A number in a white circle.
    pub fn badge(&mut self, (x, y): Point, size: u32, text: &str) {
        self.spot((x, y), 0.88 * f64::from(size));
        self.text((x, y + 0.36 * f64::from(size)), size, Align::Middle, text);
    }
}
