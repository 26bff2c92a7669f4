//! How often a value occurs among machines within the tolerances.

use softstop_draw::{Axis, Layer, Panel, Stroke, style};

use super::axis;
use crate::page::data::Histogram;
use crate::page::figure::{Figure, HALF, bounds};
use crate::page::words::{count, quantity};

const AT: Stroke = Stroke::dashed(style::OPTIMUM, 1.8, (5.0, 4.0));

/// The picture.
pub(in crate::page) fn figure(histogram: &Histogram) -> Figure {
    let mut marks = vec![("design".to_owned(), histogram.nominal)];
    marks.extend(histogram.worst.map(|worst| ("worst".to_owned(), worst)));
    let [low, high] = histogram.range;
    let step = (high - low) / histogram.counts.len().max(1) as f64;
    let all = histogram.counts.iter().sum::<u64>().max(1) as f64;
    let bars = histogram.counts.iter().enumerate().map(|(index, count)| {
        let ends = [index, index + 1].map(|edge| low + step * edge as f64);
        [ends.into(), (0.0, 100.0 * *count as f64 / all)]
    });
    let bars = Layer::boxes(bars, style::ALLOWED, 1.0);
    let panel = Panel {
        x: axis(&histogram.x),
        y: Axis::new("machines in each bar (%)").from(0.0),
        layers: std::iter::once(bars).chain(bounds(&marks, AT)).collect(),
        ..Panel::default()
    };
    let unit = &histogram.x.unit;
    let lost = match histogram.lost {
        0 => "none of them loses the motion".to_owned(),
        1 => "one of them loses the motion".to_owned(),
        lost => format!("{} of them lose the motion", count(lost)),
    };
    let worst = histogram.worst.map_or(String::new(), |worst| {
        format!(
            ", the worst within the tolerances {}",
            quantity(worst, unit)
        )
    });
    let caption = format!(
        "{} machines drawn from the tolerances: {lost}. The design has {}{worst}.",
        count(histogram.samples),
        quantity(histogram.nominal, unit)
    );
    Figure::new(HALF, "The machines as they will be built", [panel], caption)
}
