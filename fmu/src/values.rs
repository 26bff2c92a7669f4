//! Finding and reading the values of an instance.

use crate::error::Fault;
use crate::instance::{Instance, Lifecycle};
use crate::variables::{Access, Kind, Variable, View, by_reference};

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

pub(crate) fn find(reference: u32, wanted: Type) -> Result<&'static Variable, Fault> {
    let variable = by_reference(reference).ok_or(Fault::UnknownReference { reference })?;
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

fn no_such(reference: u32, wanted: Type) -> Fault {
    find(reference, wanted)
        .err()
        .unwrap_or(Fault::UnknownReference { reference })
}

impl Instance {
    /// Reads real values.
    ///
    /// # Errors
    /// For an unknown or wrong reference, and for outputs before initialisation.
    pub fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Fault> {
        self.read(
            references,
            values,
            Type::Real,
            |instance, variable, view| match &variable.access {
                Access::Parameter { slot, .. } => Some(instance.parameters.get(*slot)),
                Access::Force => Some(instance.force.at(instance.time())),
                Access::Continuous { value, .. } | Access::Discrete { value, .. } => {
                    view.map(value)
                }
                _ => None,
            },
        )
    }

    /// Reads integers and enumerations.
    ///
    /// # Errors
    /// As [`Instance::get_real`].
    pub fn get_integer(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Fault> {
        self.read(
            references,
            values,
            Type::Integer,
            |instance, variable, view| match &variable.access {
                Access::Parameter { slot, .. } => Some(instance.parameters.number(*slot)),
                Access::Integer { value, .. } => view.map(value),
                _ => None,
            },
        )
    }

    /// Reads Booleans, as 0 and 1.
    ///
    /// # Errors
    /// As [`Instance::get_real`].
    pub fn get_boolean(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Fault> {
        self.read(
            references,
            values,
            Type::Boolean,
            |instance, variable, _| match &variable.access {
                Access::Parameter { slot, .. } => Some(instance.parameters.number(*slot)),
                Access::Material => Some(i32::from(instance.material)),
                _ => None,
            },
        )
    }

    /// Reads or sets strings, of which there are none.
    ///
    /// # Errors
    /// For any reference.
    pub fn strings(&self, references: &[u32]) -> Result<(), Fault> {
        match references {
            [] => Ok(()),
            [reference, ..] => Err(no_such(*reference, Type::String)),
        }
    }

    fn read<T>(
        &mut self,
        references: &[u32],
        values: &mut [T],
        wanted: Type,
        value_of: impl Fn(&Self, &Variable, Option<&View>) -> Option<T>,
    ) -> Result<(), Fault> {
        let mut outputs = false;
        for &reference in references {
            outputs |= find(reference, wanted)?.is_output();
        }
        if outputs {
            self.ready_for_outputs()?;
        }
        let view = self.simulation.as_ref().map(View::new);
        for (&reference, value) in references.iter().zip(values) {
            *value = value_of(self, find(reference, wanted)?, view.as_ref())
                .ok_or_else(|| no_such(reference, wanted))?;
        }
        Ok(())
    }

    pub(crate) fn ready_for_outputs(&mut self) -> Result<(), Fault> {
        match self.lifecycle() {
            Lifecycle::Instantiated => Err(Fault::WrongState {
                state: Lifecycle::Instantiated,
                remedy: "outputs can be read from fmi2EnterInitializationMode on",
            }),
            Lifecycle::Initializing | Lifecycle::Running => self.settle().map(drop),
            Lifecycle::Failed | Lifecycle::Terminated => Ok(()),
        }
    }
}
