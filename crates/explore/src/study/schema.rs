//! The JSON Schema of study files.

use serde_json::{Value, json};
use softstop_console::schema;

use super::file::MOST;
use super::outputs::StudyOutput;

/// The JSON Schema of such files (draft 2020-12).
pub fn schema() -> Value {
    let number = json!({ "type": "number" });
    let range = json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 });
    let names: Vec<&str> = StudyOutput::all().map(|it| it.name).collect();
    let count =
        |least: u64, most: u64| json!({ "type": "integer", "minimum": least, "maximum": most });
    let told = |mut schema: Value, what: &str| {
        schema["description"] = what.into();
        schema
    };
    let axis = json!({
        "type": "object",
        "required": ["parameter"],
        "properties": {
            "parameter": told(json!({ "type": "string" }), "A key of the machine's file, or a letter."),
            "from": told(number.clone(), "First value, in the machine's units."),
            "to": told(number.clone(), "Last value."),
            "count": told(count(1, MOST), "Values of a grid, both ends included."),
            "values": told(json!({ "type": "array", "items": number, "minItems": 1 }), "These values."),
            "scale": told(json!({ "enum": ["linear", "log"] }), "How they are spaced."),
            "sample": told(json!({ "enum": ["random", "sobol"] }), "How they are drawn, instead of a grid."),
        },
        "additionalProperties": false,
    });
    json!({
        "$schema": schema::DRAFT,
        "title": "softstop study",
        "description": "What softstop study computes.",
        "type": "object",
        "required": ["axis", "outputs"],
        "properties": {
            "machine": told(json!({ "type": "string" }), "Machine file, seen from the study's folder, or `unloaded` (A) or `loaded` (B)."),
            "set": told(json!({ "type": "array", "items": { "type": "string" } }), "Changes of the machine: `stop.stiffness=8e6`."),
            "axis": told(json!({ "type": "array", "items": axis, "minItems": 1 }), "The axes, the slowest first."),
            "samples": told(count(1, MOST), "Samples of the drawn axes at each point of the grid."),
            "seed": told(count(0, u32::MAX.into()), "Seed of what is drawn."),
            "outputs": told(json!({ "type": "array", "items": { "enum": names }, "minItems": 1, "uniqueItems": true }), "What is told of each point."),
            "motion": told(json!({
                "type": "object",
                "properties": {
                    "periods": told(count(16, 1_000_000), "Drive periods that each motion is followed."),
                    "longest": told(count(16, 16_000_000), "Drive periods at most: what has not returned is followed on to twice as many, again and again, up to these; 16 times `periods` if absent."),
                    "watched": told(count(16, 4096), "The last of them, in which it is looked at; 64, or `periods` if these are fewer, if absent."),
                    "tolerance": told(number.clone(), "Distance within which a state has returned, as a share of the motion's size."),
                },
                "additionalProperties": false,
            }), "How motions are followed, from the machine's own start."),
            "certainty": told(json!({
                "type": "object",
                "properties": {
                    "starts": told(count(1, 100_000), "Starts at each point."),
                    "position": told(range.clone(), "Where they lie, in m; without it in the box of the machine's size."),
                    "velocity": told(range, "The same in m/s."),
                },
                "dependentRequired": { "position": ["velocity"], "velocity": ["position"] },
                "additionalProperties": false,
            }), "How the share of starts is found."),
        },
        "additionalProperties": false,
    })
}
