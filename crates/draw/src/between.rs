//! What is between the axes of a panel, and the axes, on the page.

use std::collections::BTreeMap;

use crate::chart::{Corner, Legend};
use crate::index::width;
use crate::layer::{Shape, Text};
use crate::layout::{BAR, GAP, LINE, Placed, TICK, Ticks, on, widest};
use crate::legend::{column, draw_column, draw_lines};
use crate::panel::Panel as Frame;
use crate::pen::{Align, Area, Pen};
use crate::shade::{SHADES, color, shade};
use crate::stroke::{Point, Stroke};

/// Lines behind what is drawn.
const GRID: Stroke = Stroke::solid("#e9e9e9", 1.0);
/// Half the length of the arrow that shows a direction, its width, and the shortest curve that has one.
const HEAD: (f64, f64) = (6.5, 2.2);
const SHORTEST: f64 = 15.0;

impl Placed<'_> {
    /// Everything of the panel.
    pub(crate) fn draw(&self, pen: &mut Pen, letters: u32) {
        let (frame, size) = (self.frame, f64::from(letters));
        let layers = &self.panel.layers;
        let is_filled = layers.iter().any(|it| it.fills());
        let behind = layers.iter().take_while(|it| it.is_behind()).count();
        for (index, layer) in layers.iter().enumerate() {
            if index == behind && !is_filled {
                self.ground(pen);
            }
            self.shape(pen, letters, &layer.shape, is_filled);
        }
        self.labels(pen, letters);
        self.axes(pen, letters);
        if let Some((range, name)) = self.panel.bar() {
            self.bar(pen, letters, range, name);
        }
        for name in &self.names {
            self.name(pen, letters, name);
        }
        let top = frame.area.1 - 8.0 - LINE * size * self.lines() as f64;
        pen.heading(
            (frame.area.0, top),
            letters + 1,
            Align::Left,
            &self.panel.title,
        );
        self.legend(pen, letters);
    }

    /// Lines at the round values.
    fn ground(&self, pen: &mut Pen) {
        let frame = self.frame;
        for (value, _) in &self.ticks[0] {
            let x = frame.across(*value);
            pen.line(&[(x, frame.area.1), (x, frame.bottom())], GRID);
        }
        for (value, _) in &self.ticks[1] {
            let y = frame.height(*value);
            pen.line(&[(frame.area.0, y), (frame.right(), y)], GRID);
        }
    }

    fn place(&self, point: Point) -> Point {
        self.frame.place(self.on(point))
    }

    /// Points as the frame takes them.
    fn points(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|point| self.on(*point)).collect()
    }

    fn holds(&self, point: Point) -> bool {
        self.frame.holds(self.on(point))
    }

    fn shape(&self, pen: &mut Pen, letters: u32, shape: &Shape, is_filled: bool) {
        let frame = &self.frame;
        let (x, y) = (frame.x, frame.y);
        match shape {
            Shape::Line(points, stroke) => {
                let points = self.points(points);
                for run in points.split(|it| !it.0.is_finite() || !it.1.is_finite()) {
                    frame.curve(pen, run, *stroke);
                }
            }
            Shape::Contour(points, dashes) => frame.rimmed(pen, &self.points(points), *dashes),
            Shape::Dots(points, radius, color) => {
                let points = points.iter().map(|point| self.on(*point));
                frame.dots(pen, points, *radius, color);
            }
            Shape::Marks(points, mark, half, color) => {
                for point in points.iter().filter(|point| self.holds(**point)) {
                    if is_filled {
                        pen.mark(self.place(*point), *mark, half + 2.0, "#ffffff");
                    }
                    pen.mark(self.place(*point), *mark, *half, color);
                }
            }
            Shape::Band(places, color, opacity) => {
                let places = places.iter().map(|(at, ends)| {
                    let ends = ends.map(|end| on(&self.panel.y, end).clamp(y.0, y.1));
                    (on(&self.panel.x, *at).clamp(x.0, x.1), ends)
                });
                let places: Vec<_> = places.collect();
                if places.len() > 1 {
                    frame.band(pen, &places, color, *opacity);
                }
            }
            Shape::Boxes(boxes, color, opacity) => {
                let areas: Vec<Area> = boxes.iter().filter_map(|it| self.area(it)).collect();
                match *opacity < 1.0 {
                    true => areas
                        .iter()
                        .for_each(|area| pen.tint(*area, color, *opacity)),
                    false => pen.fill(&areas, color),
                }
            }
            Shape::Cells(columns, colors) => {
                let colors = colors.iter().map(|color| Some((*color).to_owned()));
                cells(pen, frame, *columns, &colors.collect::<Vec<_>>());
            }
            Shape::Shades(columns, values, _) => {
                let range = self.panel.bar().map_or((0.0, 1.0), |it| it.0);
                let colors = values.iter().map(|value| {
                    let shade = value.is_finite().then(|| shade(*value, range));
                    shade.map(color)
                });
                cells(pen, frame, *columns, &colors.collect::<Vec<_>>());
            }
            Shape::Ring(middle, half) => {
                let (middle, end) = (*middle, (middle.0 + half.0, middle.1 + half.1));
                let (centre, end) = (self.place(middle), self.place(end));
                pen.ring(centre, (end.0 - centre.0, centre.1 - end.1));
            }
            Shape::Across(height, stroke, text) => {
                let height = on(&self.panel.y, *height);
                frame.curve(pen, &[(x.0, height), (x.1, height)], *stroke);
                let place = (frame.right() - 6.0, frame.height(height) - 6.0);
                pen.text(place, letters - 1, Align::Right, text);
            }
            Shape::Upwards(place, stroke, _) => {
                let place = on(&self.panel.x, *place);
                frame.curve(pen, &[(place, y.0), (place, y.1)], *stroke);
            }
            Shape::Arrow(from, to, stroke) => {
                pen.arrow(self.place(*from), self.place(*to), *stroke);
            }
            Shape::Direction(points, share, stroke) => self.direction(pen, points, *share, *stroke),
            Shape::Text(text) => self.text(pen, letters, text),
            Shape::Message(words) => frame.message(pen, letters, words),
            Shape::Label(..) | Shape::Key(_) => {}
        }
    }

    /// A box as far as it lies inside.
    fn area(&self, [x, y]: &[(f64, f64); 2]) -> Option<Area> {
        let frame = &self.frame;
        let ends = [(x.0, y.1), (x.1, y.0)].map(|(x, y)| {
            let x = on(&self.panel.x, x).clamp(frame.x.0, frame.x.1);
            frame.place((x, on(&self.panel.y, y).clamp(frame.y.0, frame.y.1)))
        });
        let [(left, top), (right, bottom)] = ends;
        let area = (left, top, (right - left).max(0.5), bottom - top);
        (area.2.is_finite() && area.3 > 0.0).then_some(area)
    }

    /// The head of an arrow on a curve.
    fn direction(&self, pen: &mut Pen, points: &[Point], share: f64, stroke: Stroke) {
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
        let half = (HEAD.0 * way.0, HEAD.0 * way.1);
        let from = (to.0 + left * way.0, to.1 + left * way.1);
        let tail = (from.0 - half.0, from.1 - half.1);
        let tip = (from.0 + half.0, from.1 + half.1);
        let width = HEAD.1;
        pen.arrow(tail, tip, Stroke { width, ..stroke });
    }

    fn text(&self, pen: &mut Pen, letters: u32, text: &Text) {
        let at = self.on(text.at);
        let inside = (
            at.0.clamp(self.frame.x.0, self.frame.x.1),
            at.1.clamp(self.frame.y.0, self.frame.y.1),
        );
        let (x, y) = self.frame.place(inside);
        let place = (x + text.offset.0, y + text.offset.1);
        let look = (text.color, text.is_plated);
        pen.words(place, letters, text.align, look, &text.text);
    }

    /// Names of points, right of them or left; a name that would cover another one moves down.
    fn labels(&self, pen: &mut Pen, letters: u32) {
        let labels = self
            .panel
            .layers
            .iter()
            .filter_map(|layer| match &layer.shape {
                Shape::Label(at, text) => Some((self.place(*at), text)),
                _ => None,
            });
        let mut labels: Vec<(Point, &String)> = labels.collect();
        labels.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
        let size = f64::from(letters);
        let mut taken: Vec<(f64, f64, f64)> = Vec::new();
        for ((x, y), text) in labels {
            let (wide, away) = (width(letters - 1, text), 0.85 * size);
            let fits = x + away + wide < self.frame.right();
            let left = if fits { x + away } else { x - away - wide };
            let mut line = y + 0.36 * size;
            while taken.iter().any(|(other, width, height)| {
                left < other + width && *other < left + wide && (line - height).abs() < 1.2 * size
            }) {
                line += 1.0;
            }
            taken.push((left, wide, line));
            match fits {
                true => pen.text((left, line), letters - 1, Align::Left, text),
                false => pen.text((x - away, line), letters - 1, Align::Right, text),
            }
        }
    }

    /// The name of a place across, above the panel.
    fn name(&self, pen: &mut Pen, letters: u32, name: &crate::layout::Name) {
        let (x, top) = (self.frame.across(name.at), self.frame.area.1);
        let y = top - 6.0 - LINE * f64::from(letters) * name.line as f64;
        let stroke = Stroke::solid(name.stroke.color, 1.0);
        pen.line(&[(x, y - 10.0), (x, top)], stroke);
        let wide = 0.86 * width(letters, &name.text);
        match x + 4.0 + wide < self.frame.right() + 20.0 {
            true => pen.text((x + 4.0, y), letters, Align::Left, &name.text),
            false => pen.text((x - 4.0, y), letters, Align::Right, &name.text),
        }
    }

    /// Frame, ticks, numbers and names.
    fn axes(&self, pen: &mut Pen, letters: u32) {
        let (frame, size) = (self.frame, f64::from(letters));
        let (left, _, wide, _) = frame.area;
        for (value, text) in &self.ticks[0] {
            let (x, y) = (frame.across(*value), frame.bottom() + TICK);
            pen.tick((x, frame.bottom()), (x, y));
            if self.shows[0] {
                pen.text((x, y + 1.1 * size), letters, Align::Middle, text);
            }
        }
        if self.shows[0] {
            let numbers = if self.ticks[0].is_empty() { 0.0 } else { LINE };
            let y = frame.bottom() + TICK + (numbers + 1.25) * size;
            let place = (left + 0.5 * wide, y);
            pen.text(place, letters + 1, Align::Middle, &self.panel.x.name);
        }
        let (ticks, name) = (&self.ticks[1], &self.panel.y.name);
        upwards(pen, &frame, letters, (ticks, name, self.shows[1]));
        pen.frame(frame.area);
    }

    /// The bar of shades.
    fn bar(&self, pen: &mut Pen, letters: u32, range: (f64, f64), name: &str) {
        let (_, top, _, high) = self.frame.area;
        let room = TICK + 4.0 + widest(&self.ticks[2], letters) + LINE * f64::from(letters);
        let left = self.frame.right() + GAP + room;
        let bar = Frame::new((left, top, BAR, high), (0.0, 1.0), range);
        for shade in 0..SHADES {
            let high = high / SHADES as f64;
            let top = bar.bottom() - high * (shade + 1) as f64;
            pen.fill(&[(left, top, BAR, high + 0.5)], &color(shade));
        }
        upwards(pen, &bar, letters, (&self.ticks[2], name, true));
        pen.frame(bar.area);
    }

    /// The legend of the panel, in a corner on a light plate.
    fn legend(&self, pen: &mut Pen, letters: u32) {
        let Some(legend) = self.legend.filter(|_| !self.key.is_empty()) else {
            return;
        };
        let (wide, high) = column(&self.key, letters);
        let [_, beside, above, below] = self.margins;
        let (left, top, width, height) = self.frame.area;
        let (right, bottom) = (left + width, top + height);
        let (inner, lower) = (right - wide - GAP, bottom - high - GAP);
        let corner = match legend {
            Legend::Right => {
                let place = (right + beside - wide, top);
                return draw_column(pen, place, letters, &self.key);
            }
            Legend::Above => {
                let place = (left, top - above);
                return draw_lines(pen, place, letters, width, &self.key);
            }
            Legend::Below => {
                let high = self.key_height(letters);
                let place = (left, bottom + below - high);
                return draw_lines(pen, place, letters, width, &self.key);
            }
            Legend::Inside(corner) => corner,
        };
        let (left, top) = match corner {
            Corner::TopLeft => (left + GAP, top + 6.0),
            Corner::TopRight => (inner, top + 6.0),
            Corner::BottomLeft => (left + GAP, lower),
            Corner::BottomRight => (inner, lower),
        };
        pen.tint((left - 4.0, top, wide + 8.0, high + 6.0), "#ffffff", 0.82);
        draw_column(pen, (left, top), letters, &self.key);
    }
}

