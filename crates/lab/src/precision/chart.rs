//! The work-precision diagram: what each method's accuracy costs.

use kuva::backend::svg::SvgBackend;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;

use crate::precision::family::Look;
use crate::precision::measure::Row;
use crate::precision::report::SceneReport;
use softstop_draw::scale::power_of_ten;
use softstop_draw::style;

/// Colour and marker of a scheme: no two have both in common. The first is the exact method's.
const LOOKS: [(&str, MarkerShape); 13] = [
    (style::POINT, MarkerShape::Star),
    (style::REFERENCE, MarkerShape::Circle),
    (style::ALLOWED, MarkerShape::Square),
    ("#009E73", MarkerShape::Triangle),
    ("#CC79A7", MarkerShape::Diamond),
    (style::DESIGN, MarkerShape::TriangleDown),
    (style::OPTIMUM, MarkerShape::Circle),
    (style::ASIDE, MarkerShape::Square),
    (style::OPTIMUM, MarkerShape::Square),
    (style::DESIGN, MarkerShape::Circle),
    ("#009E73", MarkerShape::Diamond),
    (style::REFERENCE, MarkerShape::Triangle),
    ("#CC79A7", MarkerShape::TriangleDown),
];

/// An error below this is drawn here, as a power of ten.
const FLOOR: f64 = -17.0;
/// An error above this is drawn here, as a power of ten.
const CEILING: f64 = 1.0;

/// A quantity of a run, if it has one.
type Quantity = fn(&Row) -> Option<f64>;

/// What a panel draws over what.
struct Panel {
    across: &'static str,
    error: Quantity,
    up: &'static str,
    cost: Quantity,
}

const fn panel(across: &'static str, error: Quantity, up: &'static str, cost: Quantity) -> Panel {
    Panel {
        across,
        error,
        up,
        cost,
    }
}

const TIME: &str = "time (s)";
const END: &str = "error of the state at the end";
const PANELS: [Panel; 4] = [
    panel(END, |row| row.end_error, TIME, |row| row.seconds),
    panel(
        "error of impact times (drive periods)",
        |row| row.impact_time_error,
        TIME,
        |row| row.seconds,
    ),
    panel(
        "error of before-impact velocities",
        |row| row.impact_velocity_error,
        TIME,
        |row| row.seconds,
    ),
    panel(
        END,
        |row| row.end_error,
        "evaluations of the force",
        |row| row.evaluations.map(|count| count as f64),
    ),
];

/// The work-precision diagram of a scene.
pub struct PrecisionChart<'a> {
    report: &'a SceneReport,
    curves: Vec<Curve<'a>>,
}

/// The runs of a method.
struct Curve<'a> {
    rows: &'a [Row],
    look: Look,
}

impl<'a> PrecisionChart<'a> {
    /// The diagram of a report; methods look like this, in the report's order.
    pub fn new(report: &'a SceneReport, looks: Vec<Look>) -> Self {
        let runs = report.rows.chunk_by(|a, b| a.method == b.method);
        let curves = runs.zip(looks).map(|(rows, look)| Curve { rows, look });
        Self {
            report,
            curves: curves.collect(),
        }
    }

    /// The diagram as an SVG document.
    pub fn svg(&self) -> String {
        let plots = PANELS.iter().map(|panel| self.plots(panel)).collect();
        let layouts = PANELS.iter().map(|panel| self.layout(panel)).collect();
        let title = format!(
            "{}: {}, {} drive periods",
            self.report.scene, self.report.title, self.report.periods
        );
        let figure = Figure::new(2, 2)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_title(title)
            .with_cell_size(520.0, 400.0)
            .with_shared_legend_right_top()
            .with_shared_legend_entries(self.legend());
        SvgBackend::new().render_scene(&figure.render())
    }

    /// Lines below, markers above them, the exact method on top.
    fn plots(&self, panel: &Panel) -> Vec<Plot> {
        let lines = self.curves.iter().map(|curve| curve.line(panel));
        let others = self.curves.iter().skip(1);
        let markers = others.chain(self.curves.first());
        lines
            .chain(markers.flat_map(|curve| curve.markers(panel)))
            .collect()
    }

