//! The names of units.

use softstop::{Language, Machine};

/// What a number is one of; [`Units`] has the names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A word, a count, a ratio.
    None,
    /// The same for all machines.
    Of(&'static str),
    /// Of a position.
    Length,
    /// Of a velocity.
    Velocity,
    /// Of the drive's angular frequency.
    Frequency,
    /// Of a force.
    Force,
}

/// The names of a machine's own units; empty where its numbers are ratios.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    length: &'static str,
    velocity: &'static str,
    frequency: &'static str,
    force: &'static str,
}

impl Units {
    /// Of a machine in SI units.
    pub const SI: Self = Self {
        length: "m",
        velocity: "m/s",
        frequency: "rad/s",
        force: "N",
    };
    /// Of the paper's ratios.
    pub const RATIOS: Self = Self {
        length: "",
        velocity: "",
        frequency: "",
        force: "",
    };

    /// Those that a machine speaks.
    #[must_use]
    pub const fn of(machine: &Machine) -> Self {
        match machine.speaks {
            Language::Ratios => Self::RATIOS,
            Language::Hertz => Self {
                frequency: "Hz",
                ..Self::SI
            },
            Language::Si => Self::SI,
        }
    }

    /// The name of a unit.
    #[must_use]
    pub const fn name(&self, unit: Unit) -> &'static str {
        match unit {
            Unit::None => "",
            Unit::Of(name) => name,
            Unit::Length => self.length,
            Unit::Velocity => self.velocity,
            Unit::Frequency => self.frequency,
            Unit::Force => self.force,
        }
    }

    /// What something is called, with its unit: `position (m)`.
    #[must_use]
    pub fn label(&self, name: &str, unit: Unit) -> String {
        match self.name(unit) {
            "" => name.to_owned(),
            unit => format!("{name} ({unit})"),
        }
    }
}
