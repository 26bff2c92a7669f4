//! Applies changes to a machine, each a key of its file with a new value.

use serde::Deserialize;
use toml::{Table, Value};

use super::keys::SlopeKey;
use super::misspelt_keys::with_near_word;
use super::{Machine, UnitSystem, keys};
use crate::error::{MachineError, SceneError};
use crate::scene::{Below, Parameter, Stop};

impl Machine {
    /// Sets keys of its file to values, written as in the file. A new `stop.model` takes only what is set
    /// with it; a new number of the drive in rad/s or Hz is what its key says.
    ///
    /// # Errors
    /// [`MachineError`] naming the key that it does not have or that is set twice, or the value and what is allowed.
    pub fn apply<'a>(
        &mut self,
        changes: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<(), MachineError> {
        let mut changes: Vec<(String, &str)> = changes
            .into_iter()
            .map(|(key, value)| (key.replace('-', "_"), value.trim()))
            .collect();
        // Slopes are those of the chain that is set with them.
        changes.sort_by_key(|(key, _)| is_slope_key(key));
        if changes
            .iter()
            .any(|(key, _)| keys::word_keys().any(|word| word == key) || is_slope_key(key))
        {
            self.rebuild_stops(&changes)?;
        }
        let (mut done, mut ties) = (Vec::new(), Vec::new());
        for (key, value) in &changes {
            let name = match self.tied_parameter(key, value)? {
                None if is_slope_key(key) => key,
                None => self.apply_change(key, value)?,
                Some(parameter) => {
                    ties.push((key.clone(), (*value).to_owned(), None));
                    parameter.name()
                }
            };
            if done.contains(&name) {
                return Err(MachineError::Twice(name.to_owned()));
            }
            done.push(name);
        }
        self.tie_parameters(&ties)?;
        self.validate()
            .map_err(|error| self.error_of_changed(error, &done))?;
        self.check_texts()
    }

    /// An error of time scales that lie too far apart, with the limit of a parameter that was changed, by the names of these, in
    /// place of that of one that was not.
    fn error_of_changed(&self, error: SceneError, changed: &[&str]) -> SceneError {
        let of_changed = || {
            let changed = changed.iter().filter_map(|name| Parameter::named(name));
            let mut errors = changed.filter_map(|it| self.scene.time_scale_error_of(it));
            errors.next()
        };
        let stated = match &error {
            SceneError::Below(error) => &**error,
            error => error,
        };
        let is_own = |name: &str| name != Parameter::Frequency.name() && changed.contains(&name);
        let of_changed = match stated {
            SceneError::TimeScales { name, .. } if !is_own(name) => of_changed(),
            _ => None,
        };
        of_changed.map_or(error, |error| self.scene_error_in_own_units(error))
    }

    /// The parameter of a key that is set to an expression.
    fn tied_parameter(&self, key: &str, text: &str) -> Result<Option<Parameter>, MachineError> {
        let is_of_start = key.starts_with("initial.") || key.starts_with("start.");
        let mut words = keys::word_keys().chain(["name", "description"]);
        let is_word = words.any(|word| word == key);
        if is_of_start
            || is_word
            || is_slope_key(key)
            || text.parse::<f64>().is_ok()
            || !keys::is_expression(text)
        {
            return Ok(None);
        }
        if keys::other_statement_of(key) == Some(Parameter::Preload) {
            self.known_parameter(keys::PRELOAD_DEFLECTION)?;
        }
        self.known_parameter(key).map(Some)
    }

