//! How often a velocity occurs among machines within the tolerances.

use softstop::Dimension;
use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Panel, style};

use crate::design::Design;
use crate::optimize::study::ToleranceStudy;
use crate::page::figure::{AT, Figure, HALF, Section, bounds};
use crate::page::words::{count, quantity};

/// Bars of the histogram.
const BARS: usize = 40;

/// The picture.
pub(super) fn histogram(design: &Design, study: &ToleranceStudy) -> Figure {
    let machine = &design.machine;
    let own = |value: f64| machine.to_own(Dimension::Velocity, value);
    let bins = study.verdict.histogram(BARS);
    let ends = bins
        .iter()
        .map(|(ends, machines)| (ends.map(own), *machines as u64));
    let counted = bins.iter().map(|it| it.1).sum::<usize>().max(1) as f64;
    let bars = ends.clone();
    let bars =
        bars.map(|([low, high], count)| [(low, high), (0.0, 100.0 * count as f64 / counted)]);
    let nominal = own(design.before_impact_velocity());
    let worst = own(study.slowest(None));
    let marks = [("design", nominal), ("worst", worst)];
    let marks = bounds(&marks, AT);
    let x = machine.label("before-impact velocity", "", Dimension::Velocity);
    let y = Axis::new("machines in each bar (%)").from(0.0);
    let bars = [Layer::boxes(bars, style::ALLOWED, 1.0)].into_iter();
    let panel = Panel::new(Axis::new(&x), y, bars.chain(marks));
    let lost = match study.verdict.drawing.lost {
        0 => "none of them loses the motion".to_owned(),
        1 => "one of them loses the motion".to_owned(),
        lost => format!("{} of them lose the motion", count(lost as u64)),
    };
    let unit = machine.unit(Dimension::Velocity);
    let caption = format!(
        "{} machines drawn from the tolerances: {lost}. The design has {}, the worst within the tolerances {}.",
        count(study.verdict.machines as u64),
        quantity(nominal, unit),
        quantity(worst, unit)
    );
    let rows = ends.map(|([low, high], count)| row![low, high, count]);
    let heads = [
        format!("from: {x}"),
        format!("to: {x}"),
        "machines".to_owned(),
    ];
    let title = "The machines as they will be built";
    Figure::new(Section::Tolerances, HALF, title, [panel], caption).with([Sheet::new(
        "histogram",
        heads,
        rows,
    )])
}
