//! The work-precision diagram: what each method's accuracy costs.

use softstop_draw::style::{self, method};
use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Sign, Stroke, around};

use crate::precision::family::{Look, short_name};
use crate::precision::measure::Row;
use crate::precision::report::SceneMeasurement;

/// What ignores events.
const BLIND: Stroke = Stroke::dashed(method::BLIND, 1.2, (5.0, 4.0));
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

/// The diagram of what was measured; methods look like this, in the order of the rows.
pub(super) fn chart(measured: &SceneMeasurement<'_>, looks: impl Iterator<Item = Look>) -> Chart {
    let runs = measured.rows.chunk_by(|a, b| a.method == b.method);
    let curves = runs.zip(looks).map(|(rows, look)| Curve { rows, look });
    let mut curves: Vec<Curve<'_>> = curves.collect();
    let points = curves.iter().flat_map(|curve| curve.points(|_| true));
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let keys = [
        (Sign::Line(BLIND), "events ignored"),
        (
            Sign::Mark(Mark::Hollow, style::INK),
            "wrong number of impacts",
        ),
    ];
    let mut layers: Vec<Layer> = keys.map(|(sign, name)| Layer::key(sign, name)).into();
    layers.extend(curves.iter().filter_map(Curve::label));
    // What ignores events lies below, the exact method on top.
    curves.sort_by_key(|curve| (curve.look.scheme == 0, !curve.look.blind));
    layers.extend(curves.iter().flat_map(Curve::layers));
    let across = "worst error of end, impact times and velocities";
    let x = Axis::new(across).log().range(decades(&x));
    let y = Axis::new("time of a run (s)").log().range(decades(&y));
    let panel = Panel::new(x, y, layers).sized((500.0, 440.0));
    let (title, periods) = (&measured.case.title, measured.case.periods);
    Chart {
        subtitle: format!("{title}, {periods} drive periods; lower left is better"),
        legend: Legend::Below,
        ..Chart::new(&measured.case.name, [panel])
    }
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
            true => BLIND,
            false => Stroke::solid(self.look().0, 1.6),
        }
    }

    /// The scheme's name where it is most accurate.
    fn label(&self) -> Option<Layer> {
        let name = short_name(&self.rows.first()?.method);
        let points = self.points(|_| !self.look.blind).into_iter();
        let best = points.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Layer::label(best, name))
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
