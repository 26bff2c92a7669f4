//! A drawing of plain shapes, for charts that are no plot of curves.

mod ink;

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::style;
pub use ink::{Stroke, width};

/// Width of the line and of the light rim that tells it from dark grounds.
const LINE: (f64, f64) = (1.6, 3.6);

/// Sides of the polygon that stands for an ellipse.
const SIDES: u32 = 180;

/// Shapes on a white page; lengths are pixels, y points down.
pub struct Pen {
    scene: Scene,
}

/// How a text stands to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    Left,
    Middle,
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
    pub fn new(width: f64, height: f64) -> Self {
        let mut scene = Scene::new(width, height);
        scene.font_family = Some(style::FONTS.to_owned());
        Self { scene }
    }

    pub fn text(&mut self, place: (f64, f64), size: u32, align: Align, text: &str) {
        self.write(place, size, align, false, text);
    }

    pub fn heading(&mut self, place: (f64, f64), size: u32, align: Align, text: &str) {
        self.write(place, size, align, true, text);
    }

    fn write(&mut self, (x, y): (f64, f64), size: u32, align: Align, bold: bool, text: &str) {
        let (anchor, rotate) = align.anchor();
        self.scene.add(Primitive::Text {
            x,
            y,
            content: text.to_owned(),
            size,
            anchor,
            rotate,
            bold,
            color: Some(style::INK.into()),
        });
    }

    /// Rectangles of one colour that leave no seams between them.
    pub fn fill(&mut self, areas: &[Area], color: &str) {
        let corners = areas
            .iter()
            .map(|(x, y, width, height)| format!("M{x} {y}h{width}v{height}h-{width}z"));
        self.scene.add(Primitive::GroupStart {
            transform: None,
            title: None,
            extra_attrs: Some("shape-rendering=\"crispEdges\"".to_owned()),
        });
        self.scene.add(Primitive::Path(Box::new(PathData {
            d: corners.collect(),
            fill: Some(color.into()),
            stroke: kuva::render::color::Color::None,
            stroke_width: 0.0,
            opacity: None,
            stroke_dasharray: None,
        })));
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
    pub fn tick(&mut self, (x1, y1): (f64, f64), (x2, y2): (f64, f64)) {
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

    /// A curve that is seen on any ground; `dashes` as in SVG.
    pub fn curve(&mut self, points: &[(f64, f64)], dashes: Option<&str>) {
        for (stroke, stroke_width, dashes) in
            [("#ffffff", LINE.1, None), (style::INK, LINE.0, dashes)]
        {
            self.scene.add(Primitive::PolyLine {
                points: points.to_vec(),
                stroke: stroke.into(),
                stroke_width,
                stroke_dasharray: dashes.map(str::to_owned),
            });
        }
    }

    /// Rectangles of many colours.
    pub fn mosaic(&mut self, tiles: &[(Area, &str)]) {
        let side = |pick: fn(&Area) -> f64| tiles.iter().map(|(area, _)| pick(area)).collect();
        self.scene.add(Primitive::RectBatch {
            x: side(|area| area.0),
            y: side(|area| area.1),
            w: side(|area| area.2),
            h: side(|area| area.3),
            fills: tiles.iter().map(|(_, color)| (*color).into()).collect(),
        });
    }

    /// A white spot with a dark rim, seen on any ground.
    pub fn spot(&mut self, (cx, cy): (f64, f64), radius: f64) {
        self.scene.add(Primitive::Circle {
            cx,
            cy,
            r: radius,
            fill: "#ffffff".into(),
            fill_opacity: None,
            stroke: Some(style::INK.into()),
            stroke_width: Some(1.6),
        });
    }

    /// Text on a white ground, its middle at this place.
    pub fn label(&mut self, (x, y): (f64, f64), size: u32, text: &str) {
        let letters = f64::from(size);
        let width = 0.6 * letters * text.chars().count() as f64 + 4.0;
        let height = 1.15 * letters;
        self.fill(
            &[(x - 0.5 * width, y - 0.5 * height, width, height)],
            "#ffffff",
        );
        self.text((x, y + 0.35 * letters), size, Align::Middle, text);
    }

    /// An ellipse that is seen on any ground; the half-axes are those along x and y.
    pub fn ring(&mut self, (cx, cy): (f64, f64), (across, up): (f64, f64)) {
        let point = |k: u32| {
            let (sin, cos) = (f64::from(k) / f64::from(SIDES) * std::f64::consts::TAU).sin_cos();
            (cx + across * cos, cy + up * sin)
        };
        let points: Vec<(f64, f64)> = (0..=SIDES).map(point).collect();
        self.curve(&points, None);
    }

    /// Small dots of one colour.
    pub fn dots(&mut self, places: &[(f64, f64)], radius: f64, color: &str) {
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

    /// As pixels, so many for each unit of length.
    pub fn png_at(&self, scale: f32) -> Result<Vec<u8>, String> {
        PngBackend::new()
            .with_scale(scale)
            .render_scene(&self.scene)
    }

    pub fn svg(&self) -> String {
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&self.scene)
    }
}
