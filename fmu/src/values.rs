//! Reading and setting the values of an instance.

use crate::error::Fault;
use crate::instance::{Instance, Lifecycle};
use crate::units::Enumeration;
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
                | (Self::Integer, Kind::Count | Kind::Enumeration(_))
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
                Access::Continuous { value, .. } | Access::Discrete(value) => view.map(value),
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
                Access::Parameter { slot, .. } => Some(instance.parameters.get(*slot) as i32),
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
            |instance, variable, _| {
                matches!(variable.access, Access::Material).then_some(i32::from(instance.material))
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

    /// Sets real values: all of them, or none if one is refused.
    ///
    /// # Errors
    /// For an unknown or wrong reference, a value out of range, an output, and a fixed parameter
    /// after initialisation.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Fault> {
        self.require_settable()?;
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Type::Real)?;
            self.check_settable(variable)?;
            if let Kind::Real(kind) = &variable.kind
                && !kind.contains(value)
            {
                return Err(Fault::OutOfRange {
                    name: variable.name,
                    value,
                    allowed: kind.range(),
                });
            }
        }
        for (&reference, &value) in references.iter().zip(values) {
            match find(reference, Type::Real)?.access {
                Access::Parameter { slot, .. } => {
                    if self.parameters.get(slot) != value {
                        self.parameters.set(slot, value);
                        self.changed().tuning = true;
                    }
                }
                _ => self.push(value, 0.0),
            }
        }
        Ok(())
    }

    /// Sets integers and enumerations: all of them, or none if one is refused.
    ///
    /// # Errors
    /// As [`Instance::set_real`].
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Result<(), Fault> {
        self.require_settable()?;
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Type::Integer)?;
            self.check_settable(variable)?;
            if let Kind::Enumeration(items) = variable.kind {
                check_item(variable.name, items, value)?;
            }
        }
        for (&reference, &value) in references.iter().zip(values) {
            if let Access::Parameter { slot, .. } = find(reference, Type::Integer)?.access {
                self.parameters.set(slot, f64::from(value));
                self.changed().tuning = true;
            }
        }
        Ok(())
    }

    /// Sets Booleans; every number but 0 means true.
    ///
    /// # Errors
    /// As [`Instance::set_real`].
    pub fn set_boolean(&mut self, references: &[u32], values: &[i32]) -> Result<(), Fault> {
        self.require_settable()?;
        for &reference in references {
            self.check_settable(find(reference, Type::Boolean)?)?;
        }
        if let Some(&value) = values.last() {
            self.material = value != 0;
            if let Some(simulation) = &mut self.simulation {
                simulation.feed_strip(self.material);
            }
        }
        Ok(())
    }

    pub(crate) fn require_settable(&self) -> Result<(), Fault> {
        self.require(
            &[
                Lifecycle::Instantiated,
                Lifecycle::Initializing,
                Lifecycle::Running,
            ],
            "values can be set again after fmi2Reset",
        )
    }

    fn check_settable(&self, variable: &Variable) -> Result<(), Fault> {
        let name = variable.name;
        match variable.access {
            Access::Parameter { tunable: false, .. } if self.lifecycle() == Lifecycle::Running => {
                Err(Fault::Fixed { name })
            }
            Access::Parameter { .. } | Access::Force | Access::Material => Ok(()),
            _ => Err(Fault::Output { name }),
        }
    }

    /// Notes that something was set: a running motion takes it over later, another begins anew.
    fn changed(&mut self) -> &mut crate::instance::Pending {
        if self.lifecycle() != Lifecycle::Running {
            self.simulation = None;
        }
        &mut self.pending
    }

    /// The force from now on; setting what holds anyway changes nothing.
    pub(crate) fn push(&mut self, value: f64, rate: f64) {
        let now = self.time();
        if self.force.at(now) == value && self.force.rate == rate {
            return;
        }
        self.force = crate::instance::Force {
            value,
            rate,
            since: now,
        };
        self.changed().force = true;
    }
}

fn check_item(name: &'static str, items: &Enumeration, value: i32) -> Result<(), Fault> {
    if items.items.iter().any(|item| item.value == value) {
        return Ok(());
    }
    let available: Vec<_> = items
        .items
        .iter()
        .map(|item| format!("{} ({})", item.value, item.name))
        .collect();
    let reserved = items
        .reserved
        .iter()
        .find(|(number, _)| *number == value)
        .map_or(String::new(), |(_, name)| {
            format!(", {name} is not available yet")
        });
    Err(Fault::OutOfRange {
        name,
        value: f64::from(value),
        allowed: format!("{}{reserved}", available.join(" or ")),
    })
}
