//! One period in the phase plane: the whole motion, and the part of it near the stop.

use softstop_draw::{Layer, Panel};

use super::{axis, line};
use crate::page::data::{Label, Portrait};
use crate::page::figure::{BOUND, Figure, WIDE, bounds};

/// How far before the first face the near part begins, in units of how far the mass goes beyond it, and how far it goes on
/// behind it.
const NEAR: (f64, f64) = (0.8, 0.15);

/// The picture.
pub(in crate::page) fn figure(portrait: &Portrait) -> Figure {
    let places = portrait.curves.iter().flat_map(|curve| &curve.points);
    let deepest = places.map(|it| it[0]).fold(f64::NEG_INFINITY, f64::max);
    let faces = portrait.faces.iter().map(|face| face.1);
    let first = faces.fold(f64::INFINITY, f64::min);
    let depth = deepest - first;
    let lines = || portrait.curves.iter().map(line);
    let unnamed = portrait
        .faces
        .iter()
        .map(|(_, at)| Layer::vertical(*at, BOUND, ""));
    let whole = Panel {
        x: axis(&portrait.x),
        y: axis(&portrait.y),
        layers: unnamed.chain(lines()).collect(),
        ..Panel::default()
    };
    let near = Label {
        name: format!("{}, near the stop", portrait.x.name),
        symbol: String::new(),
        unit: portrait.x.unit.clone(),
    };
    let near = (depth.is_finite() && depth > 0.0).then(|| Panel {
        x: axis(&near).range((first - NEAR.0 * depth, deepest + NEAR.1 * depth)),
        layers: bounds(&portrait.faces, BOUND).chain(lines()).collect(),
        ..whole.clone()
    });
    let caption = "Left the whole motion, right the same near the stop. The mass runs round clockwise: up on its way to the \
                   stop, down on its way back.";
    let title = "One period of the motion in the phase plane";
    Figure::new(WIDE, title, std::iter::once(whole).chain(near), caption)
}
