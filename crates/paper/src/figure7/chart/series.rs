//! The panels of position over time, with the phases shaded.

use super::{CURVE, FACE, GUIDE, LETTERS, StrokeChart, StrokePoint};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::style;
use softstop_explore::simulate::chart::color;

/// Periods of the time series.
const SHOWN: f64 = 2.5;

impl StrokeChart {
    /// Some periods.
    pub(super) fn series(&self, pen: &mut Pen, area: Area) {
        let (low, _) = self.range(|point| (point.time, point.position));
        let panel = Panel::new(
            area,
            (0.0, SHOWN * self.period),
            (1.12 * low, 1.32 * self.max_position),
        );
        let shifts = (0..=SHOWN as u32).map(|cycle| f64::from(cycle) * self.period);
        for shift in shifts.clone() {
            self.shade(pen, &panel, shift);
        }
        for (face, _) in self.faces() {
            panel.curve(pen, &[(panel.x.0, face), (panel.x.1, face)], FACE);
        }
        for shift in shifts {
            let place = |point: &StrokePoint| (point.time + shift, point.position);
            let points: Vec<(f64, f64)> = self.points.iter().map(place).collect();
            panel.curve(pen, &points, CURVE);
        }
        self.height(pen, &panel);
        self.span(pen, &panel);
        let axes = Axes::new(LETTERS, Some("time τ"), "position X", (7, 6));
        panel.axes(pen, &axes);
    }

    /// The time around the impact.
    pub(super) fn impact(&self, pen: &mut Pen, area: Area) {
        let (begin, end) = self.touching();
        let (room, depth) = (0.45 * (end - begin), self.depth());
        let panel = Panel::new(
            area,
            (begin - room, end + room),
            (
                self.clearance - 0.9 * depth,
                self.max_position + 0.35 * depth,
            ),
        );
        self.shade(pen, &panel, 0.0);
        for (face, name) in self.faces() {
            panel.curve(pen, &[(panel.x.0, face), (panel.x.1, face)], FACE);
            let place = (panel.area.0 + 8.0, panel.height(face) - 5.0);
            pen.text(place, LETTERS, Align::Left, name);
        }
        let show = |point: &StrokePoint| (point.time, point.position);
        panel.curve(pen, &self.curve(show), CURVE);
        let beside = [(-11.0, -7.0), (-11.0, -7.0), (-12.0, 18.0)];
        self.letters(pen, &panel, show, beside);
        let axes = Axes::new(
            LETTERS,
            Some("time τ"),
            "position X around the impact",
            (4, 6),
        );
        panel.axes(pen, &axes);
    }

    /// Shades the phases of a period that begins so much later.
    fn shade(&self, pen: &mut Pen, panel: &Panel, later: f64) {
        for arc in self.points.chunk_by(|a, b| a.phase == b.phase) {
            let Some(color) = color(arc[0].phase) else {
                continue;
            };
            let begin = (arc[0].time + later).max(panel.x.0);
            let end = (arc[arc.len() - 1].time + later).min(panel.x.1);
            if begin < end {
                let (left, right) = (panel.across(begin), panel.across(end));
                let area = (left, panel.area.1, right - left, panel.area.3);
                pen.tint(area, color, 1.0);
            }
        }
    }

    /// Marks X_m after the first impact.
    fn height(&self, pen: &mut Pen, panel: &Panel) {
        let (begin, end) = self.touching();
        let top = f64::midpoint(begin, end);
        let right = top + 0.5 * self.period;
        let line = [(top, self.max_position), (right, self.max_position)];
        panel.curve(pen, &line, GUIDE);
        let x = panel.across(top + 0.38 * self.period);
        pen.arrow(
            (x, panel.height(0.0)),
            (x, panel.height(self.max_position)),
            Stroke::solid(style::OPTIMUM, 1.3),
        );
        let place = (x + 7.0, panel.height(0.45 * self.max_position));
        let ink = (style::OPTIMUM, true);
        pen.words(place, LETTERS + 1, Align::Left, ink, "X_m");
    }

    /// Marks the period between the first two impacts.
    fn span(&self, pen: &mut Pen, panel: &Panel) {
        let (begin, _) = self.touching();
        let y = panel.height(1.2 * self.max_position);
        let (left, right) = (panel.across(begin), panel.across(begin + self.period));
        let middle = f64::midpoint(left, right);
        let line = Stroke::solid(style::INK, 1.2);
        pen.arrow((middle, y), (left, y), line);
        pen.arrow((middle, y), (right, y), line);
        let ink = (style::INK, true);
        pen.words((middle, y + 5.0), LETTERS + 1, Align::Middle, ink, "T");
    }
}