    /// Sets one key to a value; the name of what is set.
    fn apply_change(&mut self, key: &str, text: &str) -> Result<&'static str, MachineError> {
        if let Some(word) = keys::word_keys().find(|word| *word == key) {
            return Ok(word);
        }
        let number = || parse_number(key, text);
        match key {
            "name" => {
                self.name = Some(text.to_owned());
                return Ok("name");
            }
            "description" => {
                self.description = Some(text.to_owned());
                return Ok("description");
            }
            keys::POSITION | "start.position" => {
                self.start.position = number()?;
                return Ok(keys::POSITION);
            }
            keys::VELOCITY | "start.velocity" => {
                self.start.velocity = number()?;
                return Ok(keys::VELOCITY);
            }
            _ => {}
        }
        match keys::other_statement_of(key) {
            Some(Parameter::Frequency) if self.unit_system != UnitSystem::Ratios => {
                self.unit_system = UnitSystem::Hertz;
                self.untie_parameter(Parameter::Frequency);
                self.set(Parameter::Frequency, number()?);
                return Ok(Parameter::Frequency.name());
            }
            Some(Parameter::Preload) => {
                self.known_parameter(keys::PRELOAD_DEFLECTION)?;
                self.untie_parameter(Parameter::Preload);
                self.preload_deflection = Some(0.0);
                self.set(Parameter::Preload, number()?);
                return Ok(Parameter::Preload.name());
            }
            _ => {}
        }
        let parameter = self.known_parameter(key)?;
        let value = number()?;
        self.untie_parameter(parameter);
        match parameter {
            Parameter::Preload => self.preload_deflection = None,
            Parameter::Frequency if self.unit_system == UnitSystem::Hertz => {
                parameter.set(&mut self.scene, value);
                self.update_followers();
                return Ok(parameter.name());
            }
            _ => {}
        }
        self.set(parameter, value);
        Ok(parameter.name())
    }

    /// The parameter of a key that the machine has.
    fn known_parameter(&self, key: &str) -> Result<Parameter, MachineError> {
        self.parameter(key).map_err(|error| match error {
            MachineError::Ratio(..) => error,
            _ => self.key_error(key, self.file_keys()),
        })
    }

    /// Makes a stop anew from what is set of it: a new model from that and its clearance alone.
    fn rebuild_stops(&mut self, changes: &[(String, &str)]) -> Result<(), MachineError> {
        let set = |words: keys::WordKeys| {
            let mut keys = changes.iter().map(|(key, _)| key);
            let is_new = changes.iter().any(|(key, _)| key == words[0]);
            keys.any(|key| {
                let slope = SlopeKey::parse(key).map(|it| it.is_below);
                words.contains(&key.as_str()) || slope == Some(words == keys::STOP_BELOW_WORDS)
            })
            .then_some(is_new)
        };
        if let Some(is_new) = set(keys::STOP_WORDS) {
            let mut stop = Table::new();
            if is_new {
                self.preload_deflection = None;
            } else if let Ok(present) = Table::try_from(&self.scene.stop) {
                stop = present;
            }
            set_in_stop(&mut stop, changes, false)?;
            self.scene.stop =
                Stop::deserialize(stop).map_err(|error| stop_error(&error, "stop"))?;
        }
        if let Some(is_new) = set(keys::STOP_BELOW_WORDS) {
            let mut stop = Table::try_from(&self.scene.below).unwrap_or_default();
            stop.retain(|key, _| !is_new || key == "clearance");
            set_in_stop(&mut stop, changes, true)?;
            let below = Below::deserialize(stop);
            let below = below.map_err(|error| stop_error(&error, "stop.below"))?;
            self.scene.below = Some(below.into());
        }
        self.untie_missing()
    }
}

/// Sets in the table of one of the stops what is changed of it.
fn set_in_stop(
    stop: &mut Table,
    changes: &[(String, &str)],
    below: bool,
) -> Result<(), MachineError> {
    for (key, value) in changes {
        if let Some(slope) = SlopeKey::parse(key) {
            if slope.is_below == below {
                set_slope(stop, &slope, key, parse_number(key, value)?)?;
            }
            continue;
        }
        let lettered = |it: &&Parameter| it.about().letter == key || it.name() == key;
        let named = Parameter::ALL.iter().find(lettered).map(|it| it.name());
        match keys::split_stop_key(named.unwrap_or(key)) {
            Some((is_below, _)) if is_below != below => None,
            Some((false, "preload_deflection")) => stop.insert("preload".into(), Value::Float(0.0)),
            // What follows others is set after them.
            Some((_, field)) if named.is_some() && value.parse::<f64>().is_err() => {
                stop.insert(field.to_owned(), Value::Float(1.0))
            }
            Some((_, field)) => stop.insert(field.to_owned(), parse_value(value)),
            None => None,
        };
    }
    Ok(())
}

fn is_slope_key(key: &str) -> bool {
    SlopeKey::parse(key).is_some()
}

/// Applies the change of a number of a slope to the table of its stop.
fn set_slope(
    stop: &mut Table,
    slope: &SlopeKey,
    key: &str,
    value: f64,
) -> Result<(), MachineError> {
    let chain = stop.get_mut(slope.chain).and_then(Value::as_array_mut);
    let slopes = chain.as_ref().map_or(0, |chain| chain.len());
    let set = chain.and_then(|chain| chain.get_mut(slope.index)?.as_table_mut());
    let Some(table) = set else {
        let chain = slope.chain;
        return Err(MachineError::Syntax(format!(
            "{key}: there is no such slope; the stop has {slopes} of {chain}, counted from 0"
        )));
    };
    table.insert(slope.field.to_owned(), Value::Float(value));
    Ok(())
}

/// What is wrong with a stop after its changes, in its keys.
fn stop_error(error: &toml::de::Error, stop: &str) -> MachineError {
    let words = with_near_word(error.message()).replace("field `", &format!("key `{stop}."));
    MachineError::Syntax(format!("{stop}: {words}"))
}

/// The value of a change as it is written in a file; a word may do without quotation marks.
fn parse_value(text: &str) -> Value {
    let parsed = format!("value = {text}").parse::<Table>();
    let value = parsed.ok().and_then(|mut table| table.remove("value"));
    value.unwrap_or_else(|| Value::String(text.to_owned()))
}

fn parse_number(key: &str, text: &str) -> Result<f64, MachineError> {
    text.parse().map_err(|_| MachineError::NotANumber {
        line: None,
        key: key.to_owned(),
        value: text.to_owned(),
    })
}
