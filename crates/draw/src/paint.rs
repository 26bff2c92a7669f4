//! The layers of a panel on the page.

use crate::canvas::{Area, Canvas};
use crate::frame::Frame;
use crate::index::width;
use crate::layer::{Layer, Shape, Text};
use crate::layout::PlacedPanel;
use crate::mark::{Align, Mark};
use crate::shade::{SHADES, color, shade};
use crate::stroke::{Point, RIMMED, Stroke};
use crate::style;

/// Lines at the round values.
const GRID: Stroke = Stroke::solid(style::GRID, 1.0);
/// Half the length of the arrow that shows a direction, its width, and the shortest curve that has one.
const HEAD: (f64, f64) = (6.5, 2.2);
const SHORTEST: f64 = 15.0;
/// The light rim of a line.
const RIM_OF_LINE: Stroke = Stroke::solid(style::PAPER, RIMMED.width + 2.0);
/// Room between a mark and its rim on a filled ground.
const RIM: f64 = 2.0;

/// Whether a place is one.
fn is_finite(point: Point) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

impl PlacedPanel<'_> {
    /// All layers: stripes, lines at the round values, the others, names of points.
    pub(crate) fn paint(&self, canvas: &mut Canvas) {
        let layers = &self.panel.layers;
        let is_filled = layers.iter().any(Layer::fills);
        let behind = layers.iter().take_while(|it| it.is_behind()).count();
        let (behind, front) = layers.split_at(behind);
        for layer in behind {
            self.shape(canvas, &layer.shape, is_filled);
        }
        if !is_filled {
            self.grid(canvas);
        }
        for layer in front {
            self.shape(canvas, &layer.shape, is_filled);
        }
        self.labels(canvas);
    }

    fn grid(&self, canvas: &mut Canvas) {
        let Frame { x, y, .. } = self.frame;
        for (value, _) in &self.ticks[0] {
            self.curve(canvas, &[(*value, y.0), (*value, y.1)], GRID);
        }
        for (value, _) in &self.ticks[1] {
            self.curve(canvas, &[(x.0, *value), (x.1, *value)], GRID);
        }
    }

    /// As much of a curve as lies inside; its points are as the frame takes them.
    fn curve(&self, canvas: &mut Canvas, points: &[Point], stroke: Stroke) {
        for piece in self.frame.inside(points) {
            canvas.line(&piece, stroke);
        }
    }

    /// As much as lies inside of runs of points without a gap.
    fn pieces(&self, points: &[Point]) -> Vec<Vec<Point>> {
        let points: Vec<Point> = points.iter().map(|point| self.position(*point)).collect();
        let runs = points.split(|point| !is_finite(*point));
        runs.flat_map(|run| self.frame.inside(run)).collect()
    }

    fn place(&self, point: Point) -> Point {
        self.frame.place(self.position(point))
    }

    fn shape(&self, canvas: &mut Canvas, shape: &Shape, is_filled: bool) {
        let Frame { x, y, .. } = self.frame;
        match shape {
            Shape::Line(points, stroke, is_rimmed) => {
                for piece in self.pieces(points) {
                    if *is_rimmed {
                        canvas.line(&piece, RIM_OF_LINE);
                    }
                    canvas.line(&piece, *stroke);
                }
            }
            Shape::Dots(points, radius, color) => {
                let points = points.iter().map(|point| self.position(*point));
                let places = self.frame.dots(points);
                if !places.is_empty() {
                    canvas.dots(&places, *radius, color);
                }
            }
            Shape::Marks(points, mark, half, color) => {
                let points = points.iter().map(|point| self.position(*point));
                for point in points.filter(|point| self.frame.holds(*point)) {
                    let place = self.frame.place(point);
                    if is_filled && *mark != Mark::Hollow {
                        canvas.mark(place, *mark, half + RIM, style::PAPER);
                    }
                    canvas.mark(place, *mark, *half, color);
                }
            }
            Shape::Band(places, color, opacity) => self.band(canvas, places, color, *opacity),
            Shape::Boxes(boxes, color, opacity) => {
                let areas: Vec<Area> = boxes.iter().filter_map(|it| self.area(it)).collect();
                match *opacity < 1.0 {
                    true => areas
                        .iter()
                        .for_each(|area| canvas.tint(*area, color, *opacity)),
                    false => canvas.fill(&areas, color),
                }
            }
            Shape::Cells(columns, colors) => self.cells(canvas, *columns, colors),
            Shape::Shades(columns, values, _) => {
                let range = self.panel.bar().map_or((0.0, 1.0), |it| it.0);
                let shades: Vec<String> = (0..SHADES).map(color).collect();
                let color = |value: &f64| match value.is_finite() {
                    true => shades[shade(*value, range)].as_str(),
                    false => "",
                };
                let colors: Vec<&str> = values.iter().map(color).collect();
                self.cells(canvas, *columns, &colors);
            }
            Shape::Horizontal(height, stroke, text) => {
                let (_, height) = self.position((0.0, *height));
                if height.is_finite() {
                    self.curve(canvas, &[(x.0, height), (x.1, height)], *stroke);
                    let place = (self.frame.right() - 6.0, self.frame.y_of(height) - 6.0);
                    canvas.text(place, self.letters - 1, Align::Right, text);
                }
            }
            Shape::Vertical(place, stroke, _) => {
                let (place, _) = self.position((*place, 0.0));
                if place.is_finite() {
                    self.curve(canvas, &[(place, y.0), (place, y.1)], *stroke);
                }
            }
            Shape::Arrow(from, to, stroke) => {
                let (from, to) = (self.place(*from), self.place(*to));
                if is_finite(from) && is_finite(to) {
                    canvas.arrow(from, to, *stroke);
                }
            }
            Shape::Direction(points, share, stroke) => {
                self.direction(canvas, points, *share, *stroke);
            }
            Shape::Text(text) => self.text(canvas, text),
            Shape::Message(words) => {
                let middle = (f64::midpoint(x.0, x.1), f64::midpoint(y.0, y.1));
                let place = self.frame.place(middle);
                canvas.colored_text(place, self.letters, Align::Middle, style::ASIDE, words);
            }
            Shape::Label(..) | Shape::Nothing => {}
        }
    }

    fn cells(&self, canvas: &mut Canvas, columns: usize, colors: &[&str]) {
        for (color, areas) in self.frame.cells(columns, colors) {
            canvas.fill(&areas, color);
        }
    }

    fn band(&self, canvas: &mut Canvas, places: &[(f64, [f64; 2])], color: &str, opacity: f64) {
        let edge = |end: usize| {
            let edge = places.iter();
            edge.map(move |(at, ends)| self.position((*at, ends[end])))
        };
        let both = edge(0).zip(edge(1));
        let both: Vec<_> = both
            .filter(|it| is_finite(it.0) && is_finite(it.1))
            .collect();
        let place = |point| self.frame.place(self.frame.clamp(point));
        let lower = both.iter().map(|it| place(it.0));
        let upper = both.iter().rev().map(|it| place(it.1));
        let corners: Vec<Point> = lower.chain(upper).collect();
        if both.len() > 1 {
            canvas.polygon(&corners, color, Some(opacity));
        }
    }

    /// A box as far as it lies inside.
    fn area(&self, [x, y]: &[(f64, f64); 2]) -> Option<Area> {
        let corner = |point| self.frame.place(self.frame.clamp(self.position(point)));
        let ((left, top), (right, bottom)) = (corner((x.0, y.1)), corner((x.1, y.0)));
        let area = (left, top, (right - left).max(0.5), bottom - top);
        ((right - left).is_finite() && area.3 > 0.0).then_some(area)
    }

    /// The head of an arrow on a curve.
    fn direction(&self, canvas: &mut Canvas, points: &[Point], share: f64, stroke: Stroke) {
        let places: Vec<Point> = points.iter().map(|point| self.place(*point)).collect();
        let length = |pair: &[Point]| (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1);
        let whole: f64 = places.windows(2).map(length).sum();
        let mut left = share * whole;
        let reached = places.windows(2).find(|pair| {
            left -= length(pair);
            left <= 0.0
        });
        let Some(pair) = reached.filter(|_| whole >= SHORTEST) else {
            return;
        };
        let (from, to, long) = (pair[0], pair[1], length(pair));
        let way = ((to.0 - from.0) / long, (to.1 - from.1) / long);
        let at = |along: f64| (to.0 + along * way.0, to.1 + along * way.1);
        let width = HEAD.1;
        canvas.arrow(
            at(left - HEAD.0),
            at(left + HEAD.0),
            Stroke { width, ..stroke },
        );
    }

    fn text(&self, canvas: &mut Canvas, text: &Text) {
        let at = self.position(text.at);
        if is_finite(at) {
            let (x, y) = self.frame.place(self.frame.clamp(at));
            let place = (x + text.offset.0, y + text.offset.1);
            if text.is_plated {
                canvas.plate(place, self.letters, text.align, &text.text);
            }
            canvas.colored_text(place, self.letters, text.align, text.color, &text.text);
        }
    }

    /// Names of points, right of them or left; a name that would cover another one moves down.
    fn labels(&self, canvas: &mut Canvas) {
        let labels = self.panel.layers.iter();
        let labels = labels.filter_map(|layer| match &layer.shape {
            Shape::Label(at, text) => Some((self.position(*at), text)),
            _ => None,
        });
        let inside = labels.filter(|it| self.frame.holds(it.0));
        let mut labels: Vec<_> = inside.map(|it| (self.frame.place(it.0), it.1)).collect();
        labels.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
        let (letters, size) = (self.letters - 1, f64::from(self.letters));
        let mut taken: Vec<(f64, f64, f64)> = Vec::new();
        for ((x, y), text) in labels {
            let (wide, away) = (width(letters, text), 0.85 * size);
            let fits = x + away + wide < self.frame.right();
            let left = if fits { x + away } else { x - away - wide };
            let mut line = y + 0.36 * size;
            while taken.iter().any(|(other, width, height)| {
                left < other + width && *other < left + wide && (line - height).abs() < 1.2 * size
            }) {
                line += 1.0;
            }
            taken.push((left, wide, line));
            let (place, align) = match fits {
                true => ((left, line), Align::Left),
                false => ((x - away, line), Align::Right),
            };
            canvas.plate(place, letters, align, text);
            canvas.text(place, letters, align, text);
        }
    }
}
