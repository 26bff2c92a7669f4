//! Finding and reading the values of an instance.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::standard::Standard;
use crate::table::TIME_REFERENCE;
use crate::unit::{Row, Unit};
use crate::variable::{Access, Kind};
use crate::{rows, si};

/// The type that a function of a standard serves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    /// Of FMI 2.0.
    Real,
    /// Of FMI 2.0, enumerations included.
    Integer,
    /// Of FMI 2.0.
    Boolean,
    /// Of FMI 2.0.
    String,
    /// Of FMI 3.0.
    Float64,
    /// Of FMI 3.0.
    Int32,
    /// Of FMI 3.0: enumerations.
    Int64,
    /// `Boolean` of FMI 3.0.
    Truth,
    /// Another one of FMI 3.0, of which there are no variables.
    Other(&'static str),
}

impl Type {
    const fn name(self) -> &'static str {
        match self {
            Self::Real => "Real",
            Self::Integer => "Integer",
            Self::Boolean | Self::Truth => "Boolean",
            Self::String => "String",
            Self::Float64 => "Float64",
            Self::Int32 => "Int32",
            Self::Int64 => "Int64",
            Self::Other(name) => name,
        }
    }

    /// The standard that the function is of.
    const fn standard(self) -> Standard {
        match self {
            Self::Real | Self::Integer | Self::Boolean | Self::String => Standard::Fmi2,
            _ => Standard::Fmi3,
        }
    }

    const fn serves(self, kind: &Kind) -> bool {
        matches!(
            (self, kind),
            (Self::Real | Self::Float64, Kind::Real(_))
                | (Self::Integer | Self::Int32, Kind::Count { .. })
                | (Self::Integer | Self::Int64, Kind::Enumeration(_))
                | (Self::Boolean | Self::Truth, Kind::Boolean)
        )
    }
}

pub(crate) fn find<U: Unit>(reference: u32, wanted: Type) -> Result<&'static Row<U>, Fault> {
    let variable = match (reference, wanted.standard()) {
        (TIME_REFERENCE, Standard::Fmi3) => Some(&Instance::<U>::TIME),
        _ => U::about().table.by_reference(reference),
    };
    let variable = variable.ok_or(Fault::UnknownReference { reference })?;
    if wanted.serves(&variable.kind) {
        Ok(variable)
    } else {
        Err(Fault::WrongType {
            name: variable.name,
            reference,
            actual: variable.kind.type_name(wanted.standard()),
            wanted: wanted.name(),
        })
    }
}

impl<U: Unit> Instance<U> {
    /// The independent variable of FMI 3.0.
    pub(crate) const TIME: Row<U> = rows::row(
        TIME_REFERENCE,
        "time",
        rows::real(&si::TIME),
        Access::Time,
        "Time",
    );

    /// Reads or sets variables of a type of which there are none.
    pub(crate) fn none_of(&self, wanted: Type, references: &[u32]) -> Result<(), Fault> {
        let mut references = references.iter();
        references.try_for_each(|&reference| find::<U>(reference, wanted).map(drop))
    }

    /// Reads values of one type, a Boolean as 0 or 1.
    pub(crate) fn read<T>(
        &mut self,
        references: &[u32],
        values: &mut [T],
        wanted: Type,
        typed: impl Fn(f64) -> T,
    ) -> Result<(), Fault> {
        let mut outputs = false;
        for &reference in references {
            outputs |= find::<U>(reference, wanted)?.is_calculated();
        }
        if outputs {
            self.ready_for_outputs()?;
        }
        for (&reference, value) in references.iter().zip(values) {
            *value = typed(self.value(find(reference, wanted)?)?);
        }
        Ok(())
    }

    fn value(&self, variable: &Row<U>) -> Result<f64, Fault> {
        let unit = || self.unit.as_ref().ok_or_else(|| self.no_outputs());
        match &variable.access {
            Access::Parameter { slot, .. } | Access::Input(slot) => Ok(self.values[slot.0]),
            Access::Time => Ok(self.time()),
            Access::Signal(number) => Ok(self.signals[*number].at(self.time())),
            Access::Continuous { value, .. }
            | Access::Discrete { value, .. }
            | Access::Local(value) => Ok(value(unit()?)),
            Access::Integer { value, .. } => Ok(f64::from(value(unit()?))),
        }
    }

    pub(crate) fn no_outputs(&self) -> Fault {
        Fault::WrongState {
            state: self.lifecycle,
            remedy: "outputs can be read from fmi2EnterInitializationMode on",
        }
    }

    pub(crate) fn ready_for_outputs(&mut self) -> Result<(), Fault> {
        match self.lifecycle {
            Lifecycle::Instantiated => Err(self.no_outputs()),
            Lifecycle::Initializing | Lifecycle::Running | Lifecycle::Event => {
                self.settle().map(drop)
            }
            Lifecycle::Continuous => self.show(),
            Lifecycle::Intermediate
            | Lifecycle::Failed
            | Lifecycle::Erred
            | Lifecycle::Terminated => Ok(()),
        }
    }
}
