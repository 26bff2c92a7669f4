//! Finding and reading the values of an instance.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::standard::Standard;
use crate::table::TIME_REFERENCE;
use crate::unit::{Row, Unit};
use crate::variable::{Access, Kind};
use crate::{rows, si};

/// A type of values, for which a standard has functions of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Type {
    pub standard: Standard,
    /// Its name in those of the functions.
    pub name: &'static str,
    /// Whether a variable of a kind is of this type.
    pub includes: fn(&Kind) -> bool,
}

impl Type {
    /// Real numbers of FMI 2.0.
    pub(crate) const REAL: Self = Self {
        standard: Standard::Fmi2,
        name: "Real",
        includes: |it| matches!(it, Kind::Real(_)),
    };
    /// Integers and enumerations of FMI 2.0.
    pub(crate) const INTEGER: Self = Self {
        standard: Standard::Fmi2,
        name: "Integer",
        includes: |it| matches!(it, Kind::Count { .. } | Kind::Enumeration(_)),
    };
    /// Booleans of FMI 2.0.
    pub(crate) const BOOLEAN: Self = Self {
        standard: Standard::Fmi2,
        name: "Boolean",
        includes: |it| matches!(it, Kind::Boolean),
    };

    /// One of which there are no variables.
    pub(crate) const fn none(standard: Standard, name: &'static str) -> Self {
        Self {
            standard,
            name,
            includes: |_| false,
        }
    }
}

pub(crate) fn find<U: Unit>(reference: u32, wanted: Type) -> Result<&'static Row<U>, Fault> {
    let variable = match (reference, wanted.standard) {
        (TIME_REFERENCE, Standard::Fmi3) => Some(&Instance::<U>::TIME),
        _ => U::about().table.by_reference(reference),
    };
    let variable = variable.ok_or(Fault::UnknownReference { reference })?;
    if (wanted.includes)(&variable.kind) {
        Ok(variable)
    } else {
        Err(Fault::WrongType {
            name: variable.name,
            reference,
            actual: variable.kind.type_name(wanted.standard),
            wanted: wanted.name,
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
        match &variable.access {
            Access::Parameter { slot, .. } | Access::Input(slot) => Ok(self.values[slot.0]),
            Access::Time => Ok(self.time()),
            Access::Signal(number) => Ok(self.signals[*number].at(self.time())),
            Access::Continuous { value, .. }
            | Access::Discrete { value, .. }
            | Access::Local(value) => Ok(value(self.begun()?)),
            Access::Integer { value, .. } => Ok(f64::from(value(self.begun()?))),
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
