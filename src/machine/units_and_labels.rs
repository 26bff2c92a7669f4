//! The units in which a machine states its quantities, and the labels of its parameters.

use super::{Machine, UnitSystem};
use crate::error::SceneError;
use crate::scene::{Dimension, Parameter};

impl Machine {
    /// The value in the machine's own unit of a quantity in SI units.
    pub fn to_own(&self, dimension: Dimension, value: f64) -> f64 {
        value / self.own_unit_in_si(dimension)
    }

    /// The value in SI units of a quantity in the machine's own unit.
    pub fn to_si(&self, dimension: Dimension, value: f64) -> f64 {
        value * self.own_unit_in_si(dimension)
    }

    /// An error of the scene, whose numbers are in SI units, as this machine states it: that of time scales that lie too far apart,
    /// the only one with numbers, in its own units.
    pub(super) fn scene_error_in_own_units(&self, error: SceneError) -> SceneError {
        match error {
            SceneError::TimeScales {
                name,
                value,
                bound,
                limit,
            } => {
                let parameter = Parameter::named(name);
                let dimension =
                    parameter.map_or(Dimension::Number, |parameter| parameter.about().dimension);
                SceneError::TimeScales {
                    name: parameter.map_or(name, |parameter| self.name(parameter)),
                    value: self.to_own(dimension, value),
                    bound,
                    limit: self.to_own(dimension, limit),
                }
            }
            error => error,
        }
    }

    /// The machine's own unit of a dimension, in SI units.
    const fn own_unit_in_si(&self, dimension: Dimension) -> f64 {
        match (self.unit_system, dimension) {
            (UnitSystem::Ratios, Dimension::Damping) => 2.0,
            (UnitSystem::Hertz, Dimension::Frequency) => std::f64::consts::TAU,
            _ => 1.0,
        }
    }

    /// The sign of the machine's own unit of a dimension; empty for bare numbers.
    pub const fn unit(&self, dimension: Dimension) -> &'static str {
        self.unit_system.unit(dimension)
    }

    /// True if a parameter is the stiffness of a power law.
    pub fn is_of_power_law(&self, parameter: Parameter) -> bool {
        let exponent = match parameter {
            Parameter::StopStiffness => Parameter::Exponent,
            Parameter::BelowStiffness => Parameter::BelowExponent,
            _ => return false,
        };
        exponent.get(&self.scene).is_some()
    }

    /// The sign of the unit in which the machine states a parameter; empty for bare numbers.
    pub fn unit_of(&self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::Preload if self.preload_deflection.is_some() => self.unit(Dimension::Length),
            _ if self.is_of_power_law(parameter) => "N/m^exponent",
            _ => self.unit(parameter.about().dimension),
        }
    }

    /// The label of an axis or a column: what it is, with its unit in brackets, or with the paper's symbol
    /// if the machine is stated in ratios.
    pub fn label(&self, what: &str, symbol: &str, dimension: Dimension) -> String {
        self.label_with_unit(what, symbol, self.unit(dimension))
    }

    /// What a parameter is, as this machine states it, and its symbol in the paper; empty if it has none there.
    pub fn meaning_of(&self, parameter: Parameter) -> (&'static str, &'static str) {
        let about = parameter.about();
        match parameter {
            Parameter::Preload if self.preload_deflection.is_some() => {
                ("preload of the stop as a deflection", "Fₚ/k₄")
            }
            _ if self.is_of_power_law(parameter) => (about.meaning, ""),
            _ => (about.meaning, about.symbol),
        }
    }

    /// The label of a parameter.
    pub fn label_of(&self, parameter: Parameter) -> String {
        let (what, symbol) = self.meaning_of(parameter);
        self.label_with_unit(what, symbol, self.unit_of(parameter))
    }

    /// A label with unit or symbol, as [`Machine::label`].
    fn label_with_unit(&self, what: &str, symbol: &str, unit: &str) -> String {
        match (self.unit_system, unit) {
            (UnitSystem::Ratios, _) if !symbol.is_empty() => format!("{what} {symbol}"),
            (_, "") => what.to_owned(),
            (_, unit) => format!("{what} ({unit})"),
        }
    }
}
