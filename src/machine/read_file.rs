//! Reads machines from TOML files.

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use super::line_numbers::LineNumbers;
use super::read_table::{RATIOS_TABLE, ReadError, read_table};
use super::{Machine, UnitSystem, keys, misspelt_keys};
use crate::error::{MachineError, SceneError};
use crate::scene::{Parameter, Scene, Stop};

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

/// Stands for the value of an expression in a file until that is known.
fn placeholder() -> DeValue<'static> {
    let table = DeTable::parse("number = 1.0").map(Spanned::into_inner);
    let value = table.ok().and_then(|mut table| table.remove("number"));
    value.map_or(DeValue::Boolean(false), Spanned::into_inner)
}

/// True if a number stands in a file under this key.
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

/// Refuses what is no number in a number's place in a file.
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

/// The line of the file with the parameter that is out of range.
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
