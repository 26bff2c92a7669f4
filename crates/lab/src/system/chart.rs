//! Pictures of the studies.

use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;

use super::coupled::Coupling;
use super::order::{COUPLINGS, Error};
use super::report::{OrderReport, RunUpReport};
use super::run_up::{End, RISES, TORQUES};
use super::strips::{DRIVES, Fate, MISSING, PROBABILITIES, Strips};

/// Width and height of a panel, from one to the next, left and top of the first.
const AREA: (f64, f64) = (460.0, 330.0);
const NEXT: f64 = 590.0;
const FIRST: (f64, f64) = (110.0, 112.0);
const LETTERS: u32 = 14;
/// Marks and colours of the ways of coupling.
const LOOKS: [(Mark, &str); 3] = [
    (Mark::Circle, style::DESIGN),
    (Mark::Square, style::REFERENCE),
    (Mark::Triangle, "#009E73"),
];
/// Half the size of marks.
const MARK: f64 = 4.5;
/// Height of a row of the picture of strips.
const ROW: f64 = AREA.1 / (MISSING.len() + PROBABILITIES.len()) as f64;

fn page() -> Pen {
    Pen::page(FIRST.0 + NEXT + AREA.0 + 40.0, FIRST.1 + AREA.1 + 110.0)
}

/// The area of a panel, counted from the left.
fn area(index: usize) -> (f64, f64, f64, f64) {
    (FIRST.0 + NEXT * index as f64, FIRST.1, AREA.0, AREA.1)
}

/// Where an entry of a legend below the panels stands, if they are so far apart.
fn entry(apart: f64, index: usize) -> (f64, f64) {
    (FIRST.0 + apart * index as f64, FIRST.1 + AREA.1 + 84.0)
}

