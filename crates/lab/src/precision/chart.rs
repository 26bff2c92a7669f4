//! The work-precision diagram: what each method's accuracy costs.

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::shapes::Mark;
use softstop_draw::style;

use crate::precision::family::Look;
use crate::precision::measure::Row;
use crate::precision::report::SceneReport;

/// The page, and the panel on it.
const PAGE: (f64, f64) = (1160.0, 600.0);
const AREA: Area = (76.0, 76.0, 640.0, 456.0);
/// Where the legend begins, the height of its rows, and the length of its lines.
const LEGEND: (f64, f64) = (740.0, 92.0);
const ROW: f64 = 22.0;
const SAMPLE: f64 = 34.0;
/// Letters of axes and legend.
const LETTERS: u32 = 13;
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

/// Powers of ten below and above which errors are drawn at the edge.
const ERRORS: (f64, f64) = (-17.0, 1.0);

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
    let panel = Panel::new(AREA, decades(&x), decades(&y));
    let mut pen = Pen::page(PAGE.0, PAGE.1);
    let (scene, title, periods) = (&report.scene, &report.title, report.periods);
    let words = format!("{title}, {periods} drive periods; lower left is better");
    heading(&mut pen, (AREA.0, 34.0), scene, &words);
    let across = Some("worst error of end, impact times and before-impact velocities");
    let axes = Axes {
        is_log: true,
        ..Axes::new(LETTERS, across, "time of a run (s)", (10, 8))
    };
    panel.ground(&mut pen, &axes);
    legend(&mut pen, &curves);
    // What ignores events lies below, the exact method on top.
    curves.sort_by_key(|curve| (curve.look.scheme == 0, !curve.look.blind));
    for curve in &curves {
        curve.draw(&mut pen, &panel);
    }
    panel.axes(&mut pen, &axes);
    pen.svg()
}

fn legend(pen: &mut Pen, curves: &[Curve<'_>]) {
    let (left, mut top) = LEGEND;
    for curve in curves {
        let middle = top - 0.36 * f64::from(LETTERS);
        if curve.rows.len() > 1 {
            pen.line(&[(left, middle), (left + SAMPLE, middle)], curve.stroke());
        }
        curve.mark(pen, (left + 0.5 * SAMPLE, middle), true);
        pen.text(
            (left + SAMPLE + 8.0, top),
            LETTERS,
            Align::Left,
            &curve.name(),
        );
        top += ROW;
    }
    let middle = top - 0.36 * f64::from(LETTERS);
    hollow(pen, (left + 0.5 * SAMPLE, middle), style::INK);
    let words = "wrong number of impacts";
    pen.text((left + SAMPLE + 8.0, top), LETTERS, Align::Left, words);
}

impl Curve<'_> {
    fn color(&self) -> &'static str {
        match self.look.blind {
            true => "#AAAAAA",
            false => LOOKS[self.look.scheme % LOOKS.len()].0,
        }
    }

    fn stroke(&self) -> Stroke {
        match self.look.blind {
            true => Stroke::dashed(self.color(), 1.2, (5.0, 4.0)),
            false => Stroke::solid(self.color(), 1.6),
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

    /// Powers of ten of error and time of the runs that have both.
    fn points(&self, which: impl Fn(&Row) -> bool) -> Vec<(f64, f64)> {
        let rows = self.rows.iter().filter(|row| which(row));
        let point = |row: &Row| {
            let (error, time) = (row.worst_error()?, row.seconds?);
            let error = error.log10().clamp(ERRORS.0, ERRORS.1);
            (time > 0.0).then(|| (error, time.log10()))
        };
        rows.filter_map(point).collect()
    }

    fn draw(&self, pen: &mut Pen, panel: &Panel) {
        panel.curve(pen, &self.points(|_| true), self.stroke());
        for is_right in [true, false] {
            let which = |row: &Row| (row.impact_difference == Some(0)) == is_right;
            for point in self.points(which) {
                self.mark(pen, panel.place(point), is_right);
            }
        }
    }

    /// The scheme's own mark where the number of impacts is right, else a hollow circle.
    fn mark(&self, pen: &mut Pen, place: (f64, f64), is_right: bool) {
        let half = match (self.look.scheme, self.look.blind) {
            (0, _) => 2.0 * MARK,
            (_, true) => 0.7 * MARK,
            _ => MARK,
        };
        match is_right {
            true => pen.mark(
                place,
                LOOKS[self.look.scheme % LOOKS.len()].1,
                half,
                self.color(),
            ),
            false => hollow(pen, place, self.color()),
        }
    }
}

fn hollow(pen: &mut Pen, place: (f64, f64), color: &str) {
    pen.mark(place, Mark::Circle, MARK, color);
    pen.mark(place, Mark::Circle, MARK - 1.5, "#FFFFFF");
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
