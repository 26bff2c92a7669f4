//! Reads a machine from the table that its TOML file is.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, Error, ValueDeserializer};

use super::{Machine, UnitSystem, keys};
use crate::error::MachineError;
use crate::integrator::Start;
use crate::scene::{Parameter, Scene};

type Value<'a> = Spanned<DeValue<'a>>;

/// Name of the table of ratios.
pub(super) const RATIOS_TABLE: &str = "ratios";

/// The table `[initial]`.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Initial {
    position: f64,
    velocity: f64,
}

/// An error of TOML, or of what the machine is.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub(super) enum ReadError {
    Toml(#[from] Error),
    Machine(#[from] MachineError),
}

fn deserialize_value<T: DeserializeOwned>(value: Value<'_>) -> Result<T, Error> {
    T::deserialize(ValueDeserializer::from(value))
}

/// Takes a value out of a table.
fn take_value<T: DeserializeOwned>(table: &mut DeTable<'_>, key: &str) -> Result<Option<T>, Error> {
    table.remove(key).map(deserialize_value).transpose()
}

/// The table of this name in a table.
fn inner_table<'t, 'a>(table: &'t mut DeTable<'a>, key: &str) -> Option<&'t mut DeTable<'a>> {
    match table.get_mut(key)?.get_mut() {
        DeValue::Table(inner) => Some(inner),
        _ => None,
    }
}

/// Puts values into a table that are not stated in it.
fn put_defaults(table: &mut DeTable<'_>, lines: &'static str) -> Result<(), Error> {
    table.extend(DeTable::parse(lines)?.into_inner());
    Ok(())
}

/// The machine that the table of a file states.
pub(super) fn read_table(
    mut file: Spanned<DeTable<'_>>,
    language: UnitSystem,
) -> Result<Machine, ReadError> {
    let table = file.get_mut();
    let name = take_value(table, "name")?;
    let description = take_value(table, "description")?;
    let mut initial = take_initial(table)?;
    if let Some(value) = table.remove(RATIOS_TABLE) {
        if let Some(key) = table.keys().next() {
            return Err(MachineError::BesideRatios(key.get_ref().to_string()).into());
        }
        let span = value.span();
        let DeValue::Table(ratios) = value.into_inner() else {
            return Err(MachineError::NoTable(RATIOS_TABLE).into());
        };
        file = Spanned::new(span, ratios);
        let table = file.get_mut();
        initial = match (initial, self::take_initial(table)?) {
            (Some(_), Some(_)) => {
                return Err(MachineError::Both("initial", "ratios.initial").into());
            }
            (beside, inside) => inside.or(beside),
        };
        put_defaults(table, "mass = 1.0\nstiffness = 1.0")?;
        if let Some(excitation) = inner_table(table, "excitation") {
            put_defaults(excitation, "amplitude = 1.0")?;
        }
    }
    rename_contact_damping(file.get_mut())?;
    rename_stop_below(file.get_mut());
    let keys = (keys::FREQUENCY_HZ, Parameter::Frequency.name());
    let hertz = take_other_statement(file.get_mut(), keys, "frequency = 1.0")?;
    let keys = (keys::PRELOAD_DEFLECTION, Parameter::Preload.name());
    let deflection = take_other_statement(file.get_mut(), keys, "preload = 0.0")?;
    let Initial { position, velocity } = initial.unwrap_or_default();
    let mut machine = Machine {
        name,
        description,
        start: Start::new(position, velocity),
        unit_system: hertz.map_or(language, |_| UnitSystem::Hertz),
        preload_deflection: deflection,
        ..Machine::from(Scene::deserialize(Deserializer::from(file))?)
    };
    if language == UnitSystem::Ratios {
        machine.scene.damping *= 2.0;
        machine.scene.contact_damping *= 2.0;
    }
    if let Some(hertz) = hertz {
        machine.set(Parameter::Frequency, hertz);
    }
    if let Some(deflection) = deflection {
        machine.set(Parameter::Preload, deflection);
    }
    Ok(machine)
}

/// Takes the table `[initial]` out, or `[start]` as it was once called.
fn take_initial(table: &mut DeTable<'_>) -> Result<Option<Initial>, ReadError> {
    match (take_value(table, "initial")?, take_value(table, "start")?) {
        (Some(_), Some(_)) => Err(MachineError::Both("initial", "start").into()),
        (initial, start) => Ok(initial.or(start)),
    }
}

/// Why a machine has a damping in contact.
const DAMPING_REASON: &str =
    "the damper while bodies touch; a rigid stop without a strip does not use it, 0 will do";

/// Renames `contact.damping`: it is the field `contact_damping` of a scene.
fn rename_contact_damping(table: &mut DeTable<'_>) -> Result<(), ReadError> {
    let damping = inner_table(table, "contact").and_then(|contact| contact.remove_entry("damping"));
    table.remove("contact");
    match (damping, table.contains_key("contact_damping")) {
        (Some(_), true) => Err(MachineError::Both("contact.damping", "contact_damping").into()),
        (None, false) => Err(MachineError::Missing("contact.damping", DAMPING_REASON).into()),
        (None, true) => Ok(()),
        (Some((key, damping)), false) => {
            table.insert(Spanned::new(key.span(), "contact_damping".into()), damping);
            Ok(())
        }
    }
}

/// Renames `stop.below`: it is the field `below` of a scene.
fn rename_stop_below(table: &mut DeTable<'_>) {
    let below = inner_table(table, "stop").and_then(|stop| stop.remove_entry("below"));
    table.extend(below);
}

/// A value that may be stated in another way: takes that out of its table and fills its place.
fn take_other_statement(
    file: &mut DeTable<'_>,
    (otherwise, key): (&'static str, &'static str),
    filled: &'static str,
) -> Result<Option<f64>, ReadError> {
    let split = |key: &'static str| key.split_once('.').unwrap_or(("", key));
    let (section, field) = split(otherwise);
    let Some(table) = inner_table(file, section) else {
        return Ok(None);
    };
    let value = take_value(table, field)?;
    if value.is_some() {
        if table.contains_key(split(key).1) {
            return Err(MachineError::Both(key, otherwise).into());
        }
        put_defaults(table, filled)?;
    }
    Ok(value)
}
