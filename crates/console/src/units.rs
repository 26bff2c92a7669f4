//! The names of units.

use std::collections::BTreeMap;

use softstop::{Dimension, Machine, Parameter, UnitSystem};

/// What a number is one of; [`Units`] has the names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A word, a count, a ratio.
    None,
    /// The same for all machines.
    Of(&'static str),
    /// The machine's own of what is measured.
    Own(Dimension),
}

/// The signs of the units that a machine is stated in; empty where its numbers are ratios.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units(UnitSystem);

impl Units {
    /// Of a machine in SI units.
    pub const SI: Self = Self(UnitSystem::Si);

    /// Those that a machine is stated in.
    pub const fn of(machine: &Machine) -> Self {
        Self(machine.unit_system)
    }

    /// The sign of a unit.
    pub const fn name(&self, unit: Unit) -> &'static str {
        match unit {
            Unit::None => "",
            Unit::Of(name) => name,
            Unit::Own(dimension) => self.0.unit(dimension),
        }
    }

    /// What something is called, with its unit: `position (m)`.
    pub fn label(&self, name: &str, unit: Unit) -> String {
        match self.name(unit) {
            "" => name.to_owned(),
            unit => format!("{name} ({unit})"),
        }
    }
}

/// The unit of a quantity by its name in JSON: that of a ratio, too.
pub const fn name(machine: &Machine, dimension: Dimension) -> &'static str {
    match (machine.unit_system, dimension) {
        (UnitSystem::Ratios, Dimension::Mass) => "m",
        (UnitSystem::Ratios, Dimension::Stiffness) => "k1",
        (UnitSystem::Ratios, Dimension::Damping) => "2 sqrt(m k1)",
        (UnitSystem::Ratios, Dimension::Force) => "F0",
        (UnitSystem::Ratios, Dimension::Frequency) => "sqrt(k1/m)",
        (UnitSystem::Ratios, Dimension::Length) => "F0/k1",
        (UnitSystem::Ratios, Dimension::Velocity) => "F0/sqrt(m k1)",
        (UnitSystem::Ratios, Dimension::Time) => "sqrt(m/k1)",
        (UnitSystem::Ratios, Dimension::Energy) => "F0^2/k1",
        (UnitSystem::Ratios, Dimension::Power) => "F0^2/sqrt(m k1)",
        (UnitSystem::Ratios, Dimension::Slowness) => "sqrt(m k1)/F0",
        (UnitSystem::Ratios, other) => other.unit(),
        _ => machine.unit(dimension),
    }
}

/// The unit of a parameter by its name in JSON.
pub fn of_parameter(machine: &Machine, parameter: Parameter) -> &'static str {
    let is_power = machine.is_of_power_law(parameter);
    match (parameter, machine.unit_system) {
        (Parameter::Preload, _) if machine.preload_deflection.is_some() => {
            name(machine, Dimension::Length)
        }
        (_, UnitSystem::Ratios) if is_power => "F0 (k1/F0)^exponent",
        _ if is_power => "N/m^exponent",
        _ => name(machine, parameter.about().dimension),
    }
}

/// The units of a machine's parameters and results, by what they measure.
pub fn names(machine: &Machine) -> BTreeMap<&'static str, &'static str> {
    let all = [
        ("length", Dimension::Length),
        ("velocity", Dimension::Velocity),
        ("frequency", Dimension::Frequency),
        ("angle", Dimension::Angle),
        ("force", Dimension::Force),
        ("time", Dimension::Time),
        ("energy", Dimension::Energy),
        ("mass", Dimension::Mass),
        ("stiffness", Dimension::Stiffness),
        ("damping", Dimension::Damping),
        ("slowness", Dimension::Slowness),
    ];
    let all = all.map(|(what, dimension)| (what, name(machine, dimension)));
    let stops = [Parameter::StopStiffness, Parameter::BelowStiffness].into_iter();
    let power = stops.filter(|it| machine.is_of_power_law(*it));
    let power = power.map(|it| (it.name(), of_parameter(machine, it)));
    all.into_iter().chain(power).collect()
}
