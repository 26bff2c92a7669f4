//! The keys of machine files: those that are no numbers of a scene, and the parameters that keys name.

use std::f64::consts::TAU;

use super::{Machine, UnitSystem};
use crate::error::MachineError;
use crate::scene::{Dimension, Parameter, Stop};

/// Key of the initial position, in m.
pub(super) const POSITION: &str = "initial.position";
/// Key of the initial velocity, in m/s.
pub(super) const VELOCITY: &str = "initial.velocity";
/// Key of the drive's frequency in Hz, beside the one in rad/s.
pub(super) const FREQUENCY_HZ: &str = "excitation.frequency_hz";
/// Key of the deflection by the preload, in m, beside the preload in N.
pub(super) const PRELOAD_DEFLECTION: &str = "stop.preload_deflection";
/// Keys of a stop whose values are no numbers: its model, the rule by which it is left, and the slopes of its force while it is
/// loaded and unloaded.
pub(super) type WordKeys = [&'static str; 4];

/// The keys of the stop above whose values are words or lists.
pub(super) const STOP_WORDS: WordKeys = [
    "stop.model",
    "stop.release",
    "stop.loading",
    "stop.unloading",
];

/// The keys of the stop below whose values are words or lists.
pub(super) const STOP_BELOW_WORDS: WordKeys = [
    "stop.below.model",
    "stop.below.release",
    "stop.below.loading",
    "stop.below.unloading",
];

/// True if a key belongs to the law of a stop: its release, or its loading and unloading slopes.
fn is_word_key_of(key: &str, [_, release, loading, unloading]: WordKeys, stop: &Stop) -> bool {
    match stop {
        Stop::KelvinVoigt { .. } => key == release,
        Stop::PiecewiseLinear { .. } => key == loading || key == unloading,
        _ => false,
    }
}

/// The keys of both stops whose values are no numbers: they make a new stop.
pub(super) fn word_keys() -> impl Iterator<Item = &'static str> {
    STOP_WORDS.into_iter().chain(STOP_BELOW_WORDS)
}

/// The stop of a key, true if it is the one below, and the key's name in its table.
pub(super) fn split_stop_key(key: &str) -> Option<(bool, &str)> {
    let field = key.strip_prefix("stop.")?;
    Some(match field.strip_prefix("below.") {
        Some(field) => (true, field),
        None => (false, field),
    })
}

/// The key of a number of a slope, such as `stop.loading.0.stiffness`; slopes count from 0.
pub(super) struct SlopeKey<'a> {
    /// True if it is a slope of the stop below.
    pub is_below: bool,
    /// `loading` or `unloading`.
    pub chain: &'a str,
    /// Which slope of the chain.
    pub index: usize,
    /// `from` or `stiffness`.
    pub field: &'a str,
}

impl<'a> SlopeKey<'a> {
    /// The parts of a key; none if it is not that of a slope.
    pub fn parse(key: &'a str) -> Option<Self> {
        let (is_below, key) = split_stop_key(key)?;
        let (chain, rest) = key.split_once('.')?;
        let (index, field) = rest.split_once('.')?;
        let is_known =
            matches!(chain, "loading" | "unloading") && matches!(field, "from" | "stiffness");
        Some(Self {
            is_below,
            chain,
            // 07 and +7 would be other names of the same slope.
            index: index
                .parse()
                .ok()
                .filter(|it: &usize| is_known && it.to_string() == index)?,
            field,
        })
    }
}

/// Keys of a file that name no [`Parameter`], of machines in SI units.
pub(super) fn other_keys() -> impl Iterator<Item = &'static str> {
    let rest = [
        PRELOAD_DEFLECTION,
        POSITION,
        VELOCITY,
        "name",
        "description",
    ];
    [FREQUENCY_HZ].into_iter().chain(word_keys()).chain(rest)
}

/// Tables of a file that are no part of the machine: the task of `softstop optimize`.
pub(super) const TASK_TABLES: [&str; 7] = [
    "vary",
    "tolerance",
    "objective",
    "require",
    "case",
    "search",
    "report",
];

/// All keys of a file in a system of units.
pub(super) fn all_keys(unit_system: UnitSystem) -> Vec<&'static str> {
    let ratios = unit_system == UnitSystem::Ratios;
    let numbers = Parameter::ALL
        .into_iter()
        .filter(|it| !(ratios && it.is_unit()));
    let further = other_keys().filter(|key| !(ratios && *key == FREQUENCY_HZ));
    numbers.map(Parameter::name).chain(further).collect()
}

