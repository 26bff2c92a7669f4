//! The task of `softstop optimize` as a TOML file.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::json;
use softstop::Machine;
use softstop::internals::{did_you_mean, nearest_name};
use softstop_console::change::Change;
use softstop_console::failure::Failure;
use softstop_console::output::Format;
use softstop_console::schema;
use softstop_dynamics::run_up::Way;
use toml::de::{DeTable, DeValue, Deserializer, Error};
use toml::{Spanned, Table};

use super::objective::{Goal, MAX_OBJECTIVES, is_traded};
use super::require::{RESERVE, SHARE, STARTS};
use super::title::Title;
use crate::design::figure::Figure;
use crate::design::search::LEAST_EVALUATIONS;

/// The keys of a file with their types, what the schema says of them, and what they are.
macro_rules! task {
    ($($(#[doc = $what:literal])* $key:ident: $type:ty, $schema:expr;)*) => {
        /// The file.
        #[derive(Debug, Clone, Default, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct TaskSpec {
            $($(#[doc = $what])* pub $key: $type,)*
        }

        impl TaskSpec {
            /// The JSON Schema of such files (draft 2020-12).
            pub fn schema() -> serde_json::Value {
                let mut keys = serde_json::Map::new();
                $({
                    let what = concat!($($what),*).trim();
                    let mut schema: serde_json::Value = $schema;
                    schema["description"] = what.into();
                    keys.insert(stringify!($key).to_owned(), schema);
                })*
                json!({
                    "$schema": schema::DRAFT,
                    "title": "softstop task",
                    "description": "What softstop optimize --config searches; the command line has the last word.",
                    "type": "object",
                    "properties": keys,
                    "additionalProperties": false,
                })
            }
        }
    };
}

task! {
    /// Machine file, seen from the task's folder, or `unloaded` (A) or `loaded` (B).
    machine: Option<PathBuf>, json!({ "type": "string" });
    /// Changes of the machine: `stop.stiffness=8e6`.
    set: Vec<Change>, json!({ "type": "array", "items": { "type": "string" } });
    /// What is searched instead of the usual parameters: `clearance = [2, 22]`, `{ values = [5, 7, 9] }` of a
    /// catalogue, `{ follows = "stop.stiffness", factor = 10 }`; a number is held.
    vary: Table, json!({ "type": "object" });
    /// Half-widths of what cannot be made exactly: `clearance = 0.1` or `"2 %"`; of a normal distribution
    /// `{ half_width = 0.1, distribution = "normal", cpk = 1.33 }` or `{ sigma = 0.03 }`.
    tolerance: Table, json!({ "type": "object" });
    /// What is sought: `maximise` or `minimise` a figure, or lists of them for a front of designs.
    objective: Goal, json!({
        "type": "object",
        "properties": {
            "maximise": sought(),
            "minimise": sought(),
            "cost": { "type": "string", "description": "formula of the figure cost over parameters and figures of a motion" },
            "of": { "enum": ["drawing", "worst"], "description": "whose figure counts: the drawing's, or that of the worst machine within the tolerances" }
        },
        "additionalProperties": false,
        "not": {
            "required": ["maximise", "minimise"],
            "properties": { "maximise": { "type": "string" }, "minimise": { "type": "string" } }
        }
    });
    /// What must hold: a number, or `{ least = 10, most = 12 }`, for each figure.
    require: Table, requirements_schema();
    /// Operating points beside the drawing's, in which all that is required holds too: a `name`, the `weight` of what is sought,
    /// and parameters with other values, `piercing.friction = 2e6`.
    case: Vec<Table>, json!({
        "type": "array",
        "items": {
            "type": "object",
            "properties": { "name": { "type": "string" }, "weight": { "type": "number", "minimum": 0, "maximum": 1e6, "default": 1 } }
        }
    });
    /// How to search.
    search: Search, json!({
        "type": "object",
        "properties": {
            "evaluations": evaluations(),
            "zone": {
                "enum": ["hysteresis", "z = 1"], "default": "hysteresis",
                "description": "which motions: those beside which the machine may also stay without impacts, or all stable z = 1"
            }
        },
        "additionalProperties": false
    });
    /// What stands above the report.
    report: Title, Title::schema();
    /// Output folder.
    output: Option<PathBuf>, json!({ "type": "string" });
    /// How to print the result.
    format: Option<Format>, schema::words::<Format>();
}

fn evaluations() -> serde_json::Value {
    json!({ "type": "integer", "minimum": LEAST_EVALUATIONS })
}

/// A figure that is sought, or a list of them.
fn sought() -> serde_json::Value {
    let traded = Figure::ALL.iter().filter(|it| is_traded(**it));
    let names: Vec<&str> = traded.map(|it| it.name()).collect();
    json!({ "anyOf": [
        { "type": "string" },
        { "type": "array", "items": { "enum": names }, "maxItems": MAX_OBJECTIVES }
    ] })
}

/// The table `[search]`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Search {
    /// Zones that the search may compute.
    pub evaluations: Option<u64>,
    /// Which motions are searched.
    pub zone: Motions,
}

/// Which motions are searched.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub enum Motions {
    /// Those beside which the machine may also stay without impacts.
    #[default]
    Hysteresis,
    /// All stable ones with one impact a drive period.
    SingleImpact,
}

impl TryFrom<String> for Motions {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text.as_str() {
            "hysteresis" => Ok(Self::Hysteresis),
            "z = 1" => Ok(Self::SingleImpact),
            _ => {
                let meant = did_you_mean(nearest_name(&text, &["hysteresis", "z = 1"]));
                Err(format!(
                    "search.zone = {text:?}: must be \"hysteresis\" or \"z = 1\"{meant}"
                ))
            }
        }
    }
}

