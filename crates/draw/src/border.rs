//! What is around the layers of a panel: frame, ticks and names of the axes, the bar of shades, title and legend.

use crate::axis::{Ticks, widest};
use crate::canvas::Canvas;
use crate::frame::Frame;
use crate::grid::GAP;
use crate::layout::{BAR, LINE, PlacedPanel, TICK};
use crate::mark::Align;
use crate::names::{AWAY, Name, lines};
use crate::shade::{SHADES, color};
use crate::stroke::{Point, Stroke};
use crate::style;

impl PlacedPanel<'_> {
    /// Everything of the panel.
    pub(crate) fn draw(&self, canvas: &mut Canvas) {
        self.paint(canvas);
        self.axes(canvas);
        self.bar(canvas);
        for name in &self.names {
            self.name(canvas, name);
        }
        let (left, top, width, height) = self.frame.area;
        let names = LINE * f64::from(self.letters) * lines(&self.names) as f64;
        let place = (left, top - 8.0 - names);
        canvas.heading(place, self.letters + 1, &self.panel.title);
        if let Some(legend) = self.legend {
            let [_, beside, above, below] = self.margins;
            let outer = (left, top - above, width + beside, height + above + below);
            self.key.draw(canvas, legend, self.frame.area, outer);
        }
    }

    fn axes(&self, canvas: &mut Canvas) {
        let (frame, size) = (self.frame, f64::from(self.letters));
        let [across, upwards, _] = &self.ticks;
        for (value, text) in across {
            let (x, y) = (frame.x_of(*value), frame.bottom() + TICK);
            tick(canvas, (x, frame.bottom()), (x, y));
            if self.shows[0] {
                canvas.text((x, y + 1.1 * size), self.letters, Align::Middle, text);
            }
        }
        if self.shows[0] {
            let numbers = if across.is_empty() { 0.0 } else { LINE };
            let y = frame.bottom() + TICK + (numbers + 1.25) * size;
            let place = (frame.area.0 + 0.5 * frame.area.2, y);
            canvas.text(place, self.letters + 1, Align::Middle, &self.labels[0]);
        }
        let name = self.shows[1].then_some(&*self.labels[1]);
        self.upwards(canvas, &frame, upwards, name);
        if !(self.panel.x.is_bare(across) && self.panel.y.is_bare(upwards)) {
            canvas.frame(frame.area);
        }
    }

    /// An axis upwards at the left of a frame: ticks, and numbers if it has a name that may be empty.
    fn upwards(&self, canvas: &mut Canvas, frame: &Frame, ticks: &Ticks, name: Option<&str>) {
        let (left, top, _, high) = frame.area;
        let size = f64::from(self.letters);
        for (value, text) in ticks {
            let y = frame.y_of(*value);
            tick(canvas, (left - TICK, y), (left, y));
            if name.is_some() {
                let place = (left - TICK - 4.0, y + 0.36 * size);
                canvas.text(place, self.letters, Align::Right, text);
            }
        }
        let x = left - TICK - 6.0 - widest(ticks, self.letters) - 0.4 * size;
        let place = (x, top + 0.5 * high);
        canvas.text(
            place,
            self.letters + 1,
            Align::Upwards,
            name.unwrap_or_default(),
        );
    }

    /// The bar of shades, if there are any.
    fn bar(&self, canvas: &mut Canvas) {
        let Some((y, _)) = self.panel.bar() else {
            return;
        };
        let (_, top, _, high) = self.frame.area;
        let room =
            TICK + 4.0 + widest(&self.ticks[2], self.letters) + LINE * f64::from(self.letters);
        let left = self.frame.right() + GAP + room;
        let area = (left, top, BAR, high);
        let bar = Frame {
            area,
            y,
            ..self.frame
        };
        let step = high / SHADES as f64;
        for shade in 0..SHADES {
            let top = bar.bottom() - step * (shade + 1) as f64;
            canvas.fill(&[(left, top, BAR, step + 0.5)], &color(shade));
        }
        self.upwards(canvas, &bar, &self.ticks[2], Some(&self.labels[2]));
        canvas.frame(area);
    }

    /// The name of a place across, with its line down to the panel.
    fn name(&self, canvas: &mut Canvas, name: &Name) {
        let (x, top) = (self.frame.x_of(name.at), self.frame.area.1);
        let y = top - 6.0 - LINE * f64::from(self.letters) * name.line as f64;
        canvas.line(&[(x, y - 10.0), (x, top)], Stroke::solid(name.color, 1.0));
        let (away, align) = match name.is_left {
            true => (-AWAY, Align::Right),
            false => (AWAY, Align::Left),
        };
        canvas.text((x + away, y), self.letters, align, &name.text);
    }
}

fn tick(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.line(&[from, to], Stroke::solid(style::INK, 1.0));
}
