//! What is drawn between the axes of a panel.

use std::f64::consts::TAU;

use crate::mark::{Align, Mark, Sign};
use crate::stroke::{Point, RIMMED, Stroke};
use crate::style;

/// Half the size of a mark.
const MARK: f64 = 6.0;
/// Sides of the polygon that stands for an ellipse.
const SIDES: u32 = 180;

/// Something drawn between the axes of a panel; a name explains it in the legend.
#[derive(Debug, Clone)]
pub struct Layer {
    pub(crate) shape: Shape,
    pub(crate) name: String,
    /// What stands for it in the legend.
    pub(crate) sign: Option<Sign>,
}

/// What a layer is made of; places are values of the axes.
#[derive(Debug, Clone)]
pub(crate) enum Shape {
    /// With a light rim or without.
    Line(Vec<Point>, Stroke, bool),
    Dots(Vec<Point>, f64, &'static str),
    Marks(Vec<Point>, Mark, f64, &'static str),
    Band(Vec<(f64, [f64; 2])>, &'static str, f64),
    Boxes(Vec<[(f64, f64); 2]>, &'static str, f64),
    Cells(usize, Vec<&'static str>),
    Shades(usize, Vec<f64>, String),
    Horizontal(f64, Stroke, String),
    Vertical(f64, Stroke, String),
    Arrow(Point, Point, Stroke),
    Direction(Vec<Point>, f64, Stroke),
    Text(Text),
    Label(Point, String),
    Message(String),
    Nothing,
}

/// A text at a place.
#[derive(Debug, Clone)]
pub(crate) struct Text {
    pub(crate) at: Point,
    pub(crate) offset: (f64, f64),
    pub(crate) align: Align,
    pub(crate) text: String,
    pub(crate) color: &'static str,
    pub(crate) is_plated: bool,
}

impl Layer {
    const fn new(shape: Shape, sign: Option<Sign>) -> Self {
        let name = String::new();
        Self { shape, name, sign }
    }

    /// With a name in the legend; layers of one name have one entry.
    pub fn named(self, name: impl Into<String>) -> Self {
        let name = name.into();
        Self { name, ..self }
    }

    /// A line through points, cut at the frame; it has gaps where a value is not finite.
    pub fn line(points: impl IntoIterator<Item = Point>, stroke: Stroke) -> Self {
        let shape = Shape::Line(points.into_iter().collect(), stroke, false);
        Self::new(shape, Some(Sign::Line(stroke)))
    }

    /// A line that is seen on any ground; with lengths of dashes and gaps it is dashed.
    pub fn contour(points: impl IntoIterator<Item = Point>, dashes: Option<(f64, f64)>) -> Self {
        let stroke = Stroke { dashes, ..RIMMED };
        let shape = Shape::Line(points.into_iter().collect(), stroke, true);
        Self::new(shape, Some(Sign::Line(stroke)))
    }

    /// An ellipse that is seen on any ground: its middle and its half-axes.
    pub fn ring(middle: Point, half_axes: (f64, f64)) -> Self {
        let points = (0..=SIDES).map(|k| {
            let (sin, cos) = (f64::from(k) / f64::from(SIDES) * TAU).sin_cos();
            (middle.0 + half_axes.0 * cos, middle.1 + half_axes.1 * sin)
        });
        let sign = Some(Sign::Ring);
        Self {
            sign,
            ..Self::contour(points, None)
        }
    }

    /// Dots of this radius in pixels, any number: those that would hide each other are one.
    pub fn dots(points: impl IntoIterator<Item = Point>, radius: f64, color: &'static str) -> Self {
        let shape = Shape::Dots(points.into_iter().collect(), radius, color);
        Self::new(shape, Some(Sign::Patch(color)))
    }

    /// A mark at each point.
    pub fn marks(points: impl IntoIterator<Item = Point>, mark: Mark, color: &'static str) -> Self {
        let shape = Shape::Marks(points.into_iter().collect(), mark, MARK, color);
        Self::new(shape, Some(Sign::Mark(mark, color)))
    }

    /// With marks of this half size in pixels.
    pub fn sized(mut self, size: f64) -> Self {
        if let Shape::Marks(_, _, half, _) = &mut self.shape {
            *half = size;
        }
        self
    }

    /// The ground between two curves: places across, lower and upper values.
    pub fn band(
        places: impl IntoIterator<Item = (f64, [f64; 2])>,
        color: &'static str,
        opacity: f64,
    ) -> Self {
        let shape = Shape::Band(places.into_iter().collect(), color, opacity);
        Self::new(shape, Some(Sign::Band(color, opacity)))
    }

    /// Filled boxes: ranges across and upwards, cut at the frame, so that infinite ones reach to it.
    pub fn boxes(
        boxes: impl IntoIterator<Item = [(f64, f64); 2]>,
        color: &'static str,
        opacity: f64,
    ) -> Self {
        let shape = Shape::Boxes(boxes.into_iter().collect(), color, opacity);
        Self::new(shape, Some(Sign::Band(color, opacity)))
    }

    /// Rows of coloured cells that fill the panel, the lowest row first.
    pub fn cells(columns: usize, colors: impl IntoIterator<Item = &'static str>) -> Self {
        Self::new(Shape::Cells(columns, colors.into_iter().collect()), None)
    }

    /// Rows of cells whose colours stand for values, the lowest row first, beside a bar of this name; a value that is
    /// not finite has no colour.
    pub fn shades(
        columns: usize,
        values: impl IntoIterator<Item = f64>,
        name: impl Into<String>,
    ) -> Self {
        let values = values.into_iter().collect();
        Self::new(Shape::Shades(columns, values, name.into()), None)
    }

    /// A line through the whole panel at this height, its name above its right end.
    pub fn horizontal(height: f64, stroke: Stroke, name: impl Into<String>) -> Self {
        let shape = Shape::Horizontal(height, stroke, name.into());
        Self::new(shape, Some(Sign::Line(stroke)))
    }

    /// A line through the whole panel at this place across, its name above the panel.
    pub fn vertical(place: f64, stroke: Stroke, name: impl Into<String>) -> Self {
        let shape = Shape::Vertical(place, stroke, name.into());
        Self::new(shape, Some(Sign::Line(stroke)))
    }

    /// A line with a head at its end.
    pub fn arrow(from: Point, to: Point, stroke: Stroke) -> Self {
        Self::new(Shape::Arrow(from, to, stroke), Some(Sign::Line(stroke)))
    }

    /// An arrow that shows which way a curve goes, at this share of its length; none on a curve that is too short.
    pub fn direction(points: impl IntoIterator<Item = Point>, share: f64, stroke: Stroke) -> Self {
        let points = points.into_iter().collect();
        Self::new(Shape::Direction(points, share, stroke), None)
    }

    /// A text at a place.
    pub fn text(at: Point, align: Align, text: impl Into<String>) -> Self {
        let text = Text {
            at,
            offset: (0.0, 0.0),
            align,
            text: text.into(),
            color: style::INK,
            is_plated: false,
        };
        Self::new(Shape::Text(text), None)
    }

    fn with_text(mut self, change: impl FnOnce(&mut Text)) -> Self {
        if let Shape::Text(text) = &mut self.shape {
            change(text);
        }
        self
    }

    /// With a text so many pixels to the right and below its place.
    pub fn moved(self, right: f64, down: f64) -> Self {
        self.with_text(|text| text.offset = (right, down))
    }

    /// With a text of this colour.
    pub fn colored(self, color: &'static str) -> Self {
        self.with_text(|text| text.color = color)
    }

    /// With a text on a light plate, to be read among points.
    pub fn plated(self) -> Self {
        self.with_text(|text| text.is_plated = true)
    }

    /// The name of a point, beside it where there is room and no other name.
    pub fn label(at: Point, text: impl Into<String>) -> Self {
        Self::new(Shape::Label(at, text.into()), None)
    }

    /// Words in the middle of a panel that has nothing else to show.
    pub fn message(words: impl Into<String>) -> Self {
        Self::new(Shape::Message(words.into()), None)
    }

    /// An entry of the legend alone.
    pub fn key(sign: Sign, name: impl Into<String>) -> Self {
        Self::new(Shape::Nothing, Some(sign)).named(name)
    }

    /// Whether it fills its panel with colour.
    pub(crate) const fn fills(&self) -> bool {
        matches!(self.shape, Shape::Cells(..) | Shape::Shades(..))
    }

    /// Whether it lies behind the lines at round values, as stripes do.
    pub(crate) fn is_behind(&self) -> bool {
        let is_stripe = |[x, y]: &[(f64, f64); 2]| x.0.is_infinite() || y.0.is_infinite();
        match &self.shape {
            Shape::Boxes(boxes, ..) => boxes.iter().all(is_stripe),
            shape => matches!(shape, Shape::Nothing),
        }
    }

    /// The points by which it widens the ranges of axes that are not given.
    pub(crate) fn extent(&self) -> Vec<Point> {
        match &self.shape {
            Shape::Line(points, ..)
            | Shape::Dots(points, ..)
            | Shape::Marks(points, ..)
            | Shape::Direction(points, ..) => points.clone(),
            Shape::Band(places, ..) => {
                let ends = places.iter();
                let ends = ends.flat_map(|(x, ends)| ends.map(|y| (*x, y)));
                ends.collect()
            }
            Shape::Boxes(boxes, ..) => {
                let corners = boxes.iter().map(|[x, y]| [(x.0, y.0), (x.1, y.1)]);
                corners.flatten().collect()
            }
            Shape::Arrow(from, to, _) => vec![*from, *to],
            Shape::Label(at, _) => vec![*at],
            Shape::Horizontal(height, ..) => vec![(f64::NAN, *height)],
            Shape::Vertical(place, ..) => vec![(*place, f64::NAN)],
            _ => Vec::new(),
        }
    }
}
