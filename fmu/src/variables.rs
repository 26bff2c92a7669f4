//! The one table of variables: what the unit offers, and how each value is read.
//!
//! To add a variable, add a row to the table in `variables/table` (for a parameter also a
//! [`Slot`]); the XML, the documentation and the C functions follow. Value references are never
//! given to another variable.

mod table;

use std::cell::OnceCell;

use softstop::integrator::Rates;
use softstop::tangent::Sensitivity;
use softstop::{Energy, PhaseKind, Sample, Simulation};

use crate::start::Slot;
use crate::units::{Enumeration, Quantity};

pub use table::VARIABLES;

/// One row: one variable.
#[derive(Debug, Clone, Copy)]
pub struct Variable {
    /// Value reference, unique among all variables.
    pub reference: u32,
    /// Public name.
    pub name: &'static str,
    /// What it means, in one sentence.
    pub description: &'static str,
    /// Its type, with unit and range.
    pub kind: Kind,
    /// What it is, and how its value is had.
    pub access: Access,
}

/// The type of a variable.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A real number.
    Real(RealKind),
    /// A number of things.
    Count {
        /// Smallest allowed value.
        min: i32,
        /// Largest allowed value.
        max: Option<i32>,
    },
    /// Yes or no.
    Boolean,
    /// One of a few named items.
    Enumeration(&'static Enumeration),
}

impl Kind {
    /// Name of the type, as in the XML.
    pub const fn type_name(&self) -> &'static str {
        match self {
            Self::Real(_) => "Real",
            Self::Count { .. } => "Integer",
            Self::Boolean => "Boolean",
            Self::Enumeration(_) => "Enumeration",
        }
    }
}

/// Unit and range of a real variable.
#[derive(Debug, Clone, Copy)]
pub struct RealKind {
    /// The quantity with its unit; nothing if it is a bare number.
    pub quantity: Option<&'static Quantity>,
    /// Unit to show it in by default, if not its own.
    pub display_unit: Option<&'static str>,
    /// Smallest allowed value.
    pub min: Option<f64>,
    /// Largest allowed value.
    pub max: Option<f64>,
    /// Order of magnitude, if not 1.
    pub nominal: Option<f64>,
}

impl RealKind {
    /// The range in words.
    pub fn range(&self) -> String {
        match (self.min, self.max) {
            (Some(min), Some(max)) => format!("within {min:?} and {max:?}"),
            (Some(min), None) => format!("finite and at least {min:?}"),
            (None, Some(max)) => format!("finite and at most {max:?}"),
            (None, None) => "finite".to_owned(),
        }
    }

    /// Whether `value` is finite and within the range.
    pub fn contains(&self, value: f64) -> bool {
        value.is_finite()
            && self.min.is_none_or(|min| value >= min)
            && self.max.is_none_or(|max| value <= max)
    }
}

/// What a variable is, and how its value is had.
#[derive(Debug, Clone, Copy)]
pub enum Access {
    /// A parameter, held in its slot.
    Parameter {
        /// Where its value is held.
        slot: Slot,
        /// Whether it can be set between steps.
        tunable: bool,
    },
    /// The input `force`.
    Force,
    /// The input `material`.
    Material,
    /// An output that varies continuously between events.
    Continuous {
        /// Its value.
        value: fn(&View) -> f64,
        /// Its time derivatives, of order 1, 2, ...
        derivatives: &'static [fn(&View) -> f64],
        /// Its derivative along a direction.
        sensitivity: fn(&Sensitivity) -> f64,
        /// What it depends on.
        depends: Dependencies,
    },
    /// A real output that changes at events only.
    Discrete {
        /// Its value.
        value: fn(&View) -> f64,
        /// Its derivative along a direction.
        sensitivity: fn(&Sensitivity) -> f64,
    },
    /// An integer or enumeration output; it changes at events only.
    Integer {
        /// Its value.
        value: fn(&View) -> i32,
        /// What it depends on.
        depends: Dependencies,
    },
}

