//! What an FMU is packed with, and its library is patched with.

use std::marker::PhantomData;

use thiserror::Error;

use crate::block::{DESCRIPTION, NAME};
use crate::options::Options;
use crate::standard::Standard;
use crate::unit::{Clock, Unit};

/// Name, description and start values of an FMU of the unit `U`.
#[derive(Debug, Clone)]
pub struct Imprint<U> {
    name: String,
    description: String,
    values: Vec<f64>,
    standard: Standard,
    options: Options,
    unit: PhantomData<U>,
}

/// Why a text cannot be a name or a description.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} = {text:?}: must have 1 to {most} bytes and no control characters")]
pub struct TextError {
    /// Name or description.
    pub what: &'static str,
    /// The text that was given.
    pub text: String,
    /// The largest number of bytes.
    pub most: usize,
}

impl<U: Unit> Imprint<U> {
    /// What this very library was packed with; the defaults in one that was not packed yet.
    pub fn library() -> Self {
        let block = U::block();
        Self {
            name: block.name(),
            description: block.description(),
            values: block.values(),
            standard: Standard::default(),
            options: Options::default(),
            unit: PhantomData,
        }
    }

    /// These start values, slot by slot, under the unit's own name. What is missing of them keeps its
    /// default.
    pub fn new(values: &[f64]) -> Self {
        let mut imprint = Self::library();
        for (value, given) in imprint.values.iter_mut().zip(values) {
            *value = *given;
        }
        imprint
    }

    /// The imprint under another name, the `modelName` of the description.
    ///
    /// # Errors
    /// If it is empty, longer than 64 bytes, or holds control characters.
    pub fn named(self, name: &str) -> Result<Self, TextError> {
        Ok(Self {
            name: checked("name", name, NAME)?,
            ..self
        })
    }

    /// The imprint with another description.
    ///
    /// # Errors
    /// If it is empty, longer than 256 bytes, or holds control characters.
    pub fn described(self, description: &str) -> Result<Self, TextError> {
        Ok(Self {
            description: checked("description", description, DESCRIPTION)?,
            ..self
        })
    }

    /// The imprint for an FMU of another standard than FMI 2.0.
    #[must_use]
    pub fn with_standard(self, standard: Standard) -> Self {
        Self { standard, ..self }
    }

    /// The imprint for an FMU that tells of more.
    #[must_use]
    pub fn with_options(self, options: Options) -> Self {
        Self { options, ..self }
    }

    /// The options that its standard has.
    pub(crate) fn options(&self) -> Options {
        Options {
            exchange: self.has_exchange() && self.standard == Standard::Fmi2,
            clock: self.clock().is_some(),
            arrays: self.has_arrays(),
        }
    }

    /// Whether the FMU tells of model exchange.
    pub fn has_exchange(&self) -> bool {
        let is_told = self.options.exchange || self.standard == Standard::Fmi3;
        is_told && U::about().state_space.is_some()
    }

    /// The clock that the FMU tells of.
    pub fn clock(&self) -> Option<&'static Clock<U>> {
        let is_told = self.options.clock && self.standard == Standard::Fmi3;
        U::about().clock.filter(|_| is_told)
    }

    /// Whether the FMU tells of arrays of parameters as one variable each.
    pub fn has_arrays(&self) -> bool {
        self.options.arrays && self.standard == Standard::Fmi3
    }

    /// The standard that the FMU is packed by.
    pub fn standard(&self) -> Standard {
        self.standard
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its description.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Its start values, slot by slot.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// A file name after its name: what is no letter, digit, `-`, `.` or `_` in it becomes `_`.
    pub fn file_name(&self) -> String {
        let plain = |c: char| c.is_alphanumeric() || "-._".contains(c);
        let name = self.name.chars().map(|c| if plain(c) { c } else { '_' });
        format!("{}.fmu", name.collect::<String>())
    }

    /// The bytes that stand behind the marker in the library's [`Block`](crate::Block).
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.name.clone().into_bytes();
        bytes.resize(NAME, 0);
        bytes.extend(self.description.as_bytes());
        bytes.resize(NAME + DESCRIPTION, 0);
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}

fn checked(what: &'static str, text: &str, most: usize) -> Result<String, TextError> {
    let text = text.to_owned();
    if (1..=most).contains(&text.len()) && !text.contains(char::is_control) {
        Ok(text)
    } else {
        Err(TextError { what, text, most })
    }
}