    fn layout(&self, panel: &Panel) -> Layout {
        let points: Vec<(f64, f64)> = self
            .curves
            .iter()
            .flat_map(|curve| curve.points(panel, |_| true))
            .collect();
        let x = decades(points.iter().map(|point| point.0), (-3.0, 0.0));
        let y = decades(points.iter().map(|point| point.1), (-3.0, 0.0));
        style::plain(x, y)
            .with_x_label(panel.across)
            .with_y_label(panel.up)
            .with_x_tick_step(2.0)
            .with_y_tick_step(1.0)
            .with_x_tick_format(raised())
            .with_y_tick_format(raised())
    }

    fn legend(&self) -> Vec<LegendEntry> {
        let mut entries: Vec<LegendEntry> = self.curves.iter().map(Curve::entry).collect();
        entries.push(LegendEntry {
            label: "hollow circles: wrong number of impacts".to_owned(),
            color: "none".to_owned(),
            shape: LegendShape::Rect,
            dasharray: None,
        });
        entries
    }
}

impl Curve<'_> {
    const fn style(&self) -> (&'static str, MarkerShape) {
        LOOKS[self.look.scheme % LOOKS.len()]
    }

    /// Powers of ten of error and cost of the runs that have both.
    fn points(&self, panel: &Panel, which: impl Fn(&Row) -> bool) -> Vec<(f64, f64)> {
        let rows = self.rows.iter().filter(|row| which(row));
        rows.filter_map(|row| {
            let (error, cost) = ((panel.error)(row)?, (panel.cost)(row)?);
            let error = error.log10().clamp(FLOOR, CEILING);
            (cost > 0.0).then(|| (error, cost.log10()))
        })
        .collect()
    }

    fn line(&self, panel: &Panel) -> Plot {
        let line = if self.look.blind {
            LineStyle::Dashed
        } else {
            LineStyle::Solid
        };
        Plot::Line(
            LinePlot::new()
                .with_data(self.points(panel, |_| true))
                .with_color(self.style().0)
                .with_stroke_width(1.3)
                .with_line_style(line),
        )
    }

    /// The scheme's own where the number of impacts is right, else hollow circles.
    fn markers(&self, panel: &Panel) -> [Plot; 2] {
        let (color, shape) = self.style();
        let size = if self.look.scheme == 0 { 9.0 } else { 4.0 };
        let is_right = |row: &Row| row.impact_difference == Some(0);
        let plot = ScatterPlot::new().with_color(color).with_size(size);
        let right = plot.clone().with_marker(shape);
        let wrong = plot.with_marker_opacity(0.0).with_marker_stroke_width(1.2);
        [
            Plot::Scatter(right.with_data(self.points(panel, is_right))),
            Plot::Scatter(wrong.with_data(self.points(panel, |row| !is_right(row)))),
        ]
    }

    fn entry(&self) -> LegendEntry {
        let (color, shape) = self.style();
        let name = self.rows.first().map_or("", |row| row.method.as_str());
        let failed = self
            .rows
            .iter()
            .filter(|row| row.status == "failed")
            .count();
        let label = match failed {
            0 => name.to_owned(),
            _ => format!("{name} ({failed} of {} failed)", self.rows.len()),
        };
        let (shape, dasharray) = if self.look.blind {
            (LegendShape::Line, LineStyle::Dashed.dasharray())
        } else {
            (LegendShape::Marker(shape), None)
        };
        LegendEntry {
            label,
            color: color.to_owned(),
            shape,
            dasharray,
        }
    }
}

/// The whole decades around powers of ten; `empty` if there are none.
fn decades(powers: impl Iterator<Item = f64> + Clone, empty: (f64, f64)) -> (f64, f64) {
    let low = powers.clone().fold(f64::INFINITY, f64::min);
    let high = powers.fold(f64::NEG_INFINITY, f64::max);
    if low > high {
        return empty;
    }
    ((low - 0.2).floor(), (high + 0.2).ceil())
}

/// 10 with the tick as a raised exponent.
fn raised() -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(|power: f64| {
        power_of_ten(power.round_ties_even() as i32)
    }))
}
