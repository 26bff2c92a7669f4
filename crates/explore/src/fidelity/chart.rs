//! Pictures: the error of models over what they cost, and their regimes over drive frequency.

use softstop::{Machine, Parameter};
use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Sign, Stroke, around, style};
use softstop_dynamics::Regime;
use softstop_dynamics::motion_kind::MotionClass;

use super::FidelityArguments;
use super::structure::RegimeStructure;
use super::study::{ModelComparison, ModelEntry};
use crate::palette::{motion_color, motion_keys, regime_class};
use softstop_console::arguments::{title, title_over_frequency};

/// Height of the strips beyond the scale, in decades.
const STRIP: f64 = 0.5;
/// Width of the panels of regimes, and height of a row.
const ROW: (f64, f64) = (430.0, 26.0);

/// Models with both axes logarithmic: what has no error stands in a strip below the scale, what has no value in one
/// above it.
pub(super) fn models(
    arguments: &FidelityArguments,
    machine: &Machine,
    study: &ModelComparison,
) -> Chart {
    let tolerance = arguments.tolerance;
    let errors = study.entries.iter().filter_map(|entry| entry.error);
    let errors = errors.chain([tolerance, 1e-3]);
    let errors = errors.filter(|error| error.is_finite() && *error > 0.0);
    let (small, large) = around(errors.map(f64::log10), 0.0);
    let (low, high) = (small.floor(), large.ceil().min(2.0));
    let costs = study
        .entries
        .iter()
        .map(|entry| entry.evaluations_per_period.log10());
    let (cheap, dear) = around(costs, 0.0);
    let power = |exponent: f64| 10f64.powf(exponent);
    let ends = |(low, high): (f64, f64)| (power(low), power(high));
    let place = |entry: &ModelEntry| {
        let height = match entry.error {
            Some(0.0) => power(low - 0.5 * STRIP),
            Some(error) if error.is_finite() => error.min(power(high)),
            _ => power(high + 0.5 * STRIP),
        };
        (entry.evaluations_per_period, height)
    };
    let all = (0.0, f64::INFINITY);
    let strips = [
        [all, (power(high), f64::INFINITY)],
        [all, (0.0, power(low))],
    ];
    let mut layers = vec![Layer::boxes(strips, style::ASIDE, 0.12)];
    if tolerance > 0.0 {
        let line = Stroke::dashed(style::OPTIMUM, 1.5, (6.0, 4.0));
        layers.push(Layer::horizontal(
            tolerance,
            line,
            format!("tolerance {tolerance}"),
        ));
    }
    let chosen = study.cheapest(tolerance).map(|entry| entry.name);
    for entry in &study.entries {
        let (mark, color) = match entry.error {
            _ if chosen == Some(entry.name) => (Mark::Triangle, style::OPTIMUM),
            Some(error) if error <= tolerance => (Mark::Circle, style::DESIGN),
            Some(error) if error.is_finite() => (Mark::Diamond, style::POINT),
            _ => (Mark::Square, style::ASIDE),
        };
        let note = match entry.error {
            Some(0.0) => ": exact",
            Some(error) if error.is_finite() => "",
            Some(_) => ": another regime",
            None => ": no such motion",
        };
        layers.push(Layer::marks([place(entry)], mark, color));
        layers.push(Layer::label(place(entry), format!("{}{note}", entry.name)));
    }
    let quantity = arguments.quantity.name().replace("before_", "before-");
    let quantity = quantity.replace('_', " ");
    let log = |name: String, powers| Axis::new(name).log().range(ends(powers));
    let across = "evaluations of the force per drive period".to_owned();
    let across = log(across, ((cheap - 0.15).floor().min(1.0), dear + 0.4));
    let up = format!("model error of the {quantity}");
    let panel = Panel::new(across, log(up, (low - STRIP, high + STRIP)), layers);
    Chart {
        subtitle: title(machine),
        ..Chart::new("How simple a model may be", [panel.sized((600.0, 430.0))])
    }
}

/// The regimes of all models as an SVG document: a strip over drive frequency for each model and start.
pub(super) fn regimes(machine: &Machine, structure: &RegimeStructure) -> String {
    let (frequencies, rows) = (&structure.frequencies, structure.tracks.len() as f64);
    let (low, high) = around(frequencies.iter().copied(), 0.0);
    let room = 0.5 * (high - low) / (frequencies.len() - 1) as f64;
    let x = Axis::new(machine.label_of(Parameter::Frequency)).range((low - room, high + room));
    let tracks = structure.tracks.iter();
    let all: Vec<_> = tracks.flat_map(|track| track.regimes.concat()).collect();
    let starts = ["from rest", "flung towards the stop"];
    let panels = starts.into_iter().enumerate().map(|(start, title)| {
        let lowest_first = || structure.tracks.iter().rev();
        let regimes = lowest_first().flat_map(|track| &track.regimes[start]);
        let colors = regimes.map(|regime| motion_color(class(*regime)));
        let cells = Layer::cells(frequencies.len(), colors);
        let names = lowest_first().map(|track| track.entry.full_name());
        let names = names
            .enumerate()
            .map(|(row, name)| (row as f64 + 0.5, name));
        let up = Axis::new("").range((0.0, rows)).ticks(names);
        let layers = [cells].into_iter().chain(keys(&all));
        Panel {
            title: title.to_owned(),
            ..Panel::new(x.clone(), up, layers).sized((ROW.0, ROW.1 * rows))
        }
    });
    let head = title_over_frequency(machine);
    let head = format!("Regimes of the models of {head}");
    let chart = Chart::new(head, panels).in_columns(1);
    let legend = Legend::Below;
    Chart { legend, ..chart }.svg()
}

fn class(regime: Option<Regime>) -> MotionClass {
    regime.map_or(MotionClass::Unsettled, regime_class)
}

/// What the colours of regimes mean; without one a motion is chaotic or unsettled.
fn keys(regimes: &[Option<Regime>]) -> impl Iterator<Item = Layer> {
    let occurs = |kind| {
        let mut periodic = regimes.iter().flatten();
        periodic.any(|regime| regime_class(*regime) == kind)
    };
    let other = Layer::key(Sign::Patch(style::motion::UNSETTLED), "does not repeat");
    motion_keys(occurs).chain(regimes.contains(&None).then_some(other))
}
