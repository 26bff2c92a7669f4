//! How certainly z = 1 establishes itself along the hysteresis zone.

use softstop::{Dimension, Machine, Parameter};
use softstop_draw::{Axis, Chart, Layer, Panel, Stroke, style};
use softstop_dynamics::basin::CertaintyAtPlace;

/// Values upwards: a share, with room for the line at one.
pub const SHARES: (f64, f64) = (0.0, 1.02);

/// The band of the intervals, and the line of the certainty, over a place of the zone.
pub fn layers(
    places: &[CertaintyAtPlace],
    across: impl Fn(&CertaintyAtPlace) -> f64,
    stroke: Stroke,
) -> [Layer; 2] {
    let sure = places.iter().map(|place| (across(place), place.interval));
    let line = places.iter().map(|place| (across(place), place.certainty));
    [
        Layer::band(sure, stroke.color, 0.25),
        Layer::line(line, stroke),
    ]
}

/// The certainty of z = 1 along the hysteresis zone of one machine, as an SVG document.
pub fn chart(machine: &Machine, places: &[CertaintyAtPlace], title: &str) -> String {
    let across = |place: &CertaintyAtPlace| machine.to_own(Dimension::Frequency, place.frequency);
    let stroke = Stroke::solid(style::DESIGN, 2.2);
    let frequency = machine.label_of(Parameter::Frequency);
    let x = Axis::new(format!("{frequency}, from g₀ to s_SN"));
    let y = Axis::new("establishing certainty of z = 1").range(SHARES);
    let panel = Panel::new(x, y, layers(places, across, stroke)).sized((780.0, 400.0));
    let what = "share of initial states that lead to z = 1, with 95 % interval";
    let chart = Chart {
        subtitle: what.to_owned(),
        ..Chart::new(title, [panel])
    };
    chart.svg()
}
