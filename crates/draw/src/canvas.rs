//! Plain shapes on a page, and those made of them; lengths are pixels, y points down.

use std::f64::consts::TAU;

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use crate::index;
use crate::mark::{Align, Mark, Sign};
use crate::stroke::{Point, Stroke, dashed};
use crate::style;

/// Length and half the width of an arrow's head, in units of the line's width.
const HEAD: (f64, f64) = (6.0, 2.6);
/// Opacity of the plate behind a text.
const PLATE: f64 = 0.82;

/// A rectangle: left, top, width, height.
pub(crate) type Area = (f64, f64, f64, f64);

/// Whether XML, and so SVG, has no place for a character (XML 1.0, section 2.2).
fn is_no_xml(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}

/// A page.
pub(crate) struct Canvas {
    scene: Scene,
}

impl Canvas {
    /// A page of this width and height.
    pub(crate) fn new((width, height): (f64, f64)) -> Self {
        let mut scene = Scene::new(width, height);
        scene.font_family = Some(style::FONTS.to_owned());
        Self { scene }
    }

    /// Width and height of the page.
    pub(crate) const fn size(&self) -> (f64, f64) {
        (self.scene.width, self.scene.height)
    }

    /// Letters of this size.
    pub(crate) fn text(&mut self, place: Point, size: u32, align: Align, text: &str) {
        self.colored_text(place, size, align, style::INK, text);
    }

    /// Letters of this size and colour.
    pub(crate) fn colored_text(
        &mut self,
        place: Point,
        size: u32,
        align: Align,
        color: &str,
        text: &str,
    ) {
        self.write(place, (size, false), align, color, text);
    }

    /// Bold letters of this size, which begin at a place.
    pub(crate) fn heading(&mut self, place: Point, size: u32, text: &str) {
        self.write(place, (size, true), Align::Left, style::INK, text);
    }

    fn write(
        &mut self,
        (x, y): Point,
        (size, bold): (u32, bool),
        align: Align,
        color: &str,
        text: &str,
    ) {
        if text.is_empty() {
            return;
        }
        self.scene.add(Primitive::Text {
            x,
            y,
            content: text.to_owned(),
            size,
            anchor: match align {
                Align::Left => TextAnchor::Start,
                Align::Middle | Align::Upwards => TextAnchor::Middle,
                Align::Right => TextAnchor::End,
            },
            rotate: (align == Align::Upwards).then_some(-90.0),
            bold,
            color: Some(color.into()),
        });
    }

    /// The plate of a text of this size among points.
    pub(crate) fn plate(&mut self, (x, y): Point, size: u32, align: Align, text: &str) {
        let letters = f64::from(size);
        let width = index::width(size, text) + 4.0;
        let left = match align {
            Align::Left => x - 2.0,
            Align::Right => x - width + 2.0,
            Align::Middle | Align::Upwards => x - 0.5 * width,
        };
        let area = (left, y - 0.95 * letters, width, 1.2 * letters);
        self.tint(area, style::PAPER, PLATE);
    }

