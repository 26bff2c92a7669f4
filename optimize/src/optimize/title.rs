//! What stands above a report, as its user says it, and the texts that state the task.

use std::path::Path;

use hmac_sha256::Hash;
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use softstop_console::failure::Failure;
use softstop_console::machine::PaperMachine;
use softstop_console::scene_file;
use toml::Value;

use super::OptimizeArguments;

/// `[report]` of a task: what stands above its report. No clock is read: the same task gives the same report.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Title {
    /// What the report is called, instead of the machine's name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Who answers for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub author: Option<String>,
    /// Of which day it is: a text, or a date of TOML.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "date")]
    pub date: Option<String>,
}

impl Title {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The JSON Schema of the table.
    pub(super) fn schema() -> serde_json::Value {
        let text = json!({ "type": "string" });
        json!({
            "type": "object",
            "properties": { "title": text, "author": text, "date": text },
            "additionalProperties": false
        })
    }
}

fn date<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
    match Value::deserialize(deserializer)? {
        Value::String(text) => Ok(Some(text)),
        Value::Datetime(date) => Ok(Some(date.to_string())),
        other => Err(serde::de::Error::custom(format!(
            "date = {other}: must be a date or a text"
        ))),
    }
}

/// A text that states a task, or a part of it.
#[derive(Debug, Clone, Serialize)]
pub struct Source {
    /// Name of its file, without its folders.
    pub name: String,
    /// SHA-256 of its bytes, as `sha256sum` writes it.
    pub hash: String,
    /// The text.
    pub text: String,
}

impl Source {
    fn new(name: String, text: String) -> Self {
        let hash = Hash::hash(text.as_bytes());
        let hash = hash.iter().map(|byte| format!("{byte:02x}")).collect();
        Self { name, hash, text }
    }

    fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.file_name().unwrap_or_default();
        Ok(Self::new(
            name.to_string_lossy().into_owned(),
            scene_file::text(path)?,
        ))
    }

    /// The files that state a task, and what the command line changes of them; pipes are read but once.
    pub(super) fn all(
        arguments: &OptimizeArguments,
        machine: Option<&Path>,
    ) -> Result<Vec<Self>, Failure> {
        let is_file = |path: &&Path| PaperMachine::called(path).is_none() && path.is_file();
        let files = arguments.config.as_deref().into_iter().chain(machine);
        let files = files.filter(is_file).map(Self::read);
        let mut sources = files.collect::<Result<Vec<Self>, Failure>>()?;
        sources.extend(Self::of_line(arguments));
        Ok(sources)
    }

    /// What the command line changes, if it does.
    fn of_line(arguments: &OptimizeArguments) -> Option<Self> {
        let changes = arguments.machine.set.iter();
        let mut text: String = changes.map(|it| format!("--set {it}\n")).collect();
        text.extend(arguments.vary.iter().map(|it| format!("--vary {it}\n")));
        text.extend(arguments.margin.map(|it| format!("--margin {it}\n")));
        text.extend(
            arguments
                .evaluations
                .map(|it| format!("--evaluations {it}\n")),
        );
        (!text.is_empty()).then(|| Self::new("command line".into(), text))
    }
}
