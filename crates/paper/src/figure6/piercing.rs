//! Where the strip is pierced: a couple of lines for each clearance, up and down.

use softstop_draw::panel::Panel;
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::style;
use softstop_dynamics::sweep::Chain;

/// Height of a couple of lines.
const ROW: f64 = 19.0;
const LETTERS: u32 = 15;

/// Height of the panel for so many sweeps.
pub(super) fn height(chains: usize) -> f64 {
    0.5 * ROW * chains as f64 + 8.0
}

/// Ranges of eta in which the largest position of a sweep lies behind the strip, if there is one.
pub(super) fn ranges(chain: &Chain) -> Vec<(f64, f64)> {
    let scene = &chain.machine.scene;
    let strip = scene.piercing.map_or(f64::INFINITY, |it| it.thickness);
    let through = scene.clearance + strip;
    let rising = chain.rising();
    let runs = rising.chunk_by(|a, b| (a.max_position > through) == (b.max_position > through));
    let pierced = runs.filter(|run| run[0].max_position > through && run.len() > 1);
    let ends = pierced.map(|run| (run[0].value, run[run.len() - 1].value));
    ends.collect()
}

/// A couple of lines in its colour for each clearance, whose sweeps are given up and down.
pub(super) fn draw(pen: &mut Pen, panel: &Panel, chains: &[Chain], colors: &[&'static str]) {
    let (left, top, _, height) = panel.area;
    pen.frame(panel.area);
    let text = "the strip is pierced: Xₘ > ρ + σ";
    let place = (panel.right() - 8.0, panel.bottom() - 9.0);
    pen.words(place, LETTERS - 1, Align::Right, (style::INK, false), text);
    for (index, (ways, color)) in chains.chunks_exact(2).zip(colors).enumerate() {
        let middle = top + 4.0 + ROW * (index as f64 + 0.5);
        for (way, (chain, shift)) in ways.iter().zip([-3.6, 3.6]).enumerate() {
            for (from, to) in ranges(chain) {
                let ends = [from, to].map(|eta| (panel.across(eta), middle + shift));
                let [tail, head] = if way == 0 { ends } else { [ends[1], ends[0]] };
                pen.arrow(tail, head, Stroke::solid(color, 1.8));
            }
        }
        let name = ways[0].machine.scene.clearance.to_string();
        let place = (left - 9.0, middle + 5.0);
        pen.words(place, LETTERS - 2, Align::Right, (color, false), &name);
    }
    let middle = top + 0.5 * height;
    pen.text((left - 42.0, middle), LETTERS + 1, Align::Upwards, "ρ");
}
