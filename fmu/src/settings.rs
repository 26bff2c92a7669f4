//! Setting the values of an instance.

use softstop::flow::Polynomial;

use crate::error::Fault;
use crate::instance::{Force, Instance, Lifecycle, Pending};
use crate::start::StartValues;
use crate::units::Enumeration;
use crate::values::{Type, find};
use crate::variables::{Access, Kind, Variable};

impl Instance {
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
        let mut parameters = self.parameters;
        let mut force = None;
        for (&reference, &value) in references.iter().zip(values) {
            match find(reference, Type::Real)?.access {
                Access::Parameter { slot, .. } => parameters.set(slot, value),
                _ => force = Some(value),
            }
        }
        self.adopt(parameters)?;
        if let Some(value) = force {
            self.push(Polynomial::linear(value, 0.0));
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
            match &variable.kind {
                Kind::Enumeration(items) => check_item(variable.name, items, value)?,
                Kind::Count { min, max } => check_count(variable.name, *min, *max, value)?,
                Kind::Real(_) | Kind::Boolean => {}
            }
        }
        let mut parameters = self.parameters;
        for (&reference, &value) in references.iter().zip(values) {
            if let Access::Parameter { slot, .. } = find(reference, Type::Integer)?.access {
                parameters.set(slot, f64::from(value));
            }
        }
        self.adopt(parameters)
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
        let mut parameters = self.parameters;
        let mut material = self.material;
        for (&reference, &value) in references.iter().zip(values) {
            match find(reference, Type::Boolean)?.access {
                Access::Parameter { slot, .. } => {
                    parameters.set(slot, f64::from(u8::from(value != 0)));
                }
                _ => material = value != 0,
            }
        }
        self.adopt(parameters)?;
        if material != self.material {
            self.material = material;
            self.changed();
        }
        if let Some(simulation) = &mut self.simulation {
            simulation.feed_strip(material);
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

    /// Takes over parameters, unless the motion under way cannot go on with them.
    fn adopt(&mut self, parameters: StartValues) -> Result<(), Fault> {
        if parameters == self.parameters {
            return Ok(());
        }
        if self.lifecycle() == Lifecycle::Running
            && let Some(simulation) = &self.simulation
        {
            simulation.clone().tune(&parameters.scene())?;
        }
        self.parameters = parameters;
        self.changed().tuning = true;
        Ok(())
    }

    /// Notes that something was set: a running motion takes it over later, another begins anew.
    fn changed(&mut self) -> &mut Pending {
        if self.lifecycle() != Lifecycle::Running {
            self.simulation = None;
        }
        &mut self.pending
    }

    /// The force from now on; setting what holds anyway changes nothing.
    pub(crate) fn push(&mut self, polynomial: Polynomial) {
        if let Some(simulation) = &mut self.simulation {
            simulation.mark();
        }
        let now = self.time();
        if self.force.seen_from(now) == polynomial {
            return;
        }
        self.force = Force {
            polynomial,
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
    Err(Fault::OutOfRange {
        name,
        value: f64::from(value),
        allowed: available.join(" or "),
    })
}

fn check_count(name: &'static str, min: i32, max: Option<i32>, value: i32) -> Result<(), Fault> {
    if value >= min && max.is_none_or(|max| value <= max) {
        return Ok(());
    }
    Err(Fault::OutOfRange {
        name,
        value: f64::from(value),
        allowed: match max {
            Some(max) => format!("within {min} and {max}"),
            None => format!("at least {min}"),
        },
    })
}
