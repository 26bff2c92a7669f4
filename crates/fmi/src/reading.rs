//! Finding and reading the values of an instance.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::unit::{Row, Unit};
use crate::variable::{Access, Kind};

/// The type that a function of the standard serves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Type {
    Real,
    Integer,
    Boolean,
    String,
}

impl Type {
    const fn name(self) -> &'static str {
        match self {
            Self::Real => "Real",
            Self::Integer => "Integer",
            Self::Boolean => "Boolean",
            Self::String => "String",
        }
    }

    const fn serves(self, kind: &Kind) -> bool {
        matches!(
            (self, kind),
            (Self::Real, Kind::Real(_))
                | (Self::Integer, Kind::Count { .. } | Kind::Enumeration(_))
                | (Self::Boolean, Kind::Boolean)
        )
    }
}

pub(crate) fn find<U: Unit>(reference: u32, wanted: Type) -> Result<&'static Row<U>, Fault> {
    let variable = U::about().table.by_reference(reference);
    let variable = variable.ok_or(Fault::UnknownReference { reference })?;
    if wanted.serves(&variable.kind) {
        Ok(variable)
    } else {
        Err(Fault::WrongType {
            name: variable.name,
            reference,
            actual: variable.kind.type_name(),
            wanted: wanted.name(),
        })
    }
}

impl<U: Unit> Instance<U> {
    /// Reads or sets strings, of which there are none.
    pub(crate) fn strings(&self, references: &[u32]) -> Result<(), Fault> {
        let mut references = references.iter();
        references.try_for_each(|&reference| find::<U>(reference, Type::String).map(drop))
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
            outputs |= find::<U>(reference, wanted)?.is_output();
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
            Access::Signal(number) => Ok(self.signals[*number].at(self.time())),
            Access::Continuous { value, .. } | Access::Discrete { value, .. } => Ok(value(unit()?)),
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
            Lifecycle::Initializing | Lifecycle::Running => self.settle().map(drop),
            Lifecycle::Failed | Lifecycle::Terminated => Ok(()),
        }
    }
}
