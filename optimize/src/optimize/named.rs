//! What is said of one value of the machine: `name=7`, `name=2:22`.

use std::str::FromStr;

/// A value of the machine, by a key of its file, and what is said of it: `name=…` on the command line.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T> {
    /// The key, a letter or an older name.
    pub(super) name: String,
    /// What is said.
    pub(super) value: T,
}

impl FromStr for Named<f64> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, value) = named(text, "value")?;
        Ok(Self {
            name,
            value: number(value)?,
        })
    }
}

impl FromStr for Named<[f64; 2]> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, range) = named(text, "low:high")?;
        let (low, high) = range
            .split_once(':')
            .ok_or_else(|| format!("{range}: a range is low:high, such as 2:22"))?;
        Ok(Self {
            name,
            value: [number(low)?, number(high)?],
        })
    }
}

fn named<'text>(text: &'text str, what: &str) -> Result<(String, &'text str), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("expected name={what}"))?;
    Ok((name.trim().to_owned(), value))
}

fn number(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .map_err(|_| format!("{text}: not a number"))
}
