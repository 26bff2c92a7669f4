//! The panel of how wide the regions of weak impacts and of hysteresis are.

use super::{HardeningChart, LETTERS};
use softstop_draw::panel::{Axes, Panel};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::style;

/// Room beside the curves in decades.
const ROOM: f64 = 0.4;

impl HardeningChart {
    /// Both over the stiffness, logarithmic.
    pub(super) fn widths(&self, pen: &mut Pen, area: Area) {
        let upper = self.grazing.1;
        let both: Vec<(f64, f64, f64)> = self
            .folds
            .iter()
            .filter_map(|fold| {
                let (weak, strong) = (fold.weak?.0, fold.strong?.0);
                let width = upper - weak;
                let x = fold.stiffness.log10();
                (width > 0.0).then(|| (x, width.log10(), (strong - weak).log10()))
            })
            .collect();
        let weak: Vec<(f64, f64)> = both.iter().map(|point| (point.0, point.1)).collect();
        let strong: Vec<(f64, f64)> = both.iter().map(|point| (point.0, point.2)).collect();
        let lowest = weak.iter().map(|point| point.1).fold(0.0, f64::min);
        let panel = Panel::new(area, (0.0, self.decades.1), (lowest - ROOM, ROOM));
        let axes = Axes::new(LETTERS, Some("log₁₀ k₂/k₁"), "log₁₀ width in η", (4, 5));
        panel.ground(pen, &axes);
        for (points, color, shift, name) in [
            (
                &strong,
                style::DESIGN,
                24.0,
                "hysteresis, from s_SN back to the weak fold",
            ),
            (
                &weak,
                style::OPTIMUM,
                -6.0,
                "weak z = 1, from g₀ to its fold",
            ),
        ] {
            panel.curve(pen, points, Stroke::solid(color, 2.0));
            panel.dots(pen, points.iter().copied(), 3.4, color);
            if let Some(point) = points.get(points.len() / 4) {
                let place = panel.place(*point);
                let place = (place.0 + 12.0, place.1 + shift);
                pen.words(place, LETTERS, Align::Left, (color, true), name);
            }
        }
        panel.axes(pen, &axes);
        let place = (area.0, area.1 - 14.0);
        pen.heading(place, 15, Align::Left, "Widths above the resonance");
    }
}
