//! What stands against a design, in words: bounds, and which of them are violated.

use softstop::internals::plain_number;
use softstop::{Dimension, Machine, Parameter};

use super::judge::RequirementValue;
use super::requirement::Requirement;

/// Share of a bound within which a requirement holds a design back.
const AT_BOUND: f64 = 1e-4;

/// What is violated and by how much, and which bounds stand in the way, in the machine's own units.
pub fn conflict(machine: &Machine, met: &[RequirementValue]) -> String {
    let violated = met.iter().filter(|it| !it.is_met());
    let violated: Vec<String> = violated.map(|it| words(machine, it)).collect();
    let held = met.iter().filter(|it| {
        let bound = it.value - it.margin();
        it.is_met() && it.margin() <= AT_BOUND * bound.abs()
    });
    let held: Vec<&str> = held.map(|it| it.requirement.figure.name()).collect();
    let violated = violated.join("; ");
    match &held[..] {
        [] => violated,
        held => format!("{violated}; against it stands {}", held.join(", ")),
    }
}

/// `velocity = 9.8 m/s: must be at least 10 m/s, 0.2 m/s are missing`.
fn words(machine: &Machine, met: &RequirementValue) -> String {
    let figure = met.requirement.figure;
    let own = |value: f64| format_in_own_unit(machine, figure.dimension(), value);
    let (name, bound) = (figure.name(), bound(machine, &met.requirement));
    match met.value {
        value if value.is_nan() => format!("{name} has no value: must be {bound}"),
        value if value.is_infinite() => {
            let why = figure.unbounded_reason();
            format!("{name} has no bound ({why}): must be {bound}")
        }
        value => format!(
            "{name} = {}: must be {bound}, by {}",
            own(value),
            own(-met.margin())
        ),
    }
}

/// `within the tolerances stop_force goes to 528 N: must be at most 500 N`.
pub(super) fn violated_within(machine: &Machine, requirement: &Requirement, worst: f64) -> String {
    let figure = requirement.figure;
    format!(
        "within the tolerances {} goes to {}: must be {}",
        figure.name(),
        format_in_own_unit(machine, figure.dimension(), worst),
        bound(machine, requirement)
    )
}

/// A value in SI units as a machine states it: `9.8 m/s`.
pub fn format_in_own_unit(machine: &Machine, dimension: Dimension, value: f64) -> String {
    let value = short(machine.to_own(dimension, value));
    let text = format!("{value} {}", machine.unit(dimension));
    text.trim_end().to_owned()
}

/// A parameter of a machine with a value in its own units: `clearance = 0.01 m`.
pub fn stated(machine: &Machine, parameter: Parameter, value: f64) -> String {
    let (name, unit) = (machine.name(parameter), machine.unit_of(parameter));
    format!("{name} = {} {unit}", short(value))
        .trim_end()
        .to_owned()
}

/// A number with seven digits, and no more of them than it has.
pub fn short(value: f64) -> String {
    plain_number(format!("{value:.6e}").parse().unwrap_or(value))
}

/// `at least 10 m/s`.
pub fn bound(machine: &Machine, requirement: &Requirement) -> String {
    let figure = requirement.figure;
    let unit = machine.unit(figure.dimension());
    let own = |value: f64| short(machine.to_own(figure.dimension(), value));
    let text = match (requirement.least.map(own), requirement.most.map(own)) {
        (Some(least), Some(most)) => format!("from {least} to {most} {unit}"),
        (Some(least), None) => format!("at least {least} {unit}"),
        (None, Some(most)) => format!("at most {most} {unit}"),
        (None, None) => String::new(),
    };
    text.trim_end().to_owned()
}
