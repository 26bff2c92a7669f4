//! The chart of a design: before-impact velocity over drive frequency, in the paper's symbols.

use softstop::{Dimension, Language, Machine, Parameter};
use softstop_console::interrupt;
use softstop_draw::panel::{Axes, Panel, heading};
use softstop_draw::pen::{Align, Area, Pen, Stroke};
use softstop_draw::scale::around;
use softstop_draw::shapes::{Mark, Sign};
use softstop_draw::style;
use softstop_dynamics::zone;

use super::branch::Branch;
use super::reference::Reference;
use crate::design::Design;

/// The page, and the panel on it.
const PAGE: (f64, f64) = (920.0, 640.0);
const AREA: Area = (84.0, 84.0, 800.0, 480.0);
/// Letters.
const LETTERS: u32 = 14;
/// Half the size of marks.
const MARK: f64 = 7.0;
/// Lines of the design's motions, of those beside it, and of the ends of the zone.
const DESIGN: Stroke = Stroke::solid(style::DESIGN, 2.5);
const BESIDE: Stroke = Stroke::dashed(style::REFERENCE, 2.5, (8.0, 5.0));
const END: Stroke = Stroke::dashed(style::DESIGN, 1.2, (5.0, 4.0));

/// The chart of a design with margin M, beside a motion, as an SVG document.
pub(super) fn svg(design: &Design, margin: f64, beside: Option<&Reference>) -> String {
    let machine = &design.machine;
    let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
    let branch = Branch::new(machine, &design.zone, label("design", machine));
    let optimum = (design.frequency(), design.before_impact_velocity());
    let beside = beside.map(Beside::new);
    let others = beside.iter().filter_map(|it| it.branch.as_ref());
    let drawn: Vec<(&Branch, Stroke)> = others
        .map(|branch| (branch, BESIDE))
        .chain([(&branch, DESIGN)])
        .collect();
    let curves = drawn
        .iter()
        .flat_map(|(branch, _)| branch.pieces.iter().flatten());
    let points = curves.copied().chain(beside.iter().map(|it| it.point));
    let points: Vec<(f64, f64)> = points.chain([optimum]).collect();
    let top = points.iter().map(|point| point.1).fold(0.0, f64::max);
    let across = around(points.iter().map(|point| point.0), 0.08);
    let panel = Panel::new(AREA, across, (0.0, 1.2 * top));

    let mut pen = Pen::page(PAGE.0, PAGE.1);
    let name = machine.name.as_deref().unwrap_or("given");
    let title = format!("Hardest impact of the {name} machine");
    let what = "before-impact velocity of the stable z = 1 motion in its hysteresis zone";
    heading(&mut pen, (AREA.0, 38.0), &title, what);
    let frequency = machine.label_of(Parameter::Frequency);
    let velocity = machine.label("before-impact velocity", "X′₋", Dimension::Velocity);
    let axes = Axes::new(LETTERS, Some(&frequency), &velocity, (8, 6));
    let [low, high] = [margin, 1.0 - margin].map(|place| own(design.zone.frequency_at(place)));
    let [left, right] = [low, high].map(|frequency| panel.across(frequency));
    pen.tint((left, AREA.1, right - left, AREA.3), style::ALLOWED, 0.18);
    panel.ground(&mut pen, &axes);
    let allowance = format!("allowed by margin M = {margin}");
    let place = (0.5 * (left + right), AREA.1 + 0.12 * AREA.3);
    pen.text(place, LETTERS, Align::Middle, &allowance);
    for (frequency, name) in [(branch.frequency_g0, "g₀"), (branch.frequency_sn, "s_SN")] {
        panel.curve(&mut pen, &[(frequency, 0.0), (frequency, panel.y.1)], END);
        let place = (panel.across(frequency) + 5.0, AREA.1 + 18.0);
        pen.text(place, LETTERS, Align::Left, name);
    }
    let mut entries = Vec::new();
    for (branch, stroke) in drawn {
        for piece in &branch.pieces {
            panel.curve(&mut pen, piece, stroke);
        }
        entries.push((Sign::Line(stroke), branch.label.clone()));
    }
    let mut mark = |pen: &mut Pen, point, shape, color, name: &str| {
        pen.mark(panel.place(point), shape, MARK, color);
        let (x, y) = panel.place(point);
        pen.text((x + 12.0, y + 20.0), LETTERS, Align::Left, name);
        entries.push((Sign::Mark(shape, color), legend(machine, name, point)));
    };
    mark(&mut pen, optimum, Mark::Triangle, style::OPTIMUM, "optimum");
    if let Some(beside) = &beside {
        let name = format!("point {}", beside.name);
        mark(&mut pen, beside.point, Mark::Circle, style::POINT, &name);
    }
    panel.axes(&mut pen, &axes);
    let place = (
        panel.across(branch.frequency_sn) - 340.0,
        panel.bottom() - 96.0,
    );
    pen.legend(place, LETTERS, &entries);
    pen.svg()
}

fn legend(machine: &Machine, name: &str, (frequency, velocity): (f64, f64)) -> String {
    match machine.speaks {
        Language::Ratios => format!("{name}: η = {frequency:.3}, X′₋ = {velocity:.2}"),
        _ => {
            let unit = machine.unit(Dimension::Frequency);
            let (frequency, velocity) = (digits(frequency), digits(velocity));
            format!("{name}: {frequency} {unit}, {velocity} m/s")
        }
    }
}

/// The motion beside which the design stands.
struct Beside {
    name: &'static str,
    /// Frequency and before-impact velocity.
    point: (f64, f64),
    /// The motions of its zone.
    branch: Option<Branch>,
}

impl Beside {
    fn new(reference: &Reference) -> Self {
        let machine = &reference.machine;
        let zone = zone::hysteresis_watched(&machine.scene, &interrupt::watch).ok();
        let named = match reference.name {
            "given" => "as given".to_owned(),
            point => format!("paper's {point}"),
        };
        Self {
            name: reference.name,
            point: (
                machine.value(Parameter::Frequency).unwrap_or(f64::NAN),
                reference.orbit.before_impact_velocity(),
            ),
            branch: zone.map(|zone| Branch::new(machine, &zone, label(&named, machine))),
        }
    }
}

/// What it is, with the stop and the clearance that it has.
fn label(name: &str, machine: &Machine) -> String {
    let value = |parameter| machine.value(parameter);
    let stiffness = value(Parameter::StopStiffness);
    let clearance = value(Parameter::Clearance).unwrap_or(f64::NAN);
    match (machine.speaks, stiffness) {
        (Language::Ratios, Some(stiffness)) => {
            format!("{name}: k₄/k₁ = {stiffness:.2}, ρ = {clearance:.2}")
        }
        (Language::Ratios, None) => format!("{name}: ρ = {clearance:.2}"),
        (_, Some(stiffness)) => {
            let (stiffness, clearance) = (digits(stiffness), digits(clearance));
            format!("{name}: stop {stiffness} N/m, clearance {clearance} m")
        }
        (_, None) => format!("{name}: clearance {} m", digits(clearance)),
    }
}

/// A number with four digits.
fn digits(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        let places = 3 - value.abs().max(1e-3).log10().floor() as i32;
        format!("{value:.*}", places.max(0) as usize)
    } else {
        format!("{value:.3e}")
    }
}
