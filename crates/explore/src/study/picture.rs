//! Pictures of a study: a map over two grids, a slice along one axis.

use anyhow::anyhow;
use softstop_console::failure::Failure;
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Pen};
use softstop_draw::scale::around;
use softstop_draw::shade;
use softstop_draw::style;
use softstop_dynamics::motion::MotionClass;
use softstop_dynamics::orbit::ImpactPattern;
use softstop_dynamics::{MotionKind, Regime};

use super::plot::{Point, View};
use super::report::AxisReport;
use super::values::Scale;
use crate::basin::cells::color;

/// Letters.
const LETTERS: u32 = 15;
/// The panel on its page, and the room at its right.
const AREA: (f64, f64, f64, f64) = (96.0, 64.0, 760.0, 560.0);
const RIGHT: f64 = 230.0;
const BELOW: f64 = 74.0;
/// Pixels for each unit of length.
const SCALE: f32 = 2.0;
/// Radius of a dot.
const DOT: f64 = 1.4;
/// Words of a colour that the legend tells at most.
const TOLD: usize = 3;

impl View<'_> {
    fn axis(&self, place: usize) -> &AxisReport {
        &self.manifest.axes[self.over[place]]
    }

    fn title(&self) -> String {
        let held = self.held.iter().map(|(axis, number)| {
            let axis = &self.manifest.axes[*axis];
            format!("{} = {}", axis.parameter, axis.values.at(*number))
        });
        let held: Vec<String> = held.collect();
        match held.is_empty() {
            true => self.column.meaning.clone(),
            false => format!("{} at {}", self.column.meaning, held.join(", ")),
        }
    }

    fn name(&self) -> String {
        match self.column.unit.as_str() {
            "" => self.column.name.clone(),
            unit => format!("{} ({unit})", self.column.name),
        }
    }

    fn page(&self) -> Pen {
        let mut pen = Pen::page(AREA.0 + AREA.2 + RIGHT, AREA.1 + AREA.3 + BELOW);
        pen.heading((AREA.0, 38.0), 18, Align::Left, &self.title());
        pen
    }

    /// A map, as PNG.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be drawn.
    pub fn map(&self, points: &[Point]) -> Result<Vec<u8>, Failure> {
        let [across, up] = [0, 1].map(|place| Side::of(self.axis(place)));
        let mut cells: Vec<Option<&Point>> = vec![None; across.count * up.count];
        for point in points {
            let [x, y] = [(&across, 0), (&up, 1)].map(|(side, place)| side.cell(point.at[place]));
            cells[y * across.count + x] = Some(point);
        }
        let panel = Panel::new(AREA, across.range, up.range);
        let mut pen = self.page();
        let right = AREA.0 + AREA.2;
        let words = !self.column.summary.words.is_empty();
        if words {
            let colors = cells
                .iter()
                .map(|cell| color(class(cell.and_then(|it| it.word.as_deref()))));
            panel.cells(&mut pen, across.count, &colors.collect::<Vec<_>>());
            self.legend(&mut pen, (right + 24.0, AREA.1 + 12.0));
        } else {
            let number = |cell: &Option<&Point>| cell.map_or(f64::NAN, |it| it.number);
            let range = around(cells.iter().map(number), 0.0);
            let shades: Vec<String> = (0..shade::SHADES).map(shade::color).collect();
            let colors = cells
                .iter()
                .map(number)
                .map(|value| match value.is_finite() {
                    true => shades[shade::shade(value, range)].as_str(),
                    false => color(MotionClass::Lost),
                });
            panel.cells(&mut pen, across.count, &colors.collect::<Vec<_>>());
            let bar = (right + 110.0, AREA.1, 18.0, AREA.3);
            shade::bar(&mut pen, bar, range, LETTERS, &self.name());
        }
        let axes = Axes::new(LETTERS, Some(&across.label), &up.label, (6, 6));
        panel.axes(&mut pen, &axes);
        let png = pen.png_at(SCALE);
        Ok(png.map_err(|error| anyhow!("cannot draw the map: {error}"))?)
    }

    /// The words of the whole study, those of a colour in one line, the most frequent first.
    fn legend(&self, pen: &mut Pen, (left, top): (f64, f64)) {
        let mut words: Vec<_> = self.column.summary.words.iter().collect();
        words.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let mut lines: Vec<(&str, Vec<&str>)> = Vec::new();
        for (word, _) in words {
            let color = color(class(Some(word)));
            match lines.iter_mut().find(|line| line.0 == color) {
                Some(line) => line.1.push(word),
                None => lines.push((color, vec![word])),
            }
        }
        if self.column.summary.values < self.manifest.points {
            lines.push((color(class(None)), vec!["does not repeat"]));
        }
        let size = f64::from(LETTERS);
        for (row, (color, words)) in lines.iter().enumerate() {
            let line = top + 1.7 * size * row as f64;
            let square = (left, line - size, 1.2 * size, 1.2 * size);
            pen.fill(&[square], color);
            pen.frame(square);
            let is_z = words[0].starts_with(|it: char| it.is_ascii_digit() || it == '∞');
            let z = if is_z { "z = " } else { "" };
            let more = if words.len() > TOLD { ", …" } else { "" };
            let told = words[..words.len().min(TOLD)].join(", ");
            let text = format!("{z}{told}{more}");
            pen.text((left + 1.8 * size, line), LETTERS, Align::Left, &text);
        }
    }

    /// A slice, as SVG.
    pub fn slice(&self, points: &[Point]) -> Vec<u8> {
        let axis = self.axis(0);
        let is_log = axis.values.scale() == Scale::Log;
        let x = |point: &Point| {
            if is_log {
                point.at[0].log10()
            } else {
                point.at[0]
            }
        };
        let across = around(points.iter().map(x), 0.02);
        let up = around(points.iter().map(|point| point.number), 0.04);
        let panel = Panel::new(AREA, across, up);
        let (label, name) = (label(axis), self.name());
        let axes = Axes::new(LETTERS, Some(&label), &name, (6, 6));
        let mut pen = self.page();
        panel.ground(&mut pen, &axes);
        let places = points.iter().map(|point| (x(point), point.number));
        let there = places.filter(|place| place.1.is_finite());
        panel.dots(&mut pen, there, DOT, style::DESIGN);
        panel.axes(&mut pen, &axes);
        pen.svg().into_bytes()
    }
}

