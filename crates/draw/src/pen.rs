//! A drawing of plain shapes, for charts that are no plot of curves.

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use crate::index;
use crate::stroke::{Point, dashed};
use crate::style;

pub use crate::index::width;
pub use crate::stroke::Stroke;

/// Whether XML, and so SVG, has no place for a character (XML 1.0, section 2.2).
fn is_no_xml(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
}

/// Shapes on a page; lengths are pixels, y points down.
pub struct Pen {
    scene: Scene,
}

/// How a text stands to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// It begins there.
    Left,
    /// Its middle is there.
    Middle,
    /// It ends there.
    Right,
    /// Centred and turned to be read from below.
    Upwards,
}

impl Align {
    /// The end of the text that stands at its place, and its turn in degrees.
    fn anchor(self) -> (TextAnchor, Option<f64>) {
        match self {
            Self::Left => (TextAnchor::Start, None),
            Self::Middle => (TextAnchor::Middle, None),
            Self::Right => (TextAnchor::End, None),
            Self::Upwards => (TextAnchor::Middle, Some(-90.0)),
        }
    }
}

/// A rectangle: left, top, width, height.
pub type Area = (f64, f64, f64, f64);

impl Pen {
    /// A page of this width and height.
    pub fn new(width: f64, height: f64) -> Self {
        let mut scene = Scene::new(width, height);
        scene.font_family = Some(style::FONTS.to_owned());
        Self { scene }
    }

    /// The same, painted white.
    pub fn page(width: f64, height: f64) -> Self {
        let mut pen = Self::new(width, height);
        pen.fill(&[(0.0, 0.0, width, height)], "#ffffff");
        pen
    }

    /// Width and height of the page.
    pub(crate) const fn size(&self) -> (f64, f64) {
        (self.scene.width, self.scene.height)
    }

    /// Letters of this size.
    pub fn text(&mut self, place: Point, size: u32, align: Align, text: &str) {
        self.write(place, size, align, (false, style::INK), text);
    }

    /// Bold letters of this size.
    pub fn heading(&mut self, place: Point, size: u32, align: Align, text: &str) {
        self.write(place, size, align, (true, style::INK), text);
    }

    fn write(
        &mut self,
        (x, y): Point,
        size: u32,
        align: Align,
        (bold, color): (bool, &str),
        text: &str,
    ) {
        let (anchor, rotate) = align.anchor();
        self.scene.add(Primitive::Text {
            x,
            y,
            content: text.to_owned(),
            size,
            anchor,
            rotate,
            bold,
            color: Some(color.into()),
        });
    }

    /// A filled outline, its course as in SVG.
    fn outline(&mut self, course: String, color: &str, opacity: Option<f64>) {
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: course,
            fill: Some(color.into()),
            stroke: kuva::render::color::Color::None,
            stroke_width: 0.0,
            opacity,
            stroke_dasharray: None,
        })));
    }

    /// Rectangles of one colour that leave no seams between them.
    pub fn fill(&mut self, areas: &[Area], color: &str) {
        let corners = areas
            .iter()
            .map(|(x, y, width, height)| format!("M{x} {y}h{width}v{height}h-{width}z"));
        self.crisp(|pen| pen.outline(corners.collect(), color, None));
    }

    /// What has its edges on whole pixels.
    fn crisp(&mut self, draw: impl FnOnce(&mut Self)) {
        self.scene.add(Primitive::GroupStart {
            transform: None,
            title: None,
            extra_attrs: Some("shape-rendering=\"crispEdges\"".to_owned()),
        });
        draw(self);
        self.scene.add(Primitive::GroupEnd);
    }

    /// The rim of a rectangle.
    pub fn frame(&mut self, (x, y, width, height): Area) {
        self.scene.add(Primitive::Rect {
            x,
            y,
            width,
            height,
            fill: kuva::render::color::Color::None,
            stroke: Some(style::INK.into()),
            stroke_width: Some(1.0),
            opacity: None,
        });
    }

    /// A short mark on an axis.
    pub fn tick(&mut self, (x1, y1): Point, (x2, y2): Point) {
        self.scene.add(Primitive::Line {
            x1,
            y1,
            x2,
            y2,
            stroke: style::INK.into(),
            stroke_width: 1.0,
            stroke_dasharray: None,
        });
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], stroke: Stroke) {
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
    pub(crate) fn area(&mut self, corners: &[Point], color: &str, opacity: Option<f64>) {
        let mut course: String = corners
            .iter()
            .enumerate()
            .map(|(index, (x, y))| format!("{}{x:.2} {y:.2}", if index == 0 { 'M' } else { 'L' }))
            .collect();
        course.push('Z');
        self.outline(course, color, opacity);
    }

    /// A filled rectangle: left, top, width, height.
    pub fn tint(&mut self, (x, y, width, height): Area, color: &str, opacity: f64) {
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
        (x, y): Point,
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
            let ground = (left, y - 0.95 * f64::from(size), width, height);
            self.tint(ground, "#ffffff", 0.82);
        }
        self.write((x, y), size, align, (false, color), text);
    }

    /// Rectangles of many colours that leave no seams between them: their edges lie on half units, which are whole pixels
    /// of a PNG of twice the size.
    pub fn mosaic(&mut self, tiles: &[(Area, &str)]) {
        let edge = |place: f64| (2.0 * place).round() / 2.0;
        let side = |pick: fn(&Area) -> f64| tiles.iter().map(move |(area, _)| edge(pick(area)));
        let long = |begin: fn(&Area) -> f64, end: fn(&Area) -> f64| {
            let sides = side(begin).zip(side(end));
            sides.map(|(begin, end)| end - begin).collect()
        };
        let batch = Primitive::RectBatch {
            x: side(|area| area.0).collect(),
            y: side(|area| area.1).collect(),
            w: long(|area| area.0, |area| area.0 + area.2),
            h: long(|area| area.1, |area| area.1 + area.3),
            fills: tiles.iter().map(|(_, color)| (*color).into()).collect(),
        };
        self.crisp(|pen| pen.scene.add(batch));
    }

    /// A white spot with a dark rim, seen on any ground.
    pub fn spot(&mut self, place: Point, radius: f64) {
        self.hollow(place, radius, style::INK);
    }

    /// A white spot with a rim of this colour.
    pub(crate) fn hollow(&mut self, (cx, cy): Point, radius: f64, color: &str) {
        self.scene.add(Primitive::Circle {
            cx,
            cy,
            r: radius,
            fill: "#ffffff".into(),
            fill_opacity: None,
            stroke: Some(color.into()),
            stroke_width: Some(1.6),
        });
    }

    /// Small dots of one colour.
    pub fn dots(&mut self, places: &[Point], radius: f64, color: &str) {
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

    /// The page as PNG, with so many pixels for each unit of length.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn png_at(&self, scale: f32) -> Result<Vec<u8>, String> {
        let mut scene = Scene::new(self.scene.width, self.scene.height);
        scene.font_family.clone_from(&self.scene.font_family);
        scene.elements = self.scene.elements.iter().flat_map(index::placed).collect();
        PngBackend::new().with_scale(scale).render_scene(&scene)
    }

    /// The page as an SVG document.
    pub fn svg(&self) -> String {
        self.svg_with(str::to_owned)
    }

    /// The same, its texts written anew.
    pub fn svg_with(&self, anew: impl Fn(&str) -> String) -> String {
        let svg = SvgBackend::new().with_pretty(true);
        let document = index::document(&svg.render_scene(&self.scene), anew);
        document.replace(is_no_xml, "\u{fffd}")
    }
}
