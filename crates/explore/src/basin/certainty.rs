//! How certainly z = 1 establishes itself along the hysteresis zone.

use kuva::backend::svg::SvgBackend;
use kuva::plot::band::BandPlot;
use kuva::plot::legend::LegendPosition;
use kuva::plot::{LinePlot, LineStyle};
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::{collect_legend_entries, render_multiple};
use softstop::{Dimension, Machine, Parameter};
use softstop_dynamics::basin::Establishing;

use softstop_draw::style;

/// Certainty of z = 1 along the hysteresis zone of one machine.
#[derive(Debug, Clone, Copy)]
pub struct CertaintyChart<'a> {
    machine: &'a Machine,
    places: &'a [Establishing],
    title: &'a str,
}

impl<'a> CertaintyChart<'a> {
    /// The chart of these places.
    #[must_use]
    pub fn new(machine: &'a Machine, places: &'a [Establishing], title: &'a str) -> Self {
        Self {
            machine,
            places,
            title,
        }
    }

    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let ends = [self.places.first(), self.places.last()];
        let own = |frequency| self.machine.to_own(Dimension::Frequency, frequency);
        let [low, high] = ends.map(|place| place.map_or(0.0, |place| own(place.frequency)));
        let room = 0.03 * (high - low).max(1e-3 * high);
        let points = self.places.iter().map(|place| CertaintyPoint {
            place: own(place.frequency),
            value: place.certainty,
            interval: Some(place.interval),
        });
        let curve = CertaintyCurve {
            label: String::new(),
            color: 0,
            is_dashed: false,
            points: points.collect(),
        };
        let layout = style::plain((low - room, high + room), (0.0, 1.02))
            .with_width(900.0)
            .with_height(560.0)
            .with_title(self.title)
            .with_subtitle("share of initial states that lead to z = 1, with 95 % interval")
            .with_x_label(format!(
                "{}, from g₀ to s_SN",
                self.machine.label_of(Parameter::Frequency)
            ))
            .with_y_label("establishing certainty of z = 1");
        SvgBackend::new()
            .with_pretty(true)
            .render_scene(&render_multiple(curve.plots(), layout))
    }
}

/// A value at a place of the zone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CertaintyPoint {
    /// Where.
    pub place: f64,
    /// What.
    pub value: f64,
    /// How sure it is.
    pub interval: Option<[f64; 2]>,
}

/// A curve over the places of the zone.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyCurve {
    /// What it is called in the legend.
    pub label: String,
    /// Which colour of eight.
    pub color: usize,
    /// Dashed instead of solid.
    pub is_dashed: bool,
    /// Its points.
    pub points: Vec<CertaintyPoint>,
}

/// A panel of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyPanel {
    /// What it shows.
    pub title: String,
    /// What goes upwards.
    pub up: &'static str,
    /// The curves.
    pub curves: Vec<CertaintyCurve>,
    /// With the paper's claim: one at g0, zero at s_SN.
    pub has_claim: bool,
    /// With a legend of its own; the first panel's stands for all others.
    pub has_legend: bool,
}

/// Panels of curves over the hysteresis zone.
#[derive(Debug, Clone, PartialEq)]
pub struct CertaintyPage {
    /// The panels, two in a row.
    pub panels: Vec<CertaintyPanel>,
}

/// Okabe and Ito's colours, and a grey.
const COLORS: [&str; 8] = [
    "#E69F00", "#56B4E9", "#0072B2", "#009E73", "#D55E00", "#CC79A7", "#000000", "#8C8C8C",
];
/// Size of a panel.
const CELL: (f64, f64) = (640.0, 470.0);

impl CertaintyCurve {
    fn plots(&self) -> Vec<Plot> {
        let color = COLORS[self.color % COLORS.len()];
        let places = self.points.iter().map(|point| (point.place, point.value));
        let line = LinePlot::new()
            .with_data(places.collect::<Vec<_>>())
            .with_color(color)
            .with_stroke_width(2.2)
            .with_line_style(if self.is_dashed {
                LineStyle::Dashed
            } else {
                LineStyle::Solid
            });
        let line = if self.label.is_empty() {
            line
        } else {
            line.with_legend(self.label.clone())
        };
        let sure: Vec<(f64, [f64; 2])> = self
            .points
            .iter()
            .filter_map(|point| Some((point.place, point.interval?)))
            .collect();
        if sure.is_empty() {
            return vec![Plot::Line(line)];
        }
        let edge = |end: usize| sure.iter().map(move |(_, interval)| interval[end]);
        let band = BandPlot::new(sure.iter().map(|(place, _)| *place), edge(0), edge(1))
            .with_color(color)
            .with_opacity(0.25);
        vec![Plot::Band(band), Plot::Line(line)]
    }
}

impl CertaintyPanel {
    fn plots(&self) -> Vec<Plot> {
        let mut plots: Vec<Plot> = self.curves.iter().flat_map(CertaintyCurve::plots).collect();
        if self.has_claim {
            plots.push(Plot::Line(
                LinePlot::new()
                    .with_data([(0.0, 1.0), (1.0, 0.0)])
                    .with_color(style::ASIDE)
                    .with_stroke_width(1.4)
                    .with_line_style(LineStyle::Dotted)
                    .with_legend("the paper: one at g₀, zero at s_SN"),
            ));
        }
        plots
    }

    fn layout(&self, plots: &[Plot]) -> Layout {
        let layout = style::plain((-0.02, 1.02), (0.0, 1.02))
            .with_title(self.title.clone())
            .with_x_label("place in the hysteresis zone: 0 at g₀, 1 at s_SN")
            .with_y_label(self.up)
            .with_x_tick_step(0.2)
            .with_y_tick_step(0.2)
            .with_x_tick_format(TickFormat::Fixed(1))
            .with_y_tick_format(TickFormat::Fixed(1));
        if self.has_legend {
            layout
                .with_legend_entries(collect_legend_entries(plots))
                .with_legend_position(LegendPosition::InsideTopRight)
        } else {
            layout
        }
    }
}

impl CertaintyPage {
    /// The page as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let plots: Vec<Vec<Plot>> = self.panels.iter().map(CertaintyPanel::plots).collect();
        let shared = plots.first().map(|plots| collect_legend_entries(plots));
        let shared = shared.unwrap_or_default();
        let panels = self.panels.iter().zip(&plots);
        let layouts = panels.map(|(panel, plots)| panel.layout(plots)).collect();
        let figure = Figure::new(self.panels.len().div_ceil(2), 2)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_title("How certainly z = 1 establishes itself in its hysteresis zone")
            .with_keep_panel_legends()
            .with_shared_legend_right_top()
            .with_shared_legend_entries(shared)
            .with_cell_size(CELL.0, CELL.1);
        SvgBackend::new().render_scene(&figure.render())
    }
}
