//! The task of `softstop optimize` as a TOML file: the names of the command line.

use std::path::PathBuf;

use serde::Deserialize;
use serde_json::json;
use softstop::Machine;
use softstop_console::failure::Failure;
use softstop_console::machine::{Regime, SceneSettings};
use softstop_console::output::Format;
use softstop_console::schema;
use toml::{Table, Value};

use super::leaves::{flatten, number, range};
use super::named::Named;
use super::wishes::Goal;
use crate::design::figure::Figure;
use crate::design::search::LEAST_EVALUATIONS;

/// The keys of a file with their types, what the schema says of them, and what they are.
macro_rules! task {
    ($($(#[doc = $what:literal])* $key:ident: $type:ty, $schema:expr;)*) => {
        /// The file.
        #[derive(Debug, Clone, Default, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct Task {
            $($(#[doc = $what])* pub $key: $type,)*
        }

        impl Task {
            /// The JSON Schema of such files (draft 2020-12).
            pub fn schema() -> serde_json::Value {
                let mut keys = serde_json::Map::new();
                $({
                    let mut schema: serde_json::Value = $schema;
                    schema["description"] = concat!($($what),*).trim().into();
                    keys.insert(stringify!($key).to_owned(), schema);
                })*
                json!({
                    "$schema": schema::DRAFT,
                    "title": "softstop task",
                    "description": "What softstop optimize --config searches; the command line has the last word.",
                    "type": "object",
                    "properties": keys,
                    "additionalProperties": false,
                    "not": { "required": ["machine", "regime"] },
                })
            }
        }
    };
}

task! {
    /// Machine file, seen from the task's folder, or `unloaded` (A) or `loaded` (B).
    machine: Option<PathBuf>, json!({ "type": "string" });
    /// Without or with a strip: the paper's machine.
    regime: Option<Regime>, schema::words::<Regime>();
    /// Distance M from both ends of the zone as a share of its width, 0 to 0.5.
    margin: Option<f64>, json!({ "type": "number", "minimum": 0, "maximum": 0.5 });
    /// Values held, by the keys of the machine's file.
    fix: Table, schema::keyed(json!({ "type": "number" }));
    /// Ranges searched: `clearance = [2, 22]`.
    bounds: Table, schema::keyed(json!({
        "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2
    }));
    /// What is searched instead of the usual parameters: `clearance = [2, 22]`, `{ values = [5, 7, 9] }` of a
    /// catalogue, `{ follows = "stop.stiffness", factor = 10 }`.
    vary: Table, json!({ "type": "object" });
    /// Half-widths of what cannot be made exactly: `clearance = 0.1` or `"2 %"`.
    tolerance: Table, json!({ "type": "object" });
    /// What is sought: `maximise` or `minimise` a figure.
    objective: Goal, json!({
        "type": "object",
        "properties": { "maximise": { "type": "string" }, "minimise": { "type": "string" } },
        "additionalProperties": false,
        "maxProperties": 1
    });
    /// What must hold: a number, or `{ least = 10, most = 12 }`, for each figure.
    require: Table, requirements_schema();
    /// How to search.
    search: Search, json!({
        "type": "object",
        "properties": {
            "seed": { "type": "integer", "minimum": 0, "deprecated": true },
            "evaluations": { "type": "integer", "minimum": LEAST_EVALUATIONS }
        },
        "additionalProperties": false
    });
    /// The rest of the paper's machine.
    scene: SceneSettings, schema::shorthands();
    /// Ignored: the search is deterministic.
    seed: Option<u64>, json!({ "type": "integer", "minimum": 0 });
    /// Zones that the search may compute.
    evaluations: Option<u64>, json!({ "type": "integer", "minimum": LEAST_EVALUATIONS });
    /// Output folder.
    output: Option<PathBuf>, json!({ "type": "string" });
    /// How to print the result.
    format: Option<Format>, schema::words::<Format>();
}

/// The table `[search]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Search {
    /// Ignored: the search is deterministic.
    pub seed: Option<u64>,
    /// Zones that the search may compute.
    pub evaluations: Option<u64>,
}

/// A bound of each figure.
fn requirements_schema() -> serde_json::Value {
    let bound = |figure: &Figure| {
        let number = json!({ "type": "number" });
        let bounds = json!({
            "type": "object",
            "properties": { "least": number, "most": number },
            "additionalProperties": false,
            "minProperties": 1
        });
        let value = match figure {
            Figure::RunUp => {
                json!({ "anyOf": [{ "type": "boolean" }, number], "description": figure.meaning() })
            }
            _ => json!({ "anyOf": [number, bounds], "description": figure.meaning() }),
        };
        (figure.name().to_owned(), value)
    };
    let figures: serde_json::Map<_, _> = Figure::ALL.iter().map(bound).collect();
    json!({ "type": "object", "properties": figures, "additionalProperties": false })
}

impl Task {
    /// The task that stands in a machine's file.
    ///
    /// # Errors
    /// [`Failure::Usage`] naming the key.
    pub(super) fn beside_machine(text: &str) -> Result<Self, Failure> {
        let mut file: Table =
            toml::from_str(text).map_err(|error| Failure::usage(error.to_string()))?;
        file.retain(|key, _| Machine::TASK.contains(&key));
        file.try_into()
            .map_err(|error: toml::de::Error| Failure::usage(error.to_string()))
    }

    /// True if a machine's file says anything of a task.
    pub(super) fn is_any(&self) -> bool {
        let tables = [&self.vary, &self.tolerance, &self.require];
        tables.iter().any(|table| !table.is_empty())
            || self.objective != Goal::default()
            || self.search != Search::default()
    }

    /// What it says of the searched values, each as a range.
    pub(super) fn words(&self) -> Result<Vec<Named<[f64; 2]>>, Failure> {
        let mut words = Vec::new();
        for (table, read) in [
            (&self.fix, value as fn(&Value) -> Option<[f64; 2]>),
            (&self.bounds, range),
        ] {
            flatten(table, "", &|_| false, &mut |name, value| {
                let value = read(value).ok_or_else(|| {
                    Failure::usage(format!(
                        "{name} = {value}: fix holds a number, bounds a range [low, high]"
                    ))
                })?;
                words.push(Named { name, value });
                Ok(())
            })?;
        }
        Ok(words)
    }
}

fn value(value: &Value) -> Option<[f64; 2]> {
    number(value).map(|number| [number, number])
}

#[cfg(test)]
mod tests {
    use super::Task;

    /// A task with every key; a key that the schema lacks is unknown to the reader, and the other way about.
    #[test]
    fn schema_and_reader_have_the_same_keys() -> Result<(), Box<dyn std::error::Error>> {
        let file = "machine = \"press.toml\"\nregime = \"loaded\"\nmargin = 0.2\nseed = 1\n\
                    evaluations = 200\noutput = \"there\"\nformat = \"json\"\n[fix]\nstop.stiffness = 7\n\
                    [bounds]\nclearance = [2, 22]\n[scene]\ndamping = 0.02\n[vary]\nclearance = 3\n\
                    [tolerance]\nclearance = 0.1\n[objective]\nmaximise = \"velocity\"\n[require]\n\
                    velocity = 3\n[search]\nseed = 1\n";
        toml::from_str::<Task>(file)?;
        let written: toml::Table = toml::from_str(file)?;
        let schema = Task::schema();
        let keys = schema["properties"].as_object().ok_or("no keys")?;
        let mut all: Vec<&str> = written.keys().map(String::as_str).collect();
        all.sort_unstable();
        let mut stated: Vec<&str> = keys.keys().map(String::as_str).collect();
        stated.sort_unstable();
        assert_eq!(all, stated);
        let scene = keys["scene"]["properties"].as_object().ok_or("no ratios")?;
        for (key, rule) in scene {
            let value = if rule["enum"].is_array() {
                "\"loaded\""
            } else {
                "1.5"
            };
            toml::from_str::<Task>(&format!("[scene]\n{key} = {value}\n"))?;
        }
        assert_eq!(scene.len(), 12);
        Ok(())
    }
}
