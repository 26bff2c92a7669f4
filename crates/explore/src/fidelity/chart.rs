//! The chart of models: their error over what they cost.

use softstop::Machine;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{self, Align, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::Mark;
use softstop_draw::style;

use super::FidelityArguments;
use super::study::{Entry, Study};
use softstop_console::arguments::title;

/// The page, and the panel on it.
const PAGE: (f64, f64) = (940.0, 640.0);
const AREA: (f64, f64, f64, f64) = (96.0, 72.0, 800.0, 480.0);
/// Letters.
const LETTERS: u32 = 14;
/// Height of a line of names.
const LINE: f64 = 17.0;
/// Half the size of marks.
const MARK: f64 = 6.0;

/// Height of the strips off the scale, in decades.
const STRIP: f64 = 0.5;

/// Models with both axes logarithmic, as an SVG document: what has no error stands in a strip below the scale, what
/// has no value in one above it.
pub(super) fn svg(arguments: &FidelityArguments, machine: &Machine, study: &Study) -> String {
    let tolerance = arguments.tolerance;
    let errors = study.entries.iter().filter_map(|entry| entry.error);
    let errors = errors.chain([tolerance, 1e-3]);
    let errors = errors.filter(|error| error.is_finite() && *error > 0.0);
    let (small, large) = around(errors.map(f64::log10), 0.0);
    let (cheap, dear) = around(study.entries.iter().map(cost), 0.0);
    let x = ((cheap - 0.15).floor().min(1.0), dear + 0.4);
    let y = (small.floor() - STRIP, large.ceil().min(2.0) + STRIP);
    let panel = Panel::new(AREA, x, y);
    let mut pen = Pen::page(PAGE.0, PAGE.1);
    let head = "How simple a model may be";
    heading(&mut pen, (AREA.0, 32.0), head, &title(machine));
    let upwards = format!(
        "model error of the {}",
        arguments.quantity.name().replace('_', " ")
    );
    let axes = Axes {
        is_log: true,
        ..Axes::new(
            LETTERS,
            Some("evaluations of the law of force per drive period"),
            &upwards,
            (6, 8),
        )
    };
    panel.ground(&mut pen, &axes);
    let high = STRIP / (y.1 - y.0) * AREA.3;
    for top in [AREA.1, panel.bottom() - high] {
        pen.tint((AREA.0, top, AREA.2, high), style::ASIDE, 0.12);
    }
    if tolerance > 0.0 {
        let height = tolerance.log10();
        let line = [(panel.x.0, height), (panel.x.1, height)];
        panel.curve(
            &mut pen,
            &line,
            Stroke::dashed(style::OPTIMUM, 1.5, (6.0, 4.0)),
        );
        let place = (panel.right() - 6.0, panel.height(height) - 6.0);
        pen.text(
            place,
            LETTERS - 1,
            Align::Right,
            &format!("tolerance {tolerance}"),
        );
    }
    panel.axes(&mut pen, &axes);
    let chosen = study.cheapest(tolerance).map(Entry::name);
    let place = |entry: &Entry| panel.place((cost(entry), height(entry, &panel)));
    for entry in &study.entries {
        let (mark, color) = match entry.error {
            _ if chosen.as_ref() == Some(&entry.name()) => (Mark::Triangle, style::OPTIMUM),
            Some(error) if error <= tolerance => (Mark::Circle, style::DESIGN),
            Some(error) if error.is_finite() => (Mark::Diamond, style::POINT),
            _ => (Mark::Square, style::ASIDE),
        };
        pen.mark(place(entry), mark, MARK, color);
    }
    let mut entries: Vec<&Entry> = study.entries.iter().collect();
    entries.sort_by(|a, b| place(a).1.total_cmp(&place(b).1));
    let mut taken: Vec<(f64, f64, f64)> = Vec::new();
    for entry in entries {
        let note = match entry.error {
            Some(0.0) => ": exact",
            Some(error) if error.is_finite() => "",
            Some(_) => ": another regime, no error",
            None => ": no such motion, no error",
        };
        let name = format!("{}{note}", entry.name());
        let (x, mut y) = place(entry);
        let width = pen::width(LETTERS - 1, &name);
        let fits = x + MARK + 6.0 + width < panel.right();
        let (place, align, left) = match fits {
            true => (x + MARK + 6.0, Align::Left, x + MARK + 6.0),
            false => (x - MARK - 6.0, Align::Right, x - MARK - 6.0 - width),
        };
        // Moved down where it would cover another one.
        y += 5.0;
        while taken.iter().any(|(other, wide, height)| {
            left < other + wide && *other < left + width && (y - height).abs() < LINE
        }) {
            y += 1.0;
        }
        taken.push((left, width, y));
        pen.text((place, y), LETTERS - 1, align, &name);
    }
    pen.svg()
}

/// Evaluations of a drive period, as a power of ten.
fn cost(entry: &Entry) -> f64 {
    entry.cost.evaluations_per_period.log10()
}

/// The error as a power of ten, where it has one.
fn height(entry: &Entry, panel: &Panel) -> f64 {
    match entry.error {
        Some(0.0) => panel.y.0 + 0.5 * STRIP,
        Some(error) if error.is_finite() => error.log10().min(panel.y.1 - STRIP),
        _ => panel.y.1 - 0.5 * STRIP,
    }
}