/// A bound of each figure.
fn requirements_schema() -> serde_json::Value {
    let bound = |figure: &Figure| {
        let number = json!({ "type": "number" });
        let bounds = json!({
            "type": "object",
            "properties": { "least": number, "most": number, "at": { "enum": ["tolerances", "drawing"] } },
            "additionalProperties": false,
            "anyOf": [{ "required": ["least"] }, { "required": ["most"] }]
        });
        let any_of = match figure {
            Figure::RunUp => {
                let positive = json!({ "type": "number", "exclusiveMinimum": 0 });
                let ways = json!({
                    "type": "object",
                    "properties": {
                        "ways": { "type": "array", "items": { "enum": Way::ALL }, "minItems": 1 },
                        "ramp_rate": positive, "force": positive,
                        "least": number, "most": number, "at": { "enum": ["tolerances", "drawing"] }
                    },
                    "additionalProperties": false
                });
                json!([{ "type": "boolean" }, number, ways])
            }
            Figure::Certainty | Figure::Share => {
                json!([number, { "type": "string", "pattern": "%\\s*$" }, bounds])
            }
            _ => json!([number, bounds]),
        };
        let value = json!({ "anyOf": any_of, "description": figure.meaning() });
        (figure.name().to_owned(), value)
    };
    let mut figures: serde_json::Map<_, _> = Figure::ALL.iter().map(bound).collect();
    let range =
        json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
    let others = [
        (
            RESERVE,
            json!({
                "type": "number", "minimum": 1, "maximum": 10,
                "description": "how many times as wide as the tolerances the box is that must hold"
            }),
        ),
        (
            SHARE,
            json!({
                "anyOf": [{ "type": "number", "minimum": 1e-5, "maximum": 0.5 }, { "type": "string", "pattern": "%\\s*$" }],
                "description": "share of the machines with normal tolerances that may lose the motion or violate a requirement"
            }),
        ),
        (
            STARTS,
            json!({
                "type": "object",
                "properties": { "position": range, "velocity": range },
                "required": ["position", "velocity"],
                "additionalProperties": false,
                "description": "box of starts of which certainty and integrity are told, at drive angle phi"
            }),
        ),
    ];
    figures.extend(others.map(|(key, value)| (key.to_owned(), value)));
    json!({ "type": "object", "properties": figures, "additionalProperties": false })
}

impl TaskSpec {
    /// The task that stands in a machine's file; none if it says nothing of one.
    ///
    /// # Errors
    /// [`Failure::Usage`] with file, line and column.
    pub(super) fn beside_machine(path: &Path, text: &str) -> Result<Option<Self>, Failure> {
        let usage = |error: Error| Failure::of_toml(path, text, &error);
        let mut file = DeTable::parse(text).map_err(usage)?;
        let mut own = DeTable::new();
        for name in Machine::TASK {
            if let Some((key, value)) = file.get_mut().remove_entry(name)
                && !matches!(value.get_ref(), DeValue::Table(table) if table.is_empty())
            {
                own.insert(key, value);
            }
        }
        let is_any = !own.is_empty();
        let own = Spanned::new(file.span(), own);
        let task = Self::deserialize(Deserializer::from(own)).map_err(usage)?;
        Ok(Some(task).filter(|_| is_any))
    }
}