/// A legend below the panels, its entries so far apart.
fn legend(pen: &mut Pen, apart: f64, signs: impl IntoIterator<Item = (Sign, String)>) {
    for (index, sign) in signs.into_iter().enumerate() {
        pen.legend(entry(apart, index), LETTERS, &[sign]);
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
    let mut pen = page();
    let explanation = "rows: strips that fail in a row, the worst of all drive angles; above, those that come by chance";
    let title = "Strips that fail, on an ideal drive and on a motor, ρ = 10";
    heading(&mut pen, (FIRST.0, 36.0), title, explanation);
    let frequencies = found.frequencies();
    for (index, (drive, _)) in DRIVES.into_iter().enumerate() {
        let panel = Panel::new(area(index), found.range, (0.0, 1.0));
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
        let colors: Vec<&str> = colors
            .chain(PROBABILITIES.into_iter().flat_map(chance))
            .collect();
        panel.cells(&mut pen, frequencies.len(), &colors);
        let axes = Axes::new(
            LETTERS,
            Some("drive frequency η = ω/Ω, up to s_SN"),
            "",
            (6, 0),
        );
        panel.axes(&mut pen, &axes);
        let names = MISSING.map(|count| count.to_string()).into_iter();
        let names = names.chain(PROBABILITIES.map(|share| format!("{:.0} %", 100.0 * share)));
        for (row, name) in names.enumerate() {
            let place = (
                panel.area.0 - 8.0,
                panel.bottom() - ROW * (row as f64 + 0.5) + 5.0,
            );
            pen.text(place, LETTERS, Align::Right, &name);
        }
        let line = panel.bottom() - ROW * MISSING.len() as f64;
        let across = [(panel.area.0, line), (panel.right(), line)];
        pen.line(&across, Stroke::solid(style::INK, 1.6));
        let middle = |from: f64, rows: usize| from - 0.5 * ROW * rows as f64;
        let left = panel.area.0 - 58.0;
        pen.text(
            (left, middle(panel.bottom(), MISSING.len())),
            LETTERS,
            Align::Upwards,
            "failing in a row",
        );
        pen.text(
            (left, middle(line, PROBABILITIES.len())),
            LETTERS,
            Align::Upwards,
            "by chance",
        );
        pen.heading(
            (panel.area.0, FIRST.1 - 12.0),
            LETTERS + 2,
            Align::Left,
            drive,
        );
    }
    let fates = [Fate::Kept, Fate::Back, Fate::Lost];
    let sign = |fate: Fate| (Sign::Patch(color(fate)), fate.name().to_owned());
    legend(&mut pen, 260.0, fates.map(sign));
    pen.svg()
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
    let mut pen = page();
    let explanation = "left: the voltage of the motor rises evenly from 0; right: voltage up and down in steps, torque \
                       at rest three times what z = 1 takes";
    let title = "Running up to z = 1, ρ = 10, η = 1.15";
    heading(&mut pen, (FIRST.0, 36.0), title, explanation);
    landing(&mut pen, found);
    jumping(&mut pen, found);
    pen.svg()
}

/// What runs end in, over torque and time.
fn landing(pen: &mut Pen, found: &RunUpReport) {
    let decades = |(low, high): (f64, f64), count: usize| {
        let (low, high) = (low.log10(), high.log10());
        let half = 0.5 * (high - low) / (count.max(2) - 1) as f64;
        (low - half, high + half)
    };
    let rises = found
        .run_ups
        .partition_point(|it| it.torque == found.run_ups[0].torque);
    let torques = found.run_ups.len() / rises;
    let panel = Panel::new(area(0), decades(TORQUES, torques), decades(RISES, rises));
    let cell = |k: usize| color_of(found.run_ups[k % torques * rises + k / torques].end);
    let colors: Vec<&str> = (0..found.run_ups.len()).map(cell).collect();
    panel.cells(pen, torques, &colors);
    let axes = Axes {
        is_log: true,
        ..Axes::new(
            LETTERS,
            Some("torque at rest / mean torque of z = 1"),
            "time of the rise (s)",
            (4, 4),
        )
    };
    panel.axes(pen, &axes);
    let ends = [End::Lands, End::Passes, End::Other];
    let sign = |end: End| (Sign::Patch(color_of(end)), end.name().to_owned());
    legend(pen, 170.0, ends.map(sign));
}

/// Speed over voltage, up and down; marks tell where there are impacts.
fn jumping(pen: &mut Pen, found: &RunUpReport) {
    let x = around(found.plateaus.iter().map(|it| it.voltage), 0.04);
    let y = around(found.plateaus.iter().map(|it| it.speed), 0.06);
    let panel = Panel::new(area(1), x, y);
    let axes = Axes::new(
        LETTERS,
        Some("voltage / rated voltage"),
        "mean speed (rad/s)",
        (6, 6),
    );
    panel.ground(pen, &axes);
    let ways = [(true, style::DESIGN, "up"), (false, style::OPTIMUM, "down")];
    for (row, (up, color, name)) in ways.into_iter().enumerate() {
        let own = || found.plateaus.iter().filter(move |it| it.up == up);
        let points: Vec<(f64, f64)> = own().map(|it| (it.voltage, it.speed)).collect();
        panel.curve(pen, &points, Stroke::solid(color, 1.8));
        for it in own().filter(|it| it.impacts > 0.0) {
            pen.mark(
                panel.place((it.voltage, it.speed)),
                Mark::Circle,
                3.5,
                color,
            );
        }
        let place = (panel.area.0 + 24.0, panel.area.1 + 24.0 + 22.0 * row as f64);
        pen.legend(
            place,
            LETTERS,
            &[(Sign::Line(Stroke::solid(color, 1.8)), name.to_owned())],
        );
    }
    let place = (panel.area.0 + 24.0, panel.area.1 + 68.0);
    pen.legend(
        place,
        LETTERS,
        &[(
            Sign::Mark(Mark::Circle, style::INK),
            "with impacts".to_owned(),
        )],
    );
    panel.axes(pen, &axes);
}

/// Distance of the entries of its legend.
const APART: f64 = 320.0;

/// One of the errors of a run.
type Of = fn(&Error) -> f64;

/// Errors over the step of the master.
pub(super) fn order(found: &OrderReport) -> String {
    let mut pen = page();
    let explanation =
        "the machine B on its motor after 12 s, beside roll back with steps of 0.0004 s";
    heading(
        &mut pen,
        (FIRST.0, 36.0),
        "What the coupling costs",
        explanation,
    );
    let log = |value: f64| value.max(1e-15).log10();
    let x = around(found.errors.iter().map(|it| log(it.step)), 0.06);
    let errors: [(&str, Of); 2] = [
        ("error of the speed (rad/s)", |it| it.speed),
        ("error of the last impact (s)", |it| it.impact),
    ];
    for (index, (name, of)) in errors.into_iter().enumerate() {
        let y = around(found.errors.iter().map(|it| log(of(it))), 0.06);
        let panel = Panel::new(area(index), x, y);
        let axes = Axes {
            is_log: true,
            ..Axes::new(LETTERS, Some("step of the master (s)"), name, (4, 8))
        };
        panel.ground(&mut pen, &axes);
        for (coupling, (mark, color)) in COUPLINGS.into_iter().zip(LOOKS) {
            let own = found.errors.iter().filter(|it| it.coupling == coupling);
            let points: Vec<(f64, f64)> = own.map(|it| (log(it.step), log(of(it)))).collect();
            panel.curve(&mut pen, &points, Stroke::solid(color, 2.0));
            for point in points {
                pen.mark(panel.place(point), mark, MARK, color);
            }
        }
        panel.axes(&mut pen, &axes);
    }
    let sign = |((coupling, order), (_, color)): (&(Coupling, f64), (Mark, &'static str))| {
        let name = format!("{}: order {order:.1}", coupling.name());
        (Sign::Line(Stroke::solid(color, 2.0)), name)
    };
    legend(&mut pen, APART, found.orders.iter().zip(LOOKS).map(sign));
    for (index, (mark, color)) in LOOKS.into_iter().enumerate() {
        let (left, line) = entry(APART, index);
        let size = f64::from(LETTERS);
        pen.mark((left + 1.1 * size, line - 0.36 * size), mark, MARK, color);
    }
    pen.svg()
}
