//! Data as pictures, one file for each kind.

pub(super) mod basin;
pub(super) mod effects;
pub(super) mod erosion;
pub(super) mod front;
pub(super) mod histogram;
pub(super) mod map;
pub(super) mod portrait;
pub(super) mod response;

use softstop_draw::{Axis, Layer, Stroke, style};

use super::data::{Curve, Label, Role};
use super::figure::points;

/// How a line is drawn, by what it is.
const fn stroke(role: Role) -> Stroke {
    match role {
        Role::Design => Stroke::solid(style::DESIGN, 2.5),
        Role::Unstable => Stroke::dashed(style::ASIDE, 1.6, (3.0, 3.0)),
        Role::Beside => Stroke::dashed(style::REFERENCE, 2.5, (9.0, 4.0)),
        Role::Grazing => Stroke::solid(style::INK, 1.6),
        Role::Fold => Stroke::dashed(style::INK, 1.6, (9.0, 4.0)),
        Role::Flip => Stroke::dashed(style::INK, 1.6, (2.0, 3.0)),
    }
}

/// A curve as what it is.
fn line(curve: &Curve) -> Layer {
    Layer::line(points(&curve.points), stroke(curve.role)).named(&curve.name)
}

/// An axis of this name.
fn axis(label: &Label) -> Axis {
    Axis::new(label.line())
}
