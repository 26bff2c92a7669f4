//! The chart of regimes: a strip over drive frequency for each model and start.

use kuva::backend::svg::SvgBackend;
use kuva::plot::ScatterPlot;
use kuva::plot::legend::{LegendEntry, LegendPosition, LegendShape};
use kuva::plot::scatter::MarkerShape;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use softstop::{Machine, Parameter};
use softstop_dynamics::orbit::Regime;

use softstop_draw::style;

/// Regimes over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    /// Rising, in the machine's own units.
    pub frequencies: Vec<f64>,
    /// The regime at each; none where nothing repeats.
    pub regimes: Vec<Option<Regime>>,
}

/// The two strips of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct RegimeRow {
    /// What it is called.
    pub name: String,
    /// From rest.
    pub from_rest: Strip,
    /// From a start towards the stop.
    pub flung: Strip,
}

/// One of the strips of a model.
type Pick = fn(&RegimeRow) -> &Strip;

/// The chart of regimes.
#[derive(Debug, Clone)]
pub struct RegimeChart {
    title: String,
    x_label: String,
    rows: Vec<RegimeRow>,
}

/// Classes of regimes, with their colours: Okabe and Ito's, grey for no impacts and black for what does
/// not repeat.
const CLASSES: [(&str, &str); 7] = [
    ("z = 0", "#D9D9D9"),
    ("z = 1", "#0072B2"),
    ("z = p, p > 1", "#56B4E9"),
    ("z = p/2", "#E69F00"),
    ("z = p/3", "#009E73"),
    ("z = p/n, n > 3", "#CC79A7"),
    ("unsettled", "#000000"),
];

fn class(regime: Option<Regime>) -> usize {
    match regime.map(|regime| (regime.impacts, regime.periods)) {
        None => 6,
        Some((0, _)) => 0,
        Some((1, 1)) => 1,
        Some((_, 1)) => 2,
        Some((_, 2)) => 3,
        Some((_, 3)) => 4,
        Some(_) => 5,
    }
}

/// Width of a panel in pixels, and what its axes leave of it.
const WIDTH: f64 = 1100.0;
const WITHIN: f64 = 860.0;
/// Height of a row in pixels.
const ROW: f64 = 26.0;

impl RegimeChart {
    /// The chart of these models.
    #[must_use]
    pub fn new(title: String, machine: &Machine, rows: Vec<RegimeRow>) -> Self {
        Self {
            title,
            x_label: machine.label_of(Parameter::Frequency),
            rows,
        }
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let starts: [(&str, Pick); 2] = [
            ("from rest", |row| &row.from_rest),
            ("flung towards the stop", |row| &row.flung),
        ];
        let figure = Figure::new(2, 1)
            .with_plots(starts.iter().map(|(_, strip)| self.plots(*strip)).collect())
            .with_layouts(
                starts
                    .iter()
                    .map(|(name, strip)| self.layout(name, *strip))
                    .collect(),
            )
            .with_title(self.title.clone())
            .with_cell_size(WIDTH, 110.0 + ROW * self.rows.len() as f64)
            .with_shared_legend_bottom()
            .with_shared_legend_entries(legend());
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&figure.render())
    }

    /// One plot for each class, so that each has one colour.
    fn plots(&self, strip: Pick) -> Vec<Plot> {
        let plot = |wanted: usize| {
            let marks = self.rows.iter().enumerate().flat_map(move |(place, row)| {
                let strip = strip(row);
                let height = self.height(place);
                let cells = strip.frequencies.iter().zip(&strip.regimes);
                cells
                    .filter(move |(_, regime)| class(**regime) == wanted)
                    .map(move |(frequency, _)| (*frequency, height))
            });
            let marks: Vec<(f64, f64)> = marks.collect();
            let count = self
                .rows
                .first()
                .map_or(1, |row| strip(row).frequencies.len());
            let size = (0.5 * WITHIN / count as f64).clamp(1.5, 0.4 * ROW);
            (!marks.is_empty()).then(|| {
                Plot::Scatter(
                    ScatterPlot::new()
                        .with_data(marks)
                        .with_color(CLASSES[wanted].1)
                        .with_marker(MarkerShape::Square)
                        .with_size(size),
                )
            })
        };
        (0..CLASSES.len()).filter_map(plot).collect()
    }

    fn layout(&self, start: &str, strip: Pick) -> Layout {
        let ends = self
            .rows
            .first()
            .map(strip)
            .and_then(|strip| Some((*strip.frequencies.first()?, *strip.frequencies.last()?)));
        let (low, high) = ends.unwrap_or((0.0, 1.0));
        let count = self
            .rows
            .first()
            .map_or(1, |row| strip(row).frequencies.len());
        let pad = 0.5 * (high - low) / count as f64;
        let names = self.rows.iter().rev().map(|row| row.name.clone());
        style::plain((low - pad, high + pad), (0.5, self.rows.len() as f64 + 0.5))
            .with_title(start)
            .with_x_label(self.x_label.clone())
            .with_x_tick_format(TickFormat::Fixed(if high - low < 10.0 { 2 } else { 0 }))
            .with_y_categories(names.collect())
            .with_legend_position(LegendPosition::OutsideRightTop)
    }

    /// Where a row stands; the first is at the top.
    fn height(&self, place: usize) -> f64 {
        (self.rows.len() - place) as f64
    }
}

fn legend() -> Vec<LegendEntry> {
    CLASSES
        .iter()
        .map(|(label, color)| LegendEntry {
            label: (*label).to_owned(),
            color: (*color).to_owned(),
            shape: LegendShape::Rect,
            dasharray: None,
        })
        .collect()
}
