//! The basin of z = 1 along the zone.

use softstop::{Dimension, Parameter};
use softstop_console::row;
use softstop_console::sheet::Sheet;
use softstop_draw::{Axis, Layer, Panel, Stroke, style};
use softstop_dynamics::basin::ErosionProfile;

use crate::design::figure::Figure as Quantity;
use crate::design::trial::STARTS;
use crate::design::{Design, Problem};
use crate::limits::end_name;
use crate::page::figure::{AT, BESIDE, DESIGN, Figure, HALF, Section};
use crate::page::words::quantity;

const REQUIRED: Stroke = Stroke::dashed(style::ASIDE, 1.6, (3.0, 3.0));

/// The picture.
pub(super) fn erosion(problem: &Problem, design: &Design, profile: &ErosionProfile) -> Figure {
    let machine = &design.machine;
    let places = || profile.places.iter();
    let sure = places().map(|it| {
        (
            it.place,
            it.certainty.interval.map(|end| end.clamp(0.0, 1.0)),
        )
    });
    let mut requirements = problem.requirements.iter();
    let required = requirements.find(|it| it.figure == Quantity::Certainty);
    let required = required.and_then(|it| it.least);
    let required = required.map(|it| Layer::horizontal(it, REQUIRED, "").named("share required"));
    let shares = Layer::line(places().map(|it| (it.place, it.certainty.share)), DESIGN);
    let integrity = Layer::line(places().map(|it| (it.place, it.radius)), BESIDE);
    let layers = [Layer::band(sure, style::DESIGN, 0.2)].into_iter();
    let layers = layers.chain(required).chain([
        Layer::vertical(design.place, AT, "design"),
        shares.named("share of starts"),
        integrity.named("local integrity measure"),
    ]);
    let axis = match design.zone.begins_at_g0() {
        true => format!(
            "place s in the zone: 0 at g₀, 1 at {}",
            end_name(&design.zone.high)
        ),
        false => "place s in the range of stable z = 1".to_owned(),
    };
    let x = Axis::new(axis).range((0.0, 1.0));
    let y = Axis::new("share, integrity measure").range((0.0, 1.02));
    let panel = Panel::new(x, y, layers);
    let ends = |dimension, ends: [f64; 2]| {
        let [low, high] = ends.map(|end| machine.to_own(dimension, end));
        let (low, high) = (quantity(low, ""), quantity(high, machine.unit(dimension)));
        format!("{low} to {high}")
    };
    let widened = match profile.widened {
        true => ", made wider to hold all motions of the zone",
        false => "",
    };
    let caption = format!(
        "Share of the initial states that lead to the z = 1 motion of the design's zone, with its 95 % interval, and its local integrity \
         measure: the radius of the largest ball about the motion inside its basin. Starts: {STARTS} at each place, in the box that \
         commands take starts from{widened}: positions {}, velocities {}.",
        ends(Dimension::Length, profile.region.position),
        ends(Dimension::Velocity, profile.region.velocity)
    );
    let rows = places().map(|it| {
        let [low, high] = it.certainty.interval;
        let frequency = machine.to_own(Dimension::Frequency, it.frequency);
        row![
            it.place,
            frequency,
            it.certainty.share,
            low,
            high,
            it.radius
        ]
    });
    let frequency = machine.label_of(Parameter::Frequency);
    let heads = [
        "place",
        &frequency,
        "share",
        "share_low",
        "share_high",
        "integrity",
    ];
    let title = "The basin along the zone";
    Figure::new(Section::Motion, HALF, title, [panel], caption)
        .with([Sheet::new("erosion", heads, rows)])
}
