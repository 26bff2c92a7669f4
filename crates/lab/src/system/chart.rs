//! Pictures of the studies.

use softstop_draw::{Axis, Chart, Corner, Layer, Legend, Mark, Panel, Sign, Stroke, style};

use super::order::Error;
use super::report::{OrderReport, RunUpReport};
use super::run_up::{End, RISES, TORQUES};
use super::strips::{DRIVES, Fate, MISSING, PROBABILITIES, Strips};

/// Size of a panel.
const SIZE: (f64, f64) = (460.0, 330.0);
/// Marks and colours of the ways of coupling.
const LOOKS: [(Mark, &str); 3] = [
    (Mark::Circle, style::DESIGN),
    (Mark::Square, style::REFERENCE),
    (Mark::Triangle, "#009E73"),
];
/// Half the size of marks.
const MARK: f64 = 4.5;

/// A page of panels beside each other, the legend below them.
fn page<const N: usize>(title: &str, explanation: &str, panels: [Panel; N]) -> String {
    let chart = Chart {
        subtitle: explanation.to_owned(),
        legend: Legend::Below,
        ..Chart::new(title, panels)
    };
    chart.in_columns(N).svg()
}

fn panel(x: Axis, y: Axis, layers: Vec<Layer>) -> Panel {
    Panel {
        size: SIZE,
        x,
        y,
        layers,
        ..Panel::default()
    }
}

fn color(fate: Fate) -> &'static str {
    match fate {
        Fate::Kept => style::ALLOWED,
        Fate::Back => style::REFERENCE,
        Fate::Lost => style::OPTIMUM,
    }
}

/// What becomes of z = 1 when strips fail, over frequency.
pub(super) fn strips(found: &Strips) -> String {
    let frequencies = found.frequencies();
    let names = MISSING.iter().map(ToString::to_string);
    let shares = PROBABILITIES.iter();
    let names = names.chain(shares.map(|share| format!("{:.0} %", 100.0 * share)));
    let middles = names.enumerate();
    let ticks: Vec<_> = middles
        .map(|(row, name)| (row as f64 + 0.5, name))
        .collect();
    let panels = DRIVES.map(|(drive, _)| {
        let row = |missing: usize| {
            let of = move |frequency: &f64| found.worst(drive, *frequency, missing);
            frequencies
                .iter()
                .map(move |it| of(it).map_or("#ffffff", color))
        };
        let chance = |probability: f64| {
            let fate = move |frequency: &f64| match found.is_sure(drive, *frequency, probability) {
                true => Fate::Kept,
                false => Fate::Back,
            };
            frequencies.iter().map(move |it| color(fate(it)))
        };
        let colors = MISSING.into_iter().flat_map(row);
        let colors = colors.chain(PROBABILITIES.into_iter().flat_map(chance));
        let border = Layer::across(MISSING.len() as f64, Stroke::solid(style::INK, 1.6), "");
        let mut layers = vec![Layer::cells(frequencies.len(), colors), border];
        let fates = [Fate::Kept, Fate::Back, Fate::Lost];
        layers.extend(fates.map(|fate| Layer::key(Sign::Patch(color(fate)), fate.name())));
        let x = Axis::new("drive frequency η = ω/Ω, up to s_SN").range(found.range);
        let y = Axis::new("failing in a row; above, by chance");
        let y = y.range((0.0, ticks.len() as f64)).ticks(ticks.clone());
        Panel {
            title: drive.to_owned(),
            ..panel(x, y, layers)
        }
    });
    let explanation = "rows: strips that fail in a row, the worst of all drive angles; above, those that come by chance";
    let title = "Strips that fail, on an ideal drive and on a motor, ρ = 10";
    page(title, explanation, panels)
}

fn color_of(end: End) -> &'static str {
    match end {
        End::Lands => style::ALLOWED,
        End::Passes => "#dddddd",
        End::Other => style::REFERENCE,
    }
}

/// What runs from rest end in, and speed over voltage.
pub(super) fn run_up(found: &RunUpReport) -> String {
    let explanation = "left: the voltage of the motor rises evenly from 0; right: voltage up and down in steps, torque \
                       at rest three times what z = 1 takes";
    let title = "Running up to z = 1, ρ = 10, η = 1.15";
    page(title, explanation, [landing(found), jumping(found)])
}

/// What runs end in, over torque and time.
fn landing(found: &RunUpReport) -> Panel {
    let decades = |(low, high): (f64, f64), count: usize| {
        let half = (high / low).powf(0.5 / (count.max(2) - 1) as f64);
        (low / half, high * half)
    };
    let first = found.run_ups[0].torque;
    let rises = found.run_ups.partition_point(|it| it.torque == first);
    let torques = found.run_ups.len() / rises;
    let cell = |k: usize| color_of(found.run_ups[k % torques * rises + k / torques].end);
    let mut layers = vec![Layer::cells(torques, (0..found.run_ups.len()).map(cell))];
    let ends = [End::Lands, End::Passes, End::Other];
    layers.extend(ends.map(|end| Layer::key(Sign::Patch(color_of(end)), end.name())));
    let x = Axis::new("torque at rest / mean torque of z = 1").log();
    let y = Axis::new("time of the rise (s)").log();
    let (x, y) = (
        x.range(decades(TORQUES, torques)),
        y.range(decades(RISES, rises)),
    );
    panel(x, y, layers)
}

/// Speed over voltage, up and down; marks tell where there are impacts.
fn jumping(found: &RunUpReport) -> Panel {
    let mut layers = vec![Layer::key(
        Sign::Mark(Mark::Circle, style::INK),
        "with impacts",
    )];
    for (up, color, name) in [(true, style::DESIGN, "up"), (false, style::OPTIMUM, "down")] {
        let own = || found.plateaus.iter().filter(move |it| it.up == up);
        let points = own().map(|it| (it.voltage, it.speed));
        layers.push(Layer::line(points, Stroke::solid(color, 1.8)).named(name));
        let struck = own().filter(|it| it.impacts > 0.0);
        let struck = struck.map(|it| (it.voltage, it.speed));
        layers.push(Layer::marks(struck, Mark::Circle, color).sized(3.5));
    }
    Panel {
        legend: Some(Legend::Inside(Corner::TopLeft)),
        ..panel(
            Axis::new("voltage / rated voltage"),
            Axis::new("mean speed (rad/s)"),
            layers,
        )
    }
}

/// One of the errors of a run.
type Of = fn(&Error) -> f64;

/// Errors over the step of the master.
pub(super) fn order(found: &OrderReport) -> String {
    let errors: [(&str, Of); 2] = [
        ("error of the speed (rad/s)", |it| it.speed),
        ("error of the last impact (s)", |it| it.impact),
    ];
    let panels = errors.map(|(name, of)| {
        let ways = found.orders.iter().zip(LOOKS);
        let layers = ways.flat_map(|((coupling, order), (mark, color))| {
            let own = found.errors.iter().filter(|it| it.coupling == *coupling);
            let points = own.map(|it| (it.step, of(it).max(1e-15)));
            let points: Vec<(f64, f64)> = points.collect();
            let line = Layer::line(points.iter().copied(), Stroke::solid(color, 2.0));
            let marks = Layer::marks(points, mark, color).sized(MARK);
            let name = format!("{}: order {order:.1}", coupling.name());
            [line, marks].map(|layer| layer.named(&name))
        });
        let x = Axis::new("step of the master (s)").log();
        panel(x, Axis::new(name).log(), layers.collect())
    });
    let explanation =
        "the machine B on its motor after 12 s, beside roll back with steps of 0.0004 s";
    page("What the coupling costs", explanation, panels)
}
