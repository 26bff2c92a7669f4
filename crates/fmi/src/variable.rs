//! A row of the table of variables: what a unit offers, and how its value is had.

use crate::quantity::{Enumeration, Quantity};
use crate::standard::Standard;

/// One row: one variable of the unit `U`, whose derivatives along a direction are held in `T`.
#[derive(Debug)]
pub struct Variable<U: 'static, T> {
    /// Value reference, unique among all variables and below 256.
    pub reference: u32,
    /// Public name.
    pub name: &'static str,
    /// What it means, in one sentence.
    pub description: &'static str,
    /// Its type, with unit and range.
    pub kind: Kind,
    /// What it is, and how its value is had.
    pub access: Access<U, T>,
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
    /// Name of the type, as in the XML of a standard.
    pub const fn type_name(&self, standard: Standard) -> &'static str {
        match (self, standard) {
            (Self::Real(_), Standard::Fmi2) => "Real",
            (Self::Real(_), Standard::Fmi3) => "Float64",
            (Self::Count { .. }, Standard::Fmi2) => "Integer",
            (Self::Count { .. }, Standard::Fmi3) => "Int32",
            (Self::Boolean, _) => "Boolean",
            (Self::Enumeration(_), _) => "Enumeration",
        }
    }

    /// Name of its values' type in those of the functions of a standard that read them.
    pub(crate) const fn value_type(&self, standard: Standard) -> &'static str {
        match (self, standard) {
            (Self::Enumeration(_), Standard::Fmi2) => "Integer",
            (Self::Enumeration(_), Standard::Fmi3) => "Int64",
            _ => self.type_name(standard),
        }
    }

    /// The order of magnitude of its values.
    pub fn nominal(&self) -> f64 {
        match self {
            Self::Real(kind) => kind.nominal.unwrap_or(1.0),
            _ => 1.0,
        }
    }

    /// Whether a variable of this type can have this value; an enumeration's is its number, and every
    /// number stands for a Boolean.
    pub fn contains(&self, value: f64) -> bool {
        match self {
            Self::Real(kind) => kind.contains(value),
            Self::Count { min, max } => {
                value >= f64::from(*min) && max.is_none_or(|max| value <= f64::from(max))
            }
            Self::Boolean => true,
            Self::Enumeration(of) => of.items.iter().any(|item| f64::from(item.value) == value),
        }
    }

    /// The values that it can have, in words.
    pub fn range(&self) -> String {
        match self {
            Self::Real(kind) => kind.range(),
            Self::Count { min, max: None } => format!("at least {min}"),
            Self::Count {
                min,
                max: Some(max),
            } => format!("within {min} and {max}"),
            Self::Boolean => "true or false".to_owned(),
            Self::Enumeration(of) => {
                let items = of.items.iter();
                let items: Vec<_> = items
                    .map(|item| format!("{} ({})", item.value, item.name))
                    .collect();
                items.join(" or ")
            }
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
    /// Any finite number, of this quantity if there is one.
    pub const fn any(quantity: Option<&'static Quantity>) -> Self {
        Self {
            quantity,
            display_unit: None,
            min: None,
            max: None,
            nominal: None,
        }
    }

    fn range(&self) -> String {
        match (self.min, self.max) {
            (Some(min), Some(max)) => format!("within {min:?} and {max:?}"),
            (Some(min), None) => format!("finite and at least {min:?}"),
            (None, Some(max)) => format!("finite and at most {max:?}"),
            (None, None) => "finite".to_owned(),
        }
    }

    fn contains(&self, value: f64) -> bool {
        value.is_finite()
            && self.min.is_none_or(|min| value >= min)
            && self.max.is_none_or(|max| value <= max)
    }
}

/// Where the value of a parameter or of a discrete input is held: its place among the values that a
/// unit begins with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slot(pub usize);

impl Slot {
    /// The slot of an array's element, counted from 0; this one is that of its first.
    pub const fn element(self, index: usize) -> Self {
        Self(self.0 + index)
    }
}

/// Numbers the slots of a unit, each with the value that it begins with; of an array, which has so many elements, the first
/// ones are given, and the others begin with 0. `SLOTS` is their number, `START` what they begin with.
#[macro_export]
macro_rules! slots {
    ($($name:ident $([$length:expr])? = $($value:expr),+;)*) => {
        $crate::slots! { @at 0; $($name [$($length)?])* }
        /// What the slots begin with.
        pub const START: [f64; SLOTS] = {
            let mut values = [0.0; SLOTS];
            $(
                let (given, mut index) = ([$($value),+], 0);
                while index < given.len() {
                    values[$name.0 + index] = given[index];
                    index += 1;
                }
            )*
            values
        };
    };
    (@at $position:expr;) => {
        /// How many slots there are.
        pub const SLOTS: usize = $position;
    };
    (@at $position:expr; $name:ident [] $($more:tt)*) => {
        $crate::slots! { @at $position; $name [1] $($more)* }
    };
    (@at $position:expr; $name:ident [$length:expr] $($more:tt)*) => {
        pub const $name: $crate::variable::Slot = $crate::variable::Slot($position);
        $crate::slots! { @at $position + $length; $($more)* }
    };
}

/// How a real value of a unit is read.
pub type Value<U> = fn(&U) -> f64;
/// How a real value is read, and its order of magnitude.
pub type Scaled<U> = (Value<U>, f64);
/// How the derivative of a real value along a direction is read.
pub type Tangent<U, T> = fn(&T, Scaled<U>) -> f64;
/// How both are read.
pub type Reading<U, T> = (Value<U>, Tangent<U, T>);

/// What a variable is, and how its value is had.
#[derive(Debug)]
pub enum Access<U: 'static, T> {
    /// A parameter.
    Parameter {
        /// Where its value is held.
        slot: Slot,
        /// Whether it can be set between steps.
        tunable: bool,
    },
    /// Time, the independent variable.
    Time,
    /// A continuous input, by its number among these; it starts at 0.
    Signal(usize),
    /// A discrete input, with the place of its value.
    Input(Slot),
    /// A real output that varies continuously between events.
    Continuous {
        /// Its value.
        value: Value<U>,
        /// Its time derivatives, of order 1, 2, ...
        derivatives: &'static [Value<U>],
        /// Its derivative along a direction.
        tangent: Tangent<U, T>,
        /// What it depends on.
        depends: Dependencies,
    },
    /// A real number that varies continuously between events and that no other unit is meant to read.
    Local(Value<U>),
    /// A real output that changes at events only.
    Discrete {
        /// Its value.
        value: Value<U>,
        /// Its derivative along a direction.
        tangent: Tangent<U, T>,
        /// What it depends on.
        depends: Dependencies,
    },
    /// An integer, Boolean or enumeration output; it changes at events only.
    Integer {
        /// Its value.
        value: fn(&U) -> i32,
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

impl<U, T> Variable<U, T> {
    /// `causality` as in the XML.
    pub const fn causality(&self) -> &'static str {
        match self.access {
            Access::Parameter { .. } => "parameter",
            Access::Time => "independent",
            Access::Signal(_) | Access::Input(_) => "input",
            Access::Local(_) => "local",
            _ => "output",
        }
    }

    /// `variability` as in the XML.
    pub const fn variability(&self) -> &'static str {
        match self.access {
            Access::Parameter { tunable: true, .. } => "tunable",
            Access::Parameter { tunable: false, .. } => "fixed",
            Access::Signal(_) | Access::Continuous { .. } | Access::Local(_) | Access::Time => {
                "continuous"
            }
            Access::Input(_) | Access::Discrete { .. } | Access::Integer { .. } => "discrete",
        }
    }

    /// The array of parameters that this is an element of, and the element's number, counted from 1.
    pub fn element(&self) -> Option<(&'static str, usize)> {
        let (array, number) = self.name.strip_suffix(']')?.split_once('[')?;
        let is_parameter = matches!(self.access, Access::Parameter { .. });
        number
            .parse()
            .ok()
            .filter(|_| is_parameter)
            .map(|number| (array, number))
    }

    /// Where its value is held; continuous inputs and outputs have no such place.
    pub const fn slot(&self) -> Option<Slot> {
        match self.access {
            Access::Parameter { slot, .. } | Access::Input(slot) => Some(slot),
            _ => None,
        }
    }

    /// Whether its value follows from the motion.
    pub const fn is_calculated(&self) -> bool {
        self.is_output() || matches!(self.access, Access::Local(_))
    }

    /// Whether this is an output.
    pub const fn is_output(&self) -> bool {
        self.dependencies().is_some()
    }

    /// The dependencies of an output.
    pub const fn dependencies(&self) -> Option<&Dependencies> {
        match &self.access {
            Access::Continuous { depends, .. }
            | Access::Discrete { depends, .. }
            | Access::Integer { depends, .. } => Some(depends),
            _ => None,
        }
    }
}
