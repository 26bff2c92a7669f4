//! What each tolerance does to the velocity, as bars.

use softstop::{Dimension, Machine};
use softstop_draw::{Align, Axis, Layer, Panel, Stroke, style};

use crate::optimize::study::ToleranceStudy;
use crate::order::sort_falling;
use crate::page::figure::{Figure, HALF, Section};
use crate::page::words::quantity;

/// Height of a bar with its name, and how much of that the name takes and the bar.
const ROW: f64 = 42.0;
const NAME: f64 = 0.35;
const BAR: (f64, f64) = (0.48, 0.82);
/// Half of the width, in units of the longest bar, which leaves room for numbers.
const ROOM: f64 = 2.1;

/// The picture; the largest effect first.
pub(super) fn effects(machine: &Machine, study: &ToleranceStudy) -> Figure {
    let velocities = &study.sensitivities.velocity;
    let effects = study.tolerances.iter().zip(velocities);
    let effects = effects.map(|(tolerance, effect)| {
        let effect = machine.to_own(Dimension::Velocity, *effect);
        (machine.meaning_of(tolerance.parameter).0, effect)
    });
    let mut effects: Vec<(&str, f64)> = effects.filter(|it| it.1.is_finite()).collect();
    sort_falling(&mut effects, |it| it.1.abs());
    let largest = effects.first().map_or(1.0, |it| it.1.abs());
    let end = ROOM * largest.max(f64::MIN_POSITIVE);
    let bars = effects
        .iter()
        .enumerate()
        .flat_map(|(row, (name, effect))| {
            let (top, effect) = (row as f64, *effect);
            let ends = (effect.min(0.0), effect.max(0.0));
            let (color, align, away, sign) = match effect < 0.0 {
                true => (style::OPTIMUM, Align::Right, -6.0, ""),
                false => (style::DESIGN, Align::Left, 6.0, "+"),
            };
            let number = quantity(effect, machine.unit(Dimension::Velocity));
            let number = format!("{sign}{number}");
            [
                Layer::boxes([[ends, (-top - BAR.1, -top - BAR.0)]], color, 1.0),
                Layer::text((-end, -top - NAME), Align::Left, *name),
                Layer::text((effect, -top - BAR.1), align, number).moved(away, -2.0),
            ]
        });
    let zero = Layer::vertical(0.0, Stroke::solid(style::ASIDE, 1.0), "");
    let rows = effects.len() as f64;
    let [x, y] = [(-end, end), (-rows, 0.0)].map(|ends| Axis::bare().range(ends));
    let panel = Panel::new(x, y, bars.chain([zero]));
    let size = (HALF.0, (32.0 + ROW * rows).max(120.0));
    let caption = "Change of the before-impact velocity when each value goes from its nominal one to the upper end of its tolerance.";
    let title = "Which tolerance counts";
    Figure::new(Section::Tolerances, size, title, [panel], caption)
}
