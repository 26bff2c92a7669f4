//! The chart of a design: before-impact velocity over drive frequency, in the paper's symbols.

use softstop::{Dimension, Language, Machine, Parameter};
use softstop_console::interrupt;
use softstop_draw::{Axis, Chart, Layer, Legend, Mark, Panel, Stroke, style};
use softstop_dynamics::zone;

use super::branch::Branch;
use super::reference::Reference;
use crate::design::Design;

/// Lines of the design's motions, of those beside it, and of the ends of the zone.
const DESIGN: Stroke = Stroke::solid(style::DESIGN, 2.5);
const BESIDE: Stroke = Stroke::dashed(style::REFERENCE, 2.5, (8.0, 5.0));
const END: Stroke = Stroke::dashed(style::DESIGN, 1.2, (5.0, 4.0));

/// The chart of a design with margin M, beside a motion, as an SVG document.
pub(super) fn svg(design: &Design, margin: f64, beside: Option<&Reference>) -> String {
    let machine = &design.machine;
    let own = |frequency| machine.to_own(Dimension::Frequency, frequency);
    let branch = Branch::new(machine, &design.zone, label("design", machine));
    let beside = beside.map(Beside::new);

    let ends = [margin, 1.0 - margin].map(|place| own(design.zone.frequency_at(place)));
    let whole = (f64::NEG_INFINITY, f64::INFINITY);
    let allowed = Layer::boxes([[ends.into(), whole]], style::ALLOWED, 0.18);
    let mut layers = vec![
        allowed.named(format!("allowed by margin M = {margin}")),
        Layer::vertical(branch.frequency_g0, END, "g₀"),
        Layer::vertical(branch.frequency_sn, END, "s_SN"),
    ];
    let others = beside.iter().filter_map(|it| it.branch.as_ref());
    let drawn = others.map(|branch| (branch, BESIDE));
    for (branch, stroke) in drawn.chain([(&branch, DESIGN)]) {
        let pieces = branch.pieces.iter();
        let line = |piece: &Vec<_>| Layer::line(piece.iter().copied(), stroke);
        layers.extend(pieces.map(|piece| line(piece).named(&branch.label)));
    }
    let mut mark = |point, shape, color, name: &str| {
        let mark = Layer::marks([point], shape, color).sized(7.0);
        layers.push(mark.named(legend(machine, name, point)));
        layers.push(Layer::label(point, name));
    };
    let optimum = (design.frequency(), design.before_impact_velocity());
    mark(optimum, Mark::Triangle, style::OPTIMUM, "optimum");
    if let Some(beside) = &beside {
        let name = format!("point {}", beside.name);
        mark(beside.point, Mark::Circle, style::POINT, &name);
    }

    let velocity = machine.label("before-impact velocity", "X′₋", Dimension::Velocity);
    let panel = Panel {
        size: (800.0, 480.0),
        x: Axis::new(machine.label_of(Parameter::Frequency)),
        y: Axis::new(velocity).from(0.0),
        layers,
        ..Panel::default()
    };
    let name = machine.name.as_deref().unwrap_or("given");
    let what = "before-impact velocity of the stable z = 1 motion in its hysteresis zone";
    let chart = Chart {
        subtitle: what.to_owned(),
        legend: Legend::Below,
        ..Chart::new(format!("Hardest impact of the {name} machine"), [panel])
    };
    chart.svg()
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