fn label(axis: &AxisReport) -> String {
    match axis.values.scale() {
        Scale::Linear => axis.label.clone(),
        Scale::Log => format!("log₁₀ of {}", axis.label),
    }
}

/// A side of a map: a grid.
struct Side {
    count: usize,
    /// Where cells begin and end, and where the first is in the middle.
    range: (f64, f64),
    is_log: bool,
    label: String,
}

impl Side {
    fn of(axis: &AxisReport) -> Self {
        let count = axis.values.count().unwrap_or(1);
        let is_log = axis.values.scale() == Scale::Log;
        let place = |number| match axis.values.at(number) {
            value if is_log => value.log10(),
            value => value,
        };
        let (a, b) = (place(0), place(count - 1));
        let (low, high) = (a.min(b), a.max(b));
        let half = match count {
            1 => 0.5,
            _ => 0.5 * (high - low) / (count - 1) as f64,
        };
        Self {
            count: count as usize,
            range: (low - half, high + half),
            is_log,
            label: label(axis),
        }
    }

    /// The cell of a value.
    fn cell(&self, value: f64) -> usize {
        let value = if self.is_log { value.log10() } else { value };
        let share = (value - self.range.0) / (self.range.1 - self.range.0);
        ((share * self.count as f64) as usize).min(self.count - 1)
    }
}

/// What tells the colour of a kind or of z.
fn class(word: Option<&str>) -> MotionClass {
    let regime = |word: &str| {
        let (impacts, periods) = word.split_once('/').unwrap_or((word, "1"));
        Some(Regime {
            impacts: impacts.parse().ok()?,
            periods: periods.parse().ok()?,
        })
    };
    match word {
        None | Some("unsettled") => MotionClass::Unsettled,
        Some("periodic") => MotionClass::One,
        Some("chaos") => MotionClass::Chaos,
        Some("rest") => MotionClass::Rest,
        Some("lost") => MotionClass::Lost,
        Some(word) => regime(word).map_or(MotionClass::Many, |regime| {
            let order = ImpactPattern::new(&[], &[], regime.periods, 1.0);
            MotionKind::repeating(regime, order).class()
        }),
    }
}
