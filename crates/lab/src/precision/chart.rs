//! The work-precision diagram: what each method's accuracy costs.

use softstop_draw::style::{self, method};
use softstop_draw::{Axis, Chart, Layer, Mark, Panel, Sign, Stroke, around};

use crate::precision::family::Look;
use crate::precision::measure::Row;
use crate::precision::report::SceneReport;

/// Half the size of marks.
const MARK: f64 = 4.5;
/// Errors below and above which they are drawn at the edge.
const ERRORS: (f64, f64) = (1e-17, 10.0);

/// Colour and mark of each scheme: the colour says of which kind it is.
const LOOKS: [(&str, Mark); 13] = [
    (method::EXACT, Mark::Diamond),
    (method::FIRST_ORDER, Mark::Circle),
    (method::FIRST_ORDER, Mark::Square),
    (method::RUNGE_KUTTA, Mark::Triangle),
    (method::IMPLICIT, Mark::Circle),
    (method::IMPLICIT, Mark::Square),
    (method::IMPLICIT, Mark::Diamond),
    (method::TIME_STEPPING, Mark::Triangle),
    (method::DIFFSOL, Mark::Circle),
    (method::DIFFSOL, Mark::Square),
    (method::DIFFSOL, Mark::Diamond),
    (method::DIFFERENTIAL_EQUATIONS, Mark::Circle),
    (method::DIFFERENTIAL_EQUATIONS, Mark::Triangle),
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
    let mut curves: Vec<Curve<'_>> = curves.collect();
    let points = curves.iter().flat_map(|curve| curve.points(|_| true));
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let wrong = Layer::key(
        Sign::Mark(Mark::Hollow, style::INK),
        "wrong number of impacts",
    );
    let mut layers: Vec<Layer> = curves.iter().flat_map(Curve::keys).chain([wrong]).collect();
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
    fn look(&self) -> (&'static str, Mark) {
        let (color, mark) = LOOKS[self.look.scheme % LOOKS.len()];
        (
            if self.look.blind {
                method::BLIND
            } else {
                color
            },
            mark,
        )
    }

    fn stroke(&self) -> Stroke {
        match self.look.blind {
            true => Stroke::dashed(method::BLIND, 1.2, (5.0, 4.0)),
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

    /// Its entry of the legend: a mark, on a line if there are several runs.
    fn keys(&self) -> impl Iterator<Item = Layer> {
        let (color, mark) = self.look();
        let line = (self.rows.len() > 1).then_some(Sign::Line(self.stroke()));
        let signs = line.into_iter().chain([Sign::Mark(mark, color)]);
        let name = self.name();
        signs.map(move |sign| Layer::key(sign, name.clone()))
    }

    /// Error and time of the runs that have both.
    fn points(&self, which: impl Fn(&Row) -> bool) -> Vec<(f64, f64)> {
        let rows = self.rows.iter().filter(|row| which(row));
        let point = |row: &Row| {
            let (error, time) = (row.worst_error()?, row.seconds?);
            (time > 0.0).then_some((error.clamp(ERRORS.0, ERRORS.1), time))
        };
        rows.filter_map(point).collect()
    }

    /// A line, with the scheme's own mark where the number of impacts is right, else a hollow circle.
    fn layers(&self) -> [Layer; 3] {
        let (color, mark) = self.look();
        let size = match (self.look.scheme, self.look.blind) {
            (0, _) => 2.0 * MARK,
            (_, true) => 0.7 * MARK,
            _ => MARK,
        };
        let points = |is_right| self.points(|row| (row.impact_difference == Some(0)) == is_right);
        [
            Layer::line(self.points(|_| true), self.stroke()),
            Layer::marks(points(true), mark, color).sized(size),
            Layer::marks(points(false), Mark::Hollow, color).sized(MARK),
        ]
    }
}

/// The whole decades around values; three if there are none.
fn decades(values: &[f64]) -> (f64, f64) {
    let (low, high) = around(values.iter().map(|value| value.log10()), 0.0);
    let (low, high) = match values.is_empty() {
        true => (-3.0, 0.0),
        false => ((low - 0.2).floor(), (high + 0.2).ceil()),
    };
    (10_f64.powf(low), 10_f64.powf(high))
}
