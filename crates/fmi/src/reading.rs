//! Finding and reading the values of an instance.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::standard::Standard;
use crate::table::TIME_REFERENCE;
use crate::unit::{Row, Unit};
use crate::variable::Access;
use crate::{rows, si};

/// A type of values, for which a standard has functions of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Type {
    pub standard: Standard,
    /// Its name in those of the functions.
    pub name: &'static str,
}

impl Type {
    /// Real numbers of FMI 2.0.
    pub(crate) const REAL: Self = Self::of(Standard::Fmi2, "Real");

    /// The type that functions of a standard name so.
    pub(crate) const fn of(standard: Standard, name: &'static str) -> Self {
        Self { standard, name }
    }
}

pub(crate) fn find<U: Unit>(reference: u32, wanted: Type) -> Result<&'static Row<U>, Fault> {
    let variable = match (reference, wanted.standard) {
        (TIME_REFERENCE, Standard::Fmi3) => Some(&Instance::<U>::TIME),
        _ => U::about().table.by_reference(reference),
    };
    let variable = variable.ok_or(Fault::UnknownReference { reference })?;
    if variable.kind.value_type(wanted.standard) == wanted.name {
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
        self.not_allowed("outputs can be read from fmi2EnterInitializationMode on")
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
