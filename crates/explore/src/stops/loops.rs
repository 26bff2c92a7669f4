//! The picture of a law: contact force over deflection for a stroke in and out, as in the
//! paper's figure 2.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::LegendPosition;
use kuva::plot::{LinePlot, LineStyle, QuiverPlot};
use kuva::render::annotations::{ReferenceLine, TextAnnotation};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};
use softstop::PhaseKind;

use crate::stops::stroke::{Piece, Rebound, Stroke};
use softstop_draw::style;

/// The lines of the first law and of the second.
const LINES: [(&str, LineStyle); 2] = [
    (style::DESIGN, LineStyle::Solid),
    (style::OPTIMUM, LineStyle::Dashed),
];
/// Where on a piece its arrow stands, so that those of two ways on one curve stand apart.
const ARROW_AT: f64 = 0.42;
/// Shortest piece, as a share of the frame, that gets an arrow.
const SHORTEST: f64 = 0.03;
/// Length of an arrow as a share of the frame.
const ARROW: f64 = 0.03;
/// Half the range of deflections around a stop that does not yield.
const ASIDE: f64 = 1.0;

/// Strokes of the laws of one picture.
#[derive(Debug, Clone)]
pub struct Loops<'a> {
    title: &'a str,
    subtitle: &'a str,
    strokes: &'a [(&'a str, Stroke)],
    x: (f64, f64),
    y: (f64, f64),
    /// Whether a law gives way, so that force and deflection have a scale.
    yields: bool,
}

