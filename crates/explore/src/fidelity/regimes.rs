//! The chart of regimes: a strip over drive frequency for each model and start.

use softstop::{Machine, Parameter};
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen};
use softstop_draw::shapes::Sign;
use softstop_dynamics::Regime;

use super::structure::Structure;

/// Classes of regimes, with their colours: Okabe and Ito's but for a wine red, which those who see no green tell from
/// it, grey for no impacts and black for what does not repeat.
const CLASSES: [(&str, &str); 7] = [
    ("z = 0", "#D9D9D9"),
    ("z = 1", "#0072B2"),
    ("z = p, p > 1", "#56B4E9"),
    ("z = p/2", "#E69F00"),
    ("z = p/3", "#009E73"),
    ("z = p/n, n > 3", "#882255"),
    ("unsettled", "#000000"),
];

fn color(regime: Option<Regime>) -> &'static str {
    let class = match regime.map(|regime| (regime.impacts, regime.periods)) {
        None => 6,
        Some((0, _)) => 0,
        Some((1, 1)) => 1,
        Some((_, 1)) => 2,
        Some((_, 2)) => 3,
        Some((_, 3)) => 4,
        Some(_) => 5,
    };
    CLASSES[class].1
}

/// Left of the panels, their width, the height of a row, and what is above and below them.
const LEFT: f64 = 230.0;
const WIDTH: f64 = 760.0;
const ROW: f64 = 26.0;
const ABOVE: f64 = 92.0;
const BELOW: f64 = 96.0;
/// Letters.
const LETTERS: u32 = 14;

/// The regimes of all models as an SVG document.
pub(super) fn svg(title: &str, machine: &Machine, structure: &Structure) -> String {
    let height = ROW * structure.tracks.len() as f64;
    let page = (LEFT + WIDTH + 190.0, ABOVE + 2.0 * (height + BELOW));
    let mut pen = Pen::page(page.0, page.1);
    heading(&mut pen, (LEFT, 36.0), title, "");
    let across = machine.label_of(Parameter::Frequency);
    for (index, start) in ["from rest", "flung towards the stop"].iter().enumerate() {
        let top = ABOVE + index as f64 * (height + BELOW);
        pen.text((LEFT, top - 8.0), LETTERS, Align::Left, start);
        let [low, high] = [structure.frequencies.first(), structure.frequencies.last()]
            .map(|end| end.copied().unwrap_or(0.0));
        let room = 0.5 * (high - low) / (structure.frequencies.len() - 1) as f64;
        let area = (LEFT, top, WIDTH, height);
        let panel = Panel::new(area, (low - room, high + room), (0.0, 1.0));
        let lowest_first = structure.tracks.iter().rev();
        let regimes = lowest_first.flat_map(|track| &track.regimes[index]);
        let colors: Vec<&str> = regimes.map(|regime| color(*regime)).collect();
        panel.cells(&mut pen, structure.frequencies.len(), &colors);
        for (row, track) in structure.tracks.iter().enumerate() {
            let place = (LEFT - 10.0, top + ROW * (row as f64 + 0.7));
            pen.text(place, LETTERS, Align::Right, &track.entry.full_name());
        }
        panel.axes(&mut pen, &Axes::new(LETTERS, Some(&across), "", (8, 0)));
    }
    let entries = CLASSES.map(|(name, color)| (Sign::Patch(color), name.to_owned()));
    pen.legend((LEFT + WIDTH + 18.0, ABOVE + 14.0), LETTERS, &entries);
    pen.svg()
}