    /// A filled outline, its course as in SVG.
    fn outline(&mut self, course: String, color: &str, opacity: Option<f64>) {
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: course,
            fill: Some(color.into()),
            stroke: Color::None,
            stroke_width: 0.0,
            opacity,
            stroke_dasharray: None,
        })));
    }

    /// Rectangles of one colour that leave no seams between them.
    pub(crate) fn fill(&mut self, areas: &[Area], color: &str) {
        let corners = areas
            .iter()
            .map(|(x, y, width, height)| format!("M{x} {y}h{width}v{height}h-{width}z"));
        self.scene.add(Primitive::GroupStart {
            transform: None,
            title: None,
            extra_attrs: Some("shape-rendering=\"crispEdges\"".to_owned()),
        });
        self.outline(corners.collect(), color, None);
        self.scene.add(Primitive::GroupEnd);
    }

    /// A rectangle of a share of its opacity.
    pub(crate) fn tint(&mut self, area: Area, color: &str, opacity: f64) {
        self.rectangle(area, color.into(), None, Some(opacity));
    }

    /// The rim of a rectangle.
    pub(crate) fn frame(&mut self, area: Area) {
        self.rectangle(area, Color::None, Some(style::INK.into()), None);
    }

    fn rectangle(
        &mut self,
        (x, y, width, height): Area,
        fill: Color,
        stroke: Option<Color>,
        opacity: Option<f64>,
    ) {
        self.scene.add(Primitive::Rect {
            x,
            y,
            width,
            height,
            fill,
            stroke_width: stroke.is_some().then_some(1.0),
            stroke,
            opacity,
        });
    }

    /// A line through points.
    pub(crate) fn line(&mut self, points: &[Point], stroke: Stroke) {
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

    /// A filled polygon; of a share of its opacity, if it is not to hide what is behind it.
    pub(crate) fn polygon(&mut self, corners: &[Point], color: &str, opacity: Option<f64>) {
        let mut course = String::new();
        for (x, y) in corners {
            let verb = if course.is_empty() { 'M' } else { 'L' };
            course += &format!("{verb}{x:.2} {y:.2}");
        }
        self.outline(course + "Z", color, opacity);
    }

    /// Small dots of one colour.
    pub(crate) fn dots(&mut self, places: &[Point], radius: f64, color: &str) {
        self.scene.add(Primitive::CircleBatch {
            cx: places.iter().map(|place| place.0).collect(),
            cy: places.iter().map(|place| place.1).collect(),
            r: radius,
            fill: color.into(),
            fill_opacity: None,
            stroke: None,
            stroke_width: None,
        });
    }

    /// A shape of this half-size about a place.
    pub(crate) fn mark(&mut self, (x, y): Point, mark: Mark, half: f64, color: &str) {
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
        self.polygon(&corners, color, None);
    }

    fn hollow(&mut self, (cx, cy): Point, radius: f64, color: &str) {
        self.scene.add(Primitive::Circle {
            cx,
            cy,
            r: radius,
            fill: style::PAPER.into(),
            fill_opacity: None,
            stroke: Some(color.into()),
            stroke_width: Some(1.6),
        });
    }

    /// A line with a head at its end.
    pub(crate) fn arrow(&mut self, from: Point, to: Point, stroke: Stroke) {
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
        let sides = [wide, -wide].map(|wide| (neck.0 - wide * y, neck.1 + wide * x));
        self.polygon(&[to, sides[0], sides[1]], stroke.color, None);
    }

    /// What stands before the words of a legend on a line.
    pub(crate) fn sign(&mut self, (left, line): Point, size: u32, sign: Sign) {
        let letters = f64::from(size);
        let (long, middle) = (2.2 * letters, line - 0.36 * letters);
        let centre = (left + 0.5 * long, middle);
        let (wide, high) = (1.4 * letters, 0.9 * letters);
        let patch = (centre.0 - 0.5 * wide, middle - 0.5 * high, wide, high);
        match sign {
            Sign::Patch(color) => {
                self.fill(&[patch], color);
                self.frame(patch);
            }
            Sign::Band(color, opacity) => self.tint(patch, color, opacity),
            Sign::Line(stroke) => self.line(&[(left, middle), (left + long, middle)], stroke),
            Sign::Mark(mark, color) => self.mark(centre, mark, 0.45 * letters, color),
            Sign::Ring => self.hollow(centre, 0.55 * letters, style::INK),
        }
    }

    /// The page as PNG, with so many pixels for each unit of length.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub(crate) fn png(&self, scale: f32) -> Result<Vec<u8>, String> {
        let mut scene = Scene::new(self.scene.width, self.scene.height);
        scene.font_family.clone_from(&self.scene.font_family);
        scene.elements = self.scene.elements.iter().flat_map(index::placed).collect();
        PngBackend::new().with_scale(scale).render_scene(&scene)
    }

    /// The page as an SVG document, its texts written anew.
    pub(crate) fn svg(&self, anew: impl Fn(&str) -> String) -> String {
        let svg = SvgBackend::new().with_pretty(true);
        let document = index::document(&svg.render_scene(&self.scene), anew);
        document.replace(is_no_xml, "\u{fffd}")
    }
}
