//! The before-impact velocity over the drive's frequency.

use softstop_draw::{Layer, Mark, Panel, style};

use super::{axis, line};
use crate::page::data::{Response, Role};
use crate::page::figure::{BOUND, Figure, WIDE, bounds};
use crate::page::words::quantity;

/// Half the size of the design's mark.
const MARK: f64 = 8.0;
/// Opacity of machines within the tolerances, and of the tolerance of the frequency.
const BAND: f64 = 0.35;
const ALLOWED: f64 = 0.3;

/// The picture.
pub(in crate::page) fn figure(response: &Response) -> Figure {
    let mut layers = Vec::new();
    layers.extend(response.tolerance.map(|ends| {
        let whole = (f64::NEG_INFINITY, f64::INFINITY);
        let allowed = Layer::boxes([[ends.into(), whole]], style::ALLOWED, ALLOWED);
        allowed.named("tolerance of the frequency")
    }));
    layers.extend(response.bands.iter().map(|band| {
        let inside = |it: &&[f64; 3]| it.iter().all(|value| value.is_finite());
        let band = band.iter().filter(inside);
        let band = band.map(|[x, low, high]| (*x, [*low, *high]));
        Layer::band(band, style::OPTIMUM, BAND).named("within the tolerances")
    }));
    layers.extend(bounds(&response.ends, BOUND));
    for role in [Role::Unstable, Role::Beside, Role::Design] {
        let curves = response.curves.iter().filter(|curve| curve.role == role);
        layers.extend(curves.map(line));
    }
    let [x, y] = response.design;
    let design = Layer::marks([(x, y)], Mark::Triangle, style::OPTIMUM);
    layers.push(design.sized(MARK).named("design"));
    let panel = Panel {
        x: axis(&response.x),
        y: axis(&response.y).from(0.0),
        layers,
        ..Panel::default()
    };
    let title = format!(
        "{} over the {}",
        "How hard the mass strikes", response.x.name
    );
    let mut caption = format!(
        "The design runs at {} and strikes with {}.",
        quantity(x, &response.x.unit),
        quantity(y, &response.y.unit)
    );
    let away = response.ends.iter().map(|(name, at)| {
        let away = 100.0 * (at / x - 1.0);
        let side = if away < 0.0 { "below" } else { "above" };
        format!("{name} lies {:.1} % {side} that frequency", away.abs())
    });
    for away in away {
        caption += &format!(" {away}.");
    }
    if response.machines > 0 {
        caption += &format!(
            " The band reaches from the least to the greatest velocity of {} machines at the corners of the tolerances, that \
             of the frequency apart, and ends where the first of them has no such motion.",
            response.machines
        );
    }
    Figure::new(WIDE, title, [panel], caption)
}