/// The parameter that a key states in another way than by its name.
pub(super) fn other_statement_of(key: &str) -> Option<Parameter> {
    match key {
        FREQUENCY_HZ | "frequency_hz" => Some(Parameter::Frequency),
        PRELOAD_DEFLECTION | "preload_deflection" => Some(Parameter::Preload),
        _ => None,
    }
}

/// True if a text may be meant as an expression: it is more than a word, or the name of a parameter.
pub(super) fn is_expression(text: &str) -> bool {
    let is_of_word = |it: char| it.is_alphanumeric() || "_.".contains(it);
    let is_parameter = |it: &Parameter| it.is_called(text);
    !text.chars().all(is_of_word)
        || other_statement_of(text).is_some()
        || Parameter::ALL.iter().any(is_parameter)
}

/// True if a key is the letter of a ratio, such as eta or rho, that stands for a parameter which machines in SI units state.
fn is_ratio(key: &str, parameter: Parameter) -> bool {
    let about = parameter.about();
    let is_quotient = about.dimension != Dimension::Angle && !parameter.is_unit();
    key == about.letter && key != about.symbol && is_quotient
}

impl Machine {
    /// The parameter of this name, letter or older name that it has, or that this key states otherwise. `stiffness` is
    /// that of the suspension, or of the stop in ratios; only machines in ratios know the letters of ratios.
    ///
    /// # Errors
    /// [`MachineError::Lacks`] or [`MachineError::UnknownKey`], with what it has instead; [`MachineError::Ratio`].
    pub fn parameter(&self, name: &str) -> Result<Parameter, MachineError> {
        let name = name.replace('-', "_");
        let known = |parameter: &Parameter| match parameter {
            Parameter::Frequency => self.unit_system != UnitSystem::Ratios,
            _ => true,
        };
        let otherwise = other_statement_of(&name).filter(known);
        let named = |parameter: &Parameter| name == parameter.name();
        let called = |parameter: &Parameter| parameter.is_called(&name);
        let found = self
            .parameters()
            .find(|parameter| otherwise == Some(*parameter) || named(parameter))
            .or_else(|| self.parameters().find(called));
        match found {
            None => Err(self.key_error(&name, self.parameter_names())),
            Some(found) if self.unit_system != UnitSystem::Ratios && is_ratio(&name, found) => {
                Err(MachineError::Ratio(name, self.name(found)))
            }
            Some(found) => Ok(found),
        }
    }

    /// The parameter of a key, and the unit of that key in the machine's own one: `excitation.frequency` is
    /// in rad/s and `excitation.frequency_hz` in Hz, whichever of the two the machine is stated in.
    ///
    /// # Errors
    /// As [`Machine::parameter`]; [`MachineError::Lacks`] if the machine states its preload otherwise.
    pub fn stated(&self, key: &str) -> Result<(Parameter, f64), MachineError> {
        let parameter = self.parameter(key)?;
        let key = key.replace('-', "_");
        let otherwise = other_statement_of(&key).is_some();
        match (parameter, self.unit_system) {
            (Parameter::Preload, _) if otherwise != self.preload_deflection.is_some() => {
                Err(self.key_error(&key, self.parameter_names()))
            }
            (Parameter::Frequency, UnitSystem::Hertz) if !otherwise => Ok((parameter, 1.0 / TAU)),
            (Parameter::Frequency, UnitSystem::Si) if otherwise => Ok((parameter, TAU)),
            _ => Ok((parameter, 1.0)),
        }
    }

    /// The names of the parameters of this machine.
    fn parameter_names(&self) -> Vec<&'static str> {
        self.parameters().map(|it| self.name(it)).collect()
    }

    /// All keys of a file that this machine has.
    pub(super) fn file_keys(&self) -> Vec<&'static str> {
        let has = |key: &&str| match *key {
            FREQUENCY_HZ => self.unit_system == UnitSystem::Si,
            PRELOAD_DEFLECTION => {
                self.preload_deflection.is_none() && self.value(Parameter::Preload).is_some()
            }
            key if STOP_WORDS[1..].contains(&key) => {
                is_word_key_of(key, STOP_WORDS, &self.scene.stop)
            }
            key if STOP_BELOW_WORDS.contains(&key) => {
                let is_of = |stop| {
                    key == STOP_BELOW_WORDS[0] || is_word_key_of(key, STOP_BELOW_WORDS, stop)
                };
                self.scene.below.as_ref().is_some_and(|it| is_of(&it.stop))
            }
            _ => true,
        };
        let further = other_keys().filter(has);
        self.parameter_names().into_iter().chain(further).collect()
    }
}
