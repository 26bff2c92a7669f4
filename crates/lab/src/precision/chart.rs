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

/// What a panel draws over what: the name of an error, the error, the name of a cost, the cost.
type Panel = (&'static str, Quantity, &'static str, Quantity);

const END: &str = "error of the state at the end";
const SECONDS: Quantity = |row| row.seconds;
const PANELS: [Panel; 4] = [
    (END, |row| row.end_error, "time (s)", SECONDS),
    (
        "error of impact times (drive periods)",
        |row| row.impact_time_error,
        "time (s)",
        SECONDS,
    ),
    (
        "error of before-impact velocities",
        |row| row.impact_velocity_error,
        "time (s)",
        SECONDS,
    ),
    (
        END,
        |row| row.end_error,
        "evaluations of the force",
        |row| row.evaluations.map(|count| count as f64),
    ),
];

/// The runs of a method.
struct Curve<'a> {
    rows: &'a [Row],
    look: Look,
}

/// The diagram of a report as an SVG document; methods look like this, in the report's order.
pub(super) fn svg(report: &SceneReport, looks: impl Iterator<Item = Look>) -> String {
    let runs = report.rows.chunk_by(|a, b| a.method == b.method);
    let curves = runs.zip(looks).map(|(rows, look)| Curve { rows, look });
    let curves: Vec<Curve<'_>> = curves.collect();
    let plots = PANELS.iter().map(|panel| plots(panel, &curves)).collect();
    let layouts = PANELS.iter().map(|panel| layout(panel, &curves)).collect();
    let mut entries: Vec<LegendEntry> = curves.iter().map(Curve::entry).collect();
    entries.push(LegendEntry {
        label: "hollow circles: wrong number of impacts".to_owned(),
        color: "none".to_owned(),
        shape: LegendShape::Rect,
        dasharray: None,
    });
    let (scene, title, periods) = (&report.scene, &report.title, report.periods);
    let figure = Figure::new(2, 2)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_title(format!("{scene}: {title}, {periods} drive periods"))
        .with_cell_size(520.0, 400.0)
        .with_shared_legend_right_top()
        .with_shared_legend_entries(entries);
    SvgBackend::new().render_scene(&figure.render())
}

/// Lines below, markers above them, the exact method on top.
fn plots(panel: &Panel, curves: &[Curve<'_>]) -> Vec<Plot> {
    let lines = curves.iter().map(|curve| curve.line(panel));
    let markers = curves.iter().skip(1).chain(curves.first());
    let markers = markers.flat_map(|curve| curve.markers(panel));
    lines.chain(markers).collect()
}

fn layout(panel: &Panel, curves: &[Curve<'_>]) -> Layout {
    let points = curves
        .iter()
        .flat_map(|curve| curve.points(panel, |_| true));
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    style::plain(decades(&x), decades(&y))
        .with_x_label(panel.0)
        .with_y_label(panel.2)
        .with_x_tick_step(2.0)
        .with_y_tick_step(1.0)
        .with_x_tick_format(raised())
        .with_y_tick_format(raised())
}

impl Curve<'_> {
    const fn style(&self) -> (&'static str, MarkerShape) {
        LOOKS[self.look.scheme % LOOKS.len()]
    }

    const fn line_style(&self) -> LineStyle {
        match self.look.blind {
            true => LineStyle::Dashed,
            false => LineStyle::Solid,
        }
    }

    /// Powers of ten of error and cost of the runs that have both.
    fn points(&self, panel: &Panel, which: impl Fn(&Row) -> bool) -> Vec<(f64, f64)> {
        let rows = self.rows.iter().filter(|row| which(row));
        let point = |row: &Row| {
            let (error, cost) = ((panel.1)(row)?, (panel.3)(row)?);
            let error = error.log10().clamp(FLOOR, CEILING);
            (cost > 0.0).then(|| (error, cost.log10()))
        };
        rows.filter_map(point).collect()
    }

    fn line(&self, panel: &Panel) -> Plot {
        let line = LinePlot::new().with_data(self.points(panel, |_| true));
        let line = line.with_color(self.style().0).with_stroke_width(1.3);
        Plot::Line(line.with_line_style(self.line_style()))
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
        let all = self.rows.len();
        let failed = self.rows.iter().filter(|row| row.status == "failed");
        let label = match failed.count() {
            0 => name.to_owned(),
            failed => format!("{name} ({failed} of {all} failed)"),
        };
        LegendEntry {
            label,
            color: color.to_owned(),
            shape: match self.look.blind {
                true => LegendShape::Line,
                false => LegendShape::Marker(shape),
            },
            dasharray: self.line_style().dasharray(),
        }
    }
}

/// The whole decades around powers of ten; three if there are none.
fn decades(powers: &[f64]) -> (f64, f64) {
    let low = powers.iter().copied().fold(f64::INFINITY, f64::min);
    let high = powers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    match low > high {
        true => (-3.0, 0.0),
        false => ((low - 0.2).floor(), (high + 0.2).ceil()),
    }
}

/// 10 with the tick as a raised exponent.
fn raised() -> TickFormat {
    TickFormat::Custom(std::sync::Arc::new(|power: f64| {
        power_of_ten(power.round_ties_even() as i32)
    }))
}