impl<'a> Loops<'a> {
    /// The picture of strokes, each with the name of its law.
    #[must_use]
    pub fn new(title: &'a str, subtitle: &'a str, strokes: &'a [(&'a str, Stroke)]) -> Self {
        let points = || strokes.iter().flat_map(|(_, stroke)| stroke.points());
        let yields = points().any(|(_, force)| force != 0.0);
        let (x, y) = if yields {
            let x = range(points().map(|point| point.0), 0.02, 0.08);
            (x, range(points().map(|point| point.1), 0.12, 0.24))
        } else {
            ((-ASIDE, ASIDE), (-0.15, 1.0))
        };
        Self {
            title,
            subtitle,
            strokes,
            x,
            y,
            yields,
        }
    }

    /// The picture as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let mut plots = Vec::new();
        for ((label, stroke), (color, line)) in self.strokes.iter().zip(LINES) {
            plots.push(self.curve(stroke, label, color, line));
            plots.push(self.arrows(stroke, color));
        }
        let mut layout = self.layout();
        if self.strokes.len() > 1 {
            layout = layout.with_legend_entries(collect_legend_entries(&plots));
        }
        for (_, stroke) in self.strokes {
            layout = self.names(layout, stroke);
        }
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&render_multiple(plots, layout))
    }

    fn layout(&self) -> Layout {
        let axis = |line: ReferenceLine| {
            line.with_color(style::ASIDE)
                .with_stroke_width(1.0)
                .with_dasharray("none")
        };
        let plain = style::plain(self.x, self.y);
        // A blow has no scale of force: nothing but its zero is marked.
        let plain = if self.yields {
            plain
        } else {
            plain.with_y_tick_step(2.0)
        };
        plain
            .with_width(640.0)
            .with_height(460.0)
            .with_title(self.title)
            .with_subtitle(self.subtitle)
            .with_x_label("deflection x − r (m)")
            .with_y_label("contact force F (N)")
            .with_legend_position(LegendPosition::InsideTopLeft)
            .with_reference_line(axis(ReferenceLine::horizontal(0.0)))
            .with_reference_line(axis(ReferenceLine::vertical(0.0)))
    }

    fn curve(&self, stroke: &Stroke, label: &str, color: &str, line: LineStyle) -> Plot {
        let mut points = Vec::new();
        for (index, piece) in stroke.pieces.iter().enumerate() {
            let wall = stroke.rebound.filter(|wall| wall.pieces_before == index);
            points.extend(wall.map(|wall| (wall.deflection, self.y.1)));
            points.extend(&piece.points);
        }
        Plot::Line(
            LinePlot::new()
                .with_data(points)
                .with_color(color)
                .with_stroke_width(2.5)
                .with_line_style(line)
                .with_legend(label),
        )
    }

    fn arrows(&self, stroke: &Stroke, color: &str) -> Plot {
        let pieces = stroke.pieces.iter().filter_map(|piece| self.arrow(piece));
        let walls = stroke.rebound.iter();
        let walls = walls.flat_map(|wall| self.climb(stroke, wall));
        Plot::Quiver(
            QuiverPlot::new()
                .with_arrows(pieces.chain(walls))
                .with_scale(1.0)
                .with_head(13.0, 5.0)
                .with_shaft_width(0.0)
                .with_tight_bounds()
                .with_color(color),
        )
    }

    /// The arrow of a piece.
    fn arrow(&self, piece: &Piece) -> Option<(f64, f64, f64, f64)> {
        let lengths = piece
            .points
            .windows(2)
            .map(|pair| self.distance(pair[0], pair[1]));
        let whole: f64 = lengths.clone().sum();
        if whole < SHORTEST || piece.kind == PhaseKind::Free {
            return None;
        }
        let mut passed = 0.0;
        let at = lengths.clone().position(|length| {
            passed += length;
            passed >= ARROW_AT * whole
        })?;
        Some(self.arrowhead(piece.points[at], piece.points[at + 1]))
    }

    /// The arrows up and down a rigid stop, between its foot and the top.
    fn climb(&self, stroke: &Stroke, wall: &Rebound) -> [(f64, f64, f64, f64); 2] {
        let before = stroke.pieces[..wall.pieces_before].last();
        let foot = before.and_then(|piece| piece.points.last());
        let foot = foot.map_or(0.0, |point| point.1);
        let at = |share: f64| (wall.deflection, foot + share * (self.y.1 - foot));
        let (low, high) = (at(0.35), at(0.7));
        [self.arrowhead(low, high), self.arrowhead(high, low)]
    }

    /// An arrow that stands at `from` and points to `to`: tail and vector.
    fn arrowhead(&self, from: (f64, f64), to: (f64, f64)) -> (f64, f64, f64, f64) {
        let scale = ARROW / self.distance(from, to);
        let (across, up) = (scale * (to.0 - from.0), scale * (to.1 - from.1));
        (from.0 - 0.5 * across, from.1 - 0.5 * up, across, up)
    }

    /// The paper's numerals of the phases, and what a rigid stop does.
    fn names(&self, mut layout: Layout, stroke: &Stroke) -> Layout {
        let numbered = stroke
            .pieces
            .iter()
            .any(|piece| piece.kind == PhaseKind::Pierce);
        for piece in stroke.pieces.iter().filter(|_| numbered) {
            layout = match self.numeral(piece) {
                Some(numeral) => layout.with_annotation(numeral),
                None => layout,
            };
        }
        match stroke.rebound {
            Some(wall) => layout.with_annotation(self.newton(&wall, numbered)),
            None => layout,
        }
    }

    /// The numeral of a piece: above it on the way in, below it on the way out, once where both
    /// ways are one.
    fn numeral(&self, piece: &Piece) -> Option<TextAnnotation> {
        let numeral = match piece.kind {
            PhaseKind::Pierce => "I",
            PhaseKind::Cut => "II",
            PhaseKind::Stop if piece.inward => "III",
            _ => return None,
        };
        let (x, y) = *piece.points.get(piece.points.len() / 2)?;
        let side = if piece.inward { 0.02 } else { -0.075 };
        let place = y + side * (self.y.1 - self.y.0);
        Some(TextAnnotation::new(numeral, x, place).with_font_size(14))
    }

    /// The velocities before and after a rigid stop.
    fn newton(&self, wall: &Rebound, numbered: bool) -> TextAnnotation {
        let name = if numbered { "IV: " } else { "" };
        let text = format!(
            "{name}F → ∞, v₋ = {:.2} m/s, v₊ = {:.2} m/s",
            wall.before, wall.after
        );
        let aside = if numbered { -0.3 } else { 0.26 };
        let x = wall.deflection + aside * (self.x.1 - self.x.0);
        let y = self.y.0 + 0.92 * (self.y.1 - self.y.0);
        TextAnnotation::new(text.replace('-', "−"), x, y).with_font_size(13)
    }

    /// Distance of two points as a share of the frame.
    fn distance(&self, from: (f64, f64), to: (f64, f64)) -> f64 {
        let across = (to.0 - from.0) / (self.x.1 - self.x.0);
        let up = (to.1 - from.1) / (self.y.1 - self.y.0);
        across.hypot(up)
    }
}

/// The range of values with room on both sides, as shares of it.
fn range(values: impl Iterator<Item = f64> + Clone, below: f64, above: f64) -> (f64, f64) {
    let low = values.clone().fold(0.0, f64::min);
    let high = values.fold(0.0, f64::max);
    let room = high - low;
    (low - below * room, high + above * room)
}
