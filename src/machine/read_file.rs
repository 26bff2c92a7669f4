//! Reads machines from TOML files.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer, Error, ValueDeserializer};

use super::line_numbers::LineNumbers;
use super::{Machine, UnitSystem, keys, misspelt_keys};
use crate::error::{MachineError, SceneError};
use crate::integrator::Start;
use crate::scene::{Parameter, Scene, Stop};

type Value<'a> = Spanned<DeValue<'a>>;

/// Name of the table of ratios.
const RATIOS_TABLE: &str = "ratios";

/// The table `[initial]`.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Initial {
    position: f64,
    velocity: f64,
}

/// A key of the file and where it stands.
struct Place {
    /// The key as it is called now, in the table of ratios without its name.
    key: String,
    line: usize,
    /// The text of a value that is no number.
    word: Option<String>,
}

impl Machine {
    /// Tables of a machine file that say what `softstop optimize` is to do with the machine; they play no part in it.
    pub const TASK: [&str; 7] = keys::TASK_TABLES;

    /// Reads the text of a machine file: SI units, or a table `[ratios]`.
    ///
    /// # Errors
    /// [`MachineError`] with the line, the key, its value and what is allowed.
    pub fn from_toml(text: &str) -> Result<Self, MachineError> {
        let syntax = |mut error: Error| {
            error.set_input(Some(text));
            let (text, message) = (error.to_string(), error.message());
            let text = text
                .trim_end()
                .replace(message, &misspelt_keys::with_near_word(message));
            MachineError::Syntax(text)
        };
        let mut table = DeTable::parse(text).map_err(syntax)?;
        for task in Self::TASK {
            table.get_mut().remove(task);
        }
        let language = match table.get_ref().get(RATIOS_TABLE) {
            Some(_) => UnitSystem::Ratios,
            None => UnitSystem::Si,
        };
        let (mut places, mut ties) = (Vec::new(), Vec::new());
        collect_keys(
            table.get_mut(),
            "",
            &LineNumbers::new(text),
            &mut places,
            &mut ties,
        );
        places.sort_by_key(|place| place.line);
        refuse_unknown_keys(&places, language)?;
        refuse_non_numbers(&places)?;
        let mut machine = read_table(table, language).map_err(|error| match error {
            ReadError::Toml(error) => syntax(error),
            ReadError::Machine(error) => error,
        })?;
        let is_of_none = |place: &&Place| match keys::split_stop_key(&place.key) {
            None | Some((_, "model") | (true, "clearance")) => false,
            Some((false, _)) => machine.scene.stop == Stop::None,
            Some((true, _)) => {
                let below = machine.scene.below.as_ref();
                below.is_some_and(|below| below.stop == Stop::None)
            }
        };
        if let Some(place) = places.iter().find(is_of_none) {
            return Err(machine.key_error(&place.key, machine.file_keys()));
        }
        machine.tie_parameters(&ties)?;
        machine.validate().map_err(|source| MachineError::Value {
            line: line_of(&source, &places),
            source,
        })?;
        machine.check_texts()?;
        Ok(machine)
    }
}

impl Scene {
    /// Reads the scene of a machine file; [`Machine::from_toml`] reads its name, start and units, too.
    ///
    /// # Errors
    /// [`MachineError`] with the line, the key, its value and what is allowed.
    pub fn from_toml(text: &str) -> Result<Self, MachineError> {
        Machine::from_toml(text).map(|machine| machine.scene)
    }
}

/// Collects the keys of a table and of those in it. Expressions are taken out, each with its key and line.
fn collect_keys(
    table: &mut DeTable<'_>,
    path: &str,
    lines: &LineNumbers<'_>,
    places: &mut Vec<Place>,
    ties: &mut Vec<(String, String, Option<usize>)>,
) {
    for (name, value) in table {
        let key = match (path, name.get_ref().as_ref()) {
            ("", RATIOS_TABLE) => String::new(),
            ("", "start") => "initial".to_owned(),
            ("", "contact_damping") => Parameter::ContactDamping.name().to_owned(),
            ("", name) => name.to_owned(),
            (path, name) => format!("{path}.{name}"),
        };
        let line = lines.line_of(name.span().start);
        let text = &lines.text[value.span()];
        if let DeValue::Table(inner) = value.get_mut() {
            collect_keys(inner, &key, lines, places, ties);
            continue;
        }
        let expression = match value.get_ref() {
            DeValue::String(text) if is_number(&key) && keys::is_expression(text) => {
                Some(text.to_string())
            }
            _ => None,
        };
        if let Some(text) = expression {
            ties.push((key.clone(), text, Some(line)));
            *value.get_mut() = placeholder();
        }
        places.push(Place {
            key,
            line,
            word: match value.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) => None,
                _ => Some(text.to_owned()),
            },
        });
    }
}

/// Stands for the value of an expression until that is known.
fn placeholder() -> DeValue<'static> {
    let table = DeTable::parse("number = 1.0").map(Spanned::into_inner);
    let value = table.ok().and_then(|mut table| table.remove("number"));
    value.map_or(DeValue::Boolean(false), Spanned::into_inner)
}

/// True if a number stands under this key.
fn is_number(key: &str) -> bool {
    Parameter::named(key).is_some() || [keys::FREQUENCY_HZ, keys::PRELOAD_DEFLECTION].contains(&key)
}

/// Refuses a key that no machine has. A table in whose place something else stands is left to be found by its type.
fn refuse_unknown_keys(places: &[Place], language: UnitSystem) -> Result<(), MachineError> {
    let keys = keys::all_keys(language);
    let is_known = |place: &&Place| {
        let inner = format!("{}.", place.key);
        keys.iter()
            .any(|key| *key == place.key || key.starts_with(&inner))
    };
    let Some(place) = places.iter().find(|place| !is_known(place)) else {
        return Ok(());
    };
    if let Some((table, meant)) = misspelt_keys::meant_table(&place.key, &keys) {
        return Err(MachineError::UnknownTable {
            line: place.line,
            table: table.to_owned(),
            meant,
        });
    }
    Err(MachineError::UnknownKey {
        line: Some(place.line),
        key: place.key.clone(),
        meant: misspelt_keys::meant_key(&place.key, &keys),
        known: keys.join(", "),
    })
}

/// Refuses what is no number in a number's place.
fn refuse_non_numbers(places: &[Place]) -> Result<(), MachineError> {
    let wrong = |Place { key, line, word }: &Place| {
        Parameter::named(key)?;
        Some(MachineError::NotANumber {
            line: Some(*line),
            key: key.clone(),
            value: word.clone()?,
        })
    };
    places.iter().find_map(wrong).map_or(Ok(()), Err)
}

/// The line of the parameter that is out of range.
fn line_of(error: &SceneError, places: &[Place]) -> Option<usize> {
    let key = match error {
        SceneError::OutOfRange { name, .. } | SceneError::TimeScales { name, .. } => name,
        SceneError::EmptyPiercing { .. } => Parameter::Thickness.name(),
        SceneError::NoSlope => "stop.loading",
        SceneError::Slope { list, .. } => list,
        SceneError::GivesEnergy { .. } => "stop.unloading",
        SceneError::NoWay { .. } => Parameter::BelowClearance.name(),
        SceneError::Below(_) | SceneError::Lacks(_) => return None,
    };
    let place = places.iter().find(|place| place.key == key)?;
    Some(place.line)
}

/// An error of TOML, or of what the machine is.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
enum ReadError {
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
fn read_table(mut file: Spanned<DeTable<'_>>, language: UnitSystem) -> Result<Machine, ReadError> {
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
