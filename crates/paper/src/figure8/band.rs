//! The band of numbered bifurcations above a panel.

use softstop_draw::panel::Panel;
use softstop_draw::pen::{Align, Pen, Stroke, width};
use softstop_draw::style;

pub(super) const SMALL: u32 = 11;
/// An arrow.
pub(super) const LINE: Stroke = Stroke::solid(style::INK, 1.1);
/// The line at a bifurcation.
const MARK: Stroke = Stroke::dashed("#9a9a9a", 0.9, (3.0, 3.0));

/// A numbered bifurcation.
pub(super) struct Bifurcation {
    pub(super) number: usize,
    /// Where it was found.
    pub(super) eta: f64,
    /// By the paper's symbols.
    pub(super) symbols: String,
    /// True if it cannot be reversed.
    pub(super) hysteresis: bool,
    /// True if it is met on rising eta.
    pub(super) rising: bool,
}

/// Numbers, arrows and symbols above a panel, each with a line to its frequency.
pub(super) fn band(pen: &mut Pen, panel: &Panel, bifurcations: &[&Bifurcation]) {
    let wanted = bifurcations.iter().map(|it| {
        let room = (0.9 * width(SMALL, &it.symbols)).max(30.0);
        (panel.across(it.eta), 8.0 + room)
    });
    let wanted: Vec<(f64, f64)> = wanted.collect();
    let places = spread(&wanted, (panel.area.0 + 20.0, panel.right()));
    let top = panel.area.1;
    for ((it, x), (eta, _)) in bifurcations.iter().zip(places).zip(wanted) {
        pen.line(&[(eta, top), (eta, panel.bottom())], MARK);
        pen.line(
            &[(x, top - 17.0), (eta, top)],
            Stroke::solid("#9a9a9a", 0.9),
        );
        pen.badge((x, top - 64.0), SMALL + 1, &it.number.to_string());
        let y = top - 42.0;
        match (it.hysteresis, it.rising) {
            (false, _) => both_ways(pen, (x, y)),
            (true, true) => pen.arrow((x - 14.0, y), (x + 14.0, y), LINE),
            (true, false) => pen.arrow((x + 14.0, y), (x - 14.0, y), LINE),
        }
        let symbols = it.symbols.replace(" -> ", "→");
        pen.text((x, top - 22.0), SMALL, Align::Middle, &symbols);
    }
}

pub(super) fn both_ways(pen: &mut Pen, (x, y): (f64, f64)) {
    pen.arrow((x, y), (x + 15.0, y), LINE);
    pen.arrow((x, y), (x - 15.0, y), LINE);
}

/// Rounds of moving neighbours apart.
const ROUNDS: usize = 400;

/// Places near those wanted, in their order, so far apart that things of these widths do not overlap.
pub(super) fn spread(wanted: &[(f64, f64)], (low, high): (f64, f64)) -> Vec<f64> {
    let mut places: Vec<f64> = wanted.iter().map(|it| it.0).collect();
    for _ in 0..ROUNDS {
        for index in 1..places.len() {
            let room = 0.5 * (wanted[index - 1].1 + wanted[index].1);
            let lack = room - (places[index] - places[index - 1]);
            if lack > 0.0 {
                places[index - 1] -= 0.5 * lack;
                places[index] += 0.5 * lack;
            }
        }
        for (place, (_, width)) in places.iter_mut().zip(wanted) {
            *place = place.clamp(low + 0.5 * width, high - 0.5 * width);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn neighbours_do_not_overlap() {
        let places = spread(
            &[(10.0, 30.0), (11.0, 30.0), (12.0, 30.0), (95.0, 20.0)],
            (0.0, 120.0),
        );
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 24.9));
        assert!(places[0] > 14.9 && places[3] < 110.1);
    }
}
