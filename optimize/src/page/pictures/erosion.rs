//! The basin of z = 1 along the zone.

use softstop_draw::{Axis, Layer, Panel, Stroke, style};

use crate::page::data::Erosion;
use crate::page::figure::{Figure, HALF};

const SHARE: Stroke = Stroke::solid(style::DESIGN, 2.5);
const INTEGRITY: Stroke = Stroke::dashed(style::REFERENCE, 2.5, (9.0, 4.0));
const REQUIRED: Stroke = Stroke::dashed(style::ASIDE, 1.6, (3.0, 3.0));
const DESIGN: Stroke = Stroke::dashed(style::OPTIMUM, 1.6, (5.0, 4.0));

/// The picture.
pub(in crate::page) fn figure(erosion: &Erosion) -> Figure {
    let points = || erosion.points.iter().filter(|it| it.share.is_finite());
    let sure = points().map(|it| (it.place, it.interval.map(|end| end.clamp(0.0, 1.0))));
    let required = erosion
        .required
        .map(|it| Layer::horizontal(it, REQUIRED, "").named("share required"));
    let design = erosion
        .design
        .map(|place| Layer::vertical(place, DESIGN, "design"));
    let integrity = points().filter_map(|it| Some((it.place, it.integrity?)));
    let integrity: Vec<(f64, f64)> = integrity.collect();
    let has_integrity = !integrity.is_empty();
    let integrity = Layer::line(integrity, INTEGRITY).named("integrity");
    let shares = Layer::line(points().map(|it| (it.place, it.share)), SHARE);
    let layers = std::iter::once(Layer::band(sure, style::DESIGN, 0.2))
        .chain(required)
        .chain(design)
        .chain([shares.named("share of starts")])
        .chain(has_integrity.then_some(integrity));
    let panel = Panel {
        x: Axis::new("place s in the zone: 0 at g₀, 1 at s_SN").range((0.0, 1.0)),
        y: Axis::new("share, integrity").range((0.0, 1.02)),
        layers: layers.collect(),
        ..Panel::default()
    };
    let starts = match erosion.starts.as_str() {
        "" => String::new(),
        starts => format!(" Starts: {starts}."),
    };
    let caption = format!(
        "Share of the initial states that lead to the design's kind of motion, with its 95 % interval, and the radius of \
         the largest ball about the motion inside its basin.{starts}"
    );
    Figure::new(HALF, "The basin along the zone", [panel], caption)
}
