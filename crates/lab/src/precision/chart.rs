//! The work-precision diagram: what each method's accuracy costs.

use softstop_draw::{Axis, Chart, Layer, Mark, Panel, Sign, Stroke, style};

use crate::precision::family::Look;
use crate::precision::measure::Row;
use crate::precision::report::SceneReport;

/// Half the size of marks.
const MARK: f64 = 4.5;

/// Colour and mark of each scheme: the colour says of which kind it is.
const LOOKS: [(&str, Mark); 13] = [
    (style::POINT, Mark::Diamond),
    (style::ALLOWED, Mark::Circle),
    (style::ALLOWED, Mark::Square),
    (style::DESIGN, Mark::Triangle),
    ("#009E73", Mark::Circle),
    ("#009E73", Mark::Square),
    ("#009E73", Mark::Diamond),
    ("#882255", Mark::Triangle),
    (style::OPTIMUM, Mark::Circle),
    (style::OPTIMUM, Mark::Square),
    (style::OPTIMUM, Mark::Diamond),
    (style::REFERENCE, Mark::Circle),
    (style::REFERENCE, Mark::Triangle),
];

/// Errors below and above these are drawn at the edge.
const ERRORS: (f64, f64) = (1e-17, 10.0);

/// The runs of a method.
struct Curve<'a> {
    rows: &'a [Row],
    look: Look,
}

/// The diagram of a report as an SVG document; methods look like this, in the report's order.
pub(super) fn svg(report: &SceneReport, looks: impl Iterator<Item = Look>) -> String {
    let runs = report.rows.chunk_by(|a, b| a.method == b.method);
    let curves = runs.zip(looks).map(|(rows, look)| Curve { rows, look });
    let mut curves: Vec<Curve<'_>> = curves.collect();
    let points = curves.iter().flat_map(|curve| curve.points(|_| true));
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let mut layers: Vec<Layer> = curves.iter().flat_map(Curve::key).collect();
    let hollow = Sign::Mark(Mark::Hollow, style::INK);
    layers.push(Layer::key(hollow, "wrong number of impacts"));
    // What ignores events lies below, the exact method on top.
    curves.sort_by_key(|curve| (curve.look.scheme == 0, !curve.look.blind));
    layers.extend(curves.iter().flat_map(Curve::layers));
    let across = "worst error of end, impact times and before-impact velocities";
    let panel = Panel {
        size: (640.0, 456.0),
        x: Axis::new(across).log().range(decades(&x)),
        y: Axis::new("time of a run (s)").log().range(decades(&y)),
        layers,
        ..Panel::default()
    };
    let (title, periods) = (&report.title, report.periods);
    let chart = Chart {
        subtitle: format!("{title}, {periods} drive periods; lower left is better"),
        letters: 13,
        ..Chart::new(&report.scene, [panel])
    };
    chart.svg()
}

impl Curve<'_> {
    /// Its colour and its mark.
    fn look(&self) -> (&'static str, Mark) {
        let (color, mark) = LOOKS[self.look.scheme % LOOKS.len()];
        match self.look.blind {
            true => ("#AAAAAA", mark),
            false => (color, mark),
        }
    }

    fn stroke(&self) -> Stroke {
        match self.look.blind {
            true => Stroke::dashed(self.look().0, 1.2, (5.0, 4.0)),
            false => Stroke::solid(self.look().0, 1.6),
        }
    }

    fn name(&self) -> String {
        let name = self.rows.first().map_or("", |row| row.method.as_str());
        let failed = self.rows.iter().filter(|row| row.status == "failed");
        match failed.count() {
            0 => name.to_owned(),
            failed => format!("{name} ({failed} of {} failed)", self.rows.len()),
        }
    }

    /// Its entry in the legend.
    fn key(&self) -> impl Iterator<Item = Layer> {
        let (color, mark) = self.look();
        let line = (self.rows.len() > 1).then(|| Sign::Line(self.stroke()));
        let signs = line.into_iter().chain([Sign::Mark(mark, color)]);
        signs.map(|sign| Layer::key(sign, self.name()))
    }

    /// Error and time of the runs that have both.
    fn points(&self, which: impl Fn(&Row) -> bool) -> Vec<(f64, f64)> {
        let rows = self.rows.iter().filter(|row| which(row));
        let point = |row: &Row| {
            let (error, time) = (row.worst_error()?, row.seconds?);
            (time > 0.0).then(|| (error.clamp(ERRORS.0, ERRORS.1), time))
        };
        rows.filter_map(point).collect()
    }

    /// Its line, and the scheme's own mark where the number of impacts is right, else a hollow circle.
    fn layers(&self) -> [Layer; 3] {
        let ((color, mark), half) = match (self.look.scheme, self.look.blind) {
            (0, _) => (self.look(), 2.0 * MARK),
            (_, true) => (self.look(), 0.7 * MARK),
            _ => (self.look(), MARK),
        };
        let is_right = |row: &Row| row.impact_difference == Some(0);
        [
            Layer::line(self.points(|_| true), self.stroke()),
            Layer::marks(self.points(is_right), mark, color).sized(half),
            Layer::marks(self.points(|row| !is_right(row)), Mark::Hollow, color).sized(MARK - 0.8),
        ]
    }
}

/// The whole decades around values; three if there are none.
fn decades(values: &[f64]) -> (f64, f64) {
    let powers = || values.iter().map(|value| value.log10());
    let low = powers().fold(f64::INFINITY, f64::min);
    let high = powers().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = match low > high {
        true => (-3.0, 0.0),
        false => ((low - 0.2).floor(), (high + 0.2).ceil()),
    };
    (10f64.powf(low), 10f64.powf(high))
}
