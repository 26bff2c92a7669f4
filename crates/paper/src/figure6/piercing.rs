//! Where the strip is pierced: a couple of lines for each clearance, up and down.

use softstop_draw::panel::Panel;
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;

/// Ranges of eta.
pub(super) type Ranges = Vec<(f64, f64)>;

/// Height of a couple of lines.
const ROW: f64 = 19.0;
const LETTERS: u32 = 15;

/// Height of the panel for so many clearances.
pub(super) fn height(rows: usize) -> f64 {
    ROW * rows as f64 + 8.0
}

/// A couple of lines for each clearance, which is given with its ranges up and down and its colour.
pub(super) fn draw<'a>(
    pen: &mut Pen,
    panel: &Panel,
    rows: impl Iterator<Item = (f64, &'a [Ranges; 2], &'static str)>,
) {
    let (left, top, _, height) = panel.area;
    pen.frame(panel.area);
    let text = "the strip is pierced: Xₘ > ρ + σ";
    let place = (panel.right() - 8.0, panel.bottom() - 9.0);
    pen.words(place, LETTERS - 1, Align::Right, (style::INK, false), text);
    for (index, (clearance, ways, color)) in rows.enumerate() {
        let middle = top + 4.0 + ROW * (index as f64 + 0.5);
        for (way, (ranges, shift)) in ways.iter().zip([-3.6, 3.6]).enumerate() {
            for (from, to) in ranges {
                let ends = [*from, *to].map(|eta| (panel.across(eta), middle + shift));
                let [tail, head] = if way == 0 { ends } else { [ends[1], ends[0]] };
                pen.arrow(tail, head, Stroke::solid(color, 1.8));
            }
        }
        let name = format!("{clearance}");
        let place = (left - 9.0, middle + 5.0);
        pen.words(place, LETTERS - 2, Align::Right, (color, false), &name);
    }
    let middle = top + 0.5 * height;
    pen.text((left - 42.0, middle), LETTERS + 1, Align::Upwards, "ρ");
}