/// An axis upwards at the left of a frame: ticks, numbers if they are shown, and its name.
fn upwards(pen: &mut Pen, frame: &Frame, letters: u32, (ticks, name, shows): (&Ticks, &str, bool)) {
    let (left, top, _, high) = frame.area;
    let size = f64::from(letters);
    for (value, text) in ticks {
        let y = frame.height(*value);
        pen.tick((left - TICK, y), (left, y));
        if shows {
            let place = (left - TICK - 4.0, y + 0.36 * size);
            pen.text(place, letters, Align::Right, text);
        }
    }
    if shows && !name.is_empty() {
        let x = left - TICK - 6.0 - widest(ticks, letters) - 0.4 * size;
        pen.text((x, top + 0.5 * high), letters + 1, Align::Upwards, name);
    }
}

/// Rows of cells that fill a frame, the lowest row first; runs of one colour are one rectangle, their edges on half units.
fn cells(pen: &mut Pen, frame: &Frame, columns: usize, colors: &[Option<String>]) {
    let (left, _, width, height) = frame.area;
    let rows = colors.len() / columns;
    let (wide, high) = (width / columns as f64, height / rows as f64);
    let edge = |place: f64| (2.0 * place).round() / 2.0;
    let mut areas: BTreeMap<&String, Vec<Area>> = BTreeMap::new();
    for (row, colors) in colors.chunks(columns).enumerate() {
        let (top, bottom) = (
            edge(frame.bottom() - high * (row + 1) as f64),
            edge(frame.bottom() - high * row as f64),
        );
        let mut from = 0;
        for run in colors.chunk_by(|a, b| a == b) {
            let ends = [from, from + run.len()].map(|column| edge(left + wide * column as f64));
            from += run.len();
            if let Some(color) = &run[0] {
                let area = (ends[0], top, ends[1] - ends[0], bottom - top);
                areas.entry(color).or_default().push(area);
            }
        }
    }
    for (color, areas) in areas {
        pen.fill(&areas, color);
    }
}
