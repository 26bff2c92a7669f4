//! What more of one good costs of another.

use softstop_draw::{Layer, Mark, Panel, Stroke, style};

use super::axis;
use crate::page::data::Front;
use crate::page::figure::{Figure, HALF, points};
use crate::page::words::capital;

const LINED: Stroke = Stroke::solid(style::DESIGN, 1.6);

/// The picture.
pub(in crate::page) fn figure(front: &Front) -> Figure {
    let marks = Layer::marks(points(&front.points), Mark::Circle, style::DESIGN);
    let mut layers = vec![
        Layer::line(points(&front.points), LINED),
        marks.sized(3.5).named("best designs"),
    ];
    layers.extend(front.design.map(|design| {
        let mark = Layer::marks([design.into()], Mark::Triangle, style::OPTIMUM);
        mark.sized(8.0).named("this design")
    }));
    let panel = Panel {
        x: axis(&front.x),
        y: axis(&front.y),
        layers,
        ..Panel::default()
    };
    let caption = format!(
        "Each point is a design that cannot be bettered in one of the two without loss in the other. {}",
        front.note
    );
    let caption = caption.trim_end().to_owned();
    Figure::new(HALF, capital(&front.title), [panel], caption)
}
