//! What each tolerance does to the objective, as bars.

use softstop_draw::panel::Panel;
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;

use crate::page::data::Sensitivity;
use crate::page::figure::{EDGE, Figure, HALF, LETTERS, ROOM, Size};
use crate::page::words::quantity;

/// From bar to bar, and the thickness of one.
const STEP: f64 = 42.0;
const BAR: f64 = 14.0;

/// The picture; the largest effect first.
pub(in crate::page) fn figure(effects: &[Sensitivity]) -> Figure {
    let mut effects: Vec<&Sensitivity> =
        effects.iter().filter(|it| it.effect.is_finite()).collect();
    effects.sort_by(|a, b| b.effect.abs().total_cmp(&a.effect.abs()));
    let height = (2.0 * EDGE + STEP * effects.len() as f64).max(120.0);
    let size = Size {
        width: HALF.width,
        height,
    };
    let mut pen = Pen::new(size.width, size.height);
    let largest = effects
        .first()
        .map_or(1.0, |it| it.effect.abs())
        .max(f64::MIN_POSITIVE);
    let area = (EDGE, EDGE, HALF.width - 2.0 * EDGE, height - 2.0 * EDGE);
    let panel = Panel::new(
        (area.0 + ROOM.0, area.1, area.2 - 2.0 * ROOM.0, area.3),
        (-largest, largest),
        (0.0, 1.0),
    );
    let zero = panel.across(0.0);
    pen.line(
        &[(zero, area.1), (zero, area.1 + area.3)],
        Stroke::solid(style::ASIDE, 1.0),
    );
    for (row, it) in effects.iter().enumerate() {
        let y = area.1 + STEP * row as f64;
        let end = panel.across(it.effect);
        let color = if it.effect < 0.0 {
            style::OPTIMUM
        } else {
            style::DESIGN
        };
        pen.text((area.0, y + 14.0), LETTERS, Align::Left, &it.label.name);
        let bar = (zero.min(end), y + 20.0, (end - zero).abs().max(1.0), BAR);
        pen.fill(&[bar], color);
        let (place, align) = match it.effect < 0.0 {
            true => (end - 6.0, Align::Right),
            false => (end + 6.0, Align::Left),
        };
        let sign = if it.effect > 0.0 { "+" } else { "" };
        pen.text(
            (place, y + 32.0),
            LETTERS,
            align,
            &format!("{sign}{}", quantity(it.effect, &it.effect_unit)),
        );
    }
    let caption = "Change of the before-impact velocity when each value goes from its nominal one to the upper end of its tolerance.";
    Figure::new(&pen, size, "Which tolerance counts", caption.to_owned())
}
