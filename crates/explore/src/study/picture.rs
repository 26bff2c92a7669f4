//! Pictures of a study: a map over two grids, a slice along one axis.

use anyhow::anyhow;
use softstop_console::failure::Failure;
use softstop_draw::{Axis, Chart, Layer, Panel, Sign, style};
use softstop_dynamics::Regime;
use softstop_dynamics::motion_kind::MotionClass;

use super::plot::{PlotPoint, StudyView};
use super::report::AxisReport;
use super::values::Scale;
use crate::palette::{motion_color, regime_class};

/// Radius of a dot.
const DOT: f64 = 1.4;
/// Words of a colour that the legend tells at most.
const TOLD: usize = 3;

impl StudyView<'_> {
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

    fn chart(&self, x: Axis, y: Axis, layers: Vec<Layer>) -> Chart {
        let panel = Panel::new(x, y, layers).sized((760.0, 560.0));
        Chart {
            letters: 15,
            ..Chart::new(self.title(), [panel])
        }
    }

    /// A map, as PNG.
    ///
    /// # Errors
    /// [`Failure::Run`] if it cannot be drawn.
    pub fn map(&self, points: &[PlotPoint]) -> Result<Vec<u8>, Failure> {
        let [across, up] = [0, 1].map(|place| MapSide::of(self.axis(place)));
        let mut cells: Vec<Option<&PlotPoint>> = vec![None; across.count * up.count];
        for point in points {
            let [x, y] = [(&across, 0), (&up, 1)].map(|(side, place)| side.cell(point.at[place]));
            cells[y * across.count + x] = Some(point);
        }
        let layers = match self.column.summary.words.is_empty() {
            true => {
                let numbers = cells.iter().map(|it| it.map_or(f64::NAN, |it| it.number));
                vec![Layer::shades(across.count, numbers, self.name())]
            }
            false => {
                let word = |cell: Option<&PlotPoint>| cell.and_then(|it| it.word.clone());
                let colors = cells
                    .iter()
                    .map(|cell| motion_color(class(word(*cell).as_deref())));
                let mut layers = vec![Layer::cells(across.count, colors)];
                layers.extend(self.legend());
                layers
            }
        };
        let png = self.chart(across.axis, up.axis, layers).png();
        Ok(png.map_err(|error| anyhow!("cannot draw the map: {error}"))?)
    }

    /// The words of the whole study, those of a colour in one line, the most frequent first.
    fn legend(&self) -> impl Iterator<Item = Layer> {
        let mut words: Vec<_> = self.column.summary.words.iter().collect();
        words.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let mut lines: Vec<(&'static str, Vec<&str>)> = Vec::new();
        for (word, _) in words {
            let color = motion_color(class(Some(word)));
            match lines.iter_mut().find(|line| line.0 == color) {
                Some(line) => line.1.push(word),
                None => lines.push((color, vec![word])),
            }
        }
        if self.column.summary.values < self.manifest.points {
            lines.push((motion_color(class(None)), vec!["does not repeat"]));
        }
        lines.into_iter().map(|(color, words)| {
            let is_z = words[0].starts_with(|it: char| it.is_ascii_digit() || it == '∞');
            let z = if is_z { "z = " } else { "" };
            let more = if words.len() > TOLD { ", …" } else { "" };
            let told = words[..words.len().min(TOLD)].join(", ");
            Layer::key(Sign::Patch(color), format!("{z}{told}{more}"))
        })
    }

    /// A slice, as SVG.
    pub fn slice(&self, points: &[PlotPoint]) -> Vec<u8> {
        let axis = self.axis(0);
        let places = points.iter().map(|point| (point.at[0], point.number));
        let there = places.filter(|place| place.1.is_finite());
        let dots = Layer::dots(there, DOT, style::DESIGN);
        let chart = self.chart(axis.of_chart(), Axis::new(self.name()), vec![dots]);
        chart.svg().into_bytes()
    }
}

impl AxisReport {
    /// As a chart has it, without a range.
    fn of_chart(&self) -> Axis {
        Axis {
            is_log: self.values.scale() == Scale::Log,
            ..Axis::new(&self.label)
        }
    }
}

/// A side of a map: a grid.
struct MapSide {
    count: usize,
    /// Where cells begin and end, as powers of ten on a logarithmic axis.
    range: (f64, f64),
    axis: Axis,
}

impl MapSide {
    fn of(axis: &AxisReport) -> Self {
        let count = axis.values.count().unwrap_or(1);
        let chart_axis = axis.of_chart();
        let place = |number| chart_axis.position(axis.values.at(number));
        let (a, b) = (place(0), place(count - 1));
        let (low, high) = (a.min(b), a.max(b));
        let half = match count {
            1 => 0.5,
            _ => 0.5 * (high - low) / (count - 1) as f64,
        };
        let range = (low - half, high + half);
        let value = |place: f64| match chart_axis.is_log {
            true => 10f64.powf(place),
            false => place,
        };
        Self {
            count: count as usize,
            range,
            axis: chart_axis.clone().range((value(range.0), value(range.1))),
        }
    }

    /// The cell of a value.
    fn cell(&self, value: f64) -> usize {
        let share = (self.axis.position(value) - self.range.0) / (self.range.1 - self.range.0);
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
        Some(word) => regime(word).map_or(MotionClass::Many, regime_class),
    }
}