/// What an output depends on, by name.
///
/// The name of an array stands for all of its elements.
#[derive(Debug, Clone, Copy)]
pub struct Dependencies {
    /// Inputs that change it at once.
    pub inputs: &'static [&'static str],
    /// What its value at the start time depends on.
    pub initial: &'static [&'static str],
}

impl Variable {
    /// `causality` as in the XML.
    pub const fn causality(&self) -> &'static str {
        match self.access {
            Access::Parameter { .. } => "parameter",
            Access::Force | Access::Material => "input",
            _ => "output",
        }
    }

    /// `variability` as in the XML.
    pub const fn variability(&self) -> &'static str {
        match self.access {
            Access::Parameter { tunable: true, .. } => "tunable",
            Access::Parameter { tunable: false, .. } => "fixed",
            Access::Force | Access::Continuous { .. } => "continuous",
            Access::Material | Access::Discrete { .. } | Access::Integer { .. } => "discrete",
        }
    }

    /// Whether this is an output.
    pub const fn is_output(&self) -> bool {
        self.dependencies().is_some()
    }

    /// The dependencies of an output.
    pub const fn dependencies(&self) -> Option<&Dependencies> {
        match &self.access {
            Access::Continuous { depends, .. } | Access::Integer { depends, .. } => Some(depends),
            Access::Discrete { .. } => Some(&Dependencies {
                inputs: &[],
                initial: &[],
            }),
            _ => None,
        }
    }
}

/// The motion as the outputs see it: sampled once, however many outputs are read.
pub struct View<'a> {
    simulation: &'a Simulation,
    sample: OnceCell<Sample>,
    energy: OnceCell<Energy>,
    rates: OnceCell<Rates>,
}

impl<'a> View<'a> {
    /// Looks at the motion at its present time.
    pub fn new(simulation: &'a Simulation) -> Self {
        Self {
            simulation,
            sample: OnceCell::new(),
            energy: OnceCell::new(),
            rates: OnceCell::new(),
        }
    }

    pub(crate) fn sample(&self) -> &Sample {
        self.sample.get_or_init(|| self.simulation.sample())
    }

    fn rates(&self) -> &Rates {
        self.rates.get_or_init(|| self.simulation.rates())
    }

    fn energy(&self) -> &Energy {
        // On a copy, so that reading leaves no trace in the motion.
        self.energy.get_or_init(|| self.simulation.energy())
    }
}

fn phase_number(phase: PhaseKind) -> i32 {
    match phase {
        PhaseKind::Free => 1,
        PhaseKind::Pierce => 2,
        PhaseKind::Cut => 3,
        PhaseKind::Gap => 4,
        PhaseKind::Stop => 5,
        PhaseKind::Stuck => 6,
        PhaseKind::Resting => 7,
        PhaseKind::Released => 8,
        PhaseKind::Chatter => 9,
    }
}

/// Value references lie below this number.
const REFERENCES: usize = 256;
const NONE: u8 = u8::MAX;

static BY_REFERENCE: [u8; REFERENCES] = {
    let mut rows = [NONE; REFERENCES];
    let mut row = 0;
    while row < VARIABLES.len() {
        rows[VARIABLES[row].reference as usize] = row as u8;
        row += 1;
    }
    rows
};

/// The variable with this value reference.
pub fn by_reference(reference: u32) -> Option<&'static Variable> {
    let row = *BY_REFERENCE.get(usize::try_from(reference).ok()?)?;
    VARIABLES.get(usize::from(row))
}

/// The variable of this name.
pub fn by_name(name: &str) -> Option<&'static Variable> {
    VARIABLES.iter().find(|variable| variable.name == name)
}

/// Rows, counted from 0, of the variable of this name or of the elements of the array of this name.
pub fn rows_of(name: &str) -> impl Iterator<Item = usize> {
    let rows = VARIABLES.iter().enumerate();
    rows.filter_map(move |(row, variable)| {
        let rest = variable.name.strip_prefix(name)?;
        (rest.is_empty() || rest.starts_with('[')).then_some(row)
    })
}
