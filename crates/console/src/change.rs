//! Changes of a machine on the command line and in task files: `KEY=VALUE`.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

/// `KEY=VALUE`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Change {
    key: String,
    value: String,
}

impl Change {
    pub(crate) fn new(key: &str, value: &str) -> Self {
        let (key, value) = (key.to_owned(), value.to_owned());
        Self { key, value }
    }

    /// The key of the machine's file.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// Its new value as the user writes it.
    pub fn value(&self) -> &str {
        &self.value
    }
}

impl fmt::Display for Change {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}={}", self.key, self.value)
    }
}

impl FromStr for Change {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((key, value)) if !key.trim().is_empty() => Ok(Self::new(key.trim(), value)),
            _ => Err("must be KEY=VALUE, as in stop.stiffness=8e6".to_owned()),
        }
    }
}

impl TryFrom<String> for Change {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse().map_err(|error| format!("{text:?}: {error}"))
    }
}
