//! The schema of machine files holds for the files, and refuses what the reader refuses.

use std::fs;
use std::path::Path;

use serde_json::Value;
use softstop::Machine;
use softstop_console::schema;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// True if a value fulfils a schema, of the words that ours uses.
fn fulfils(value: &Value, schema: &Value) -> bool {
    let Some(schema) = schema.as_object() else {
        return false;
    };
    schema
        .iter()
        .all(|(word, rule)| holds(value, word, rule, schema))
}

fn holds(value: &Value, word: &str, rule: &Value, all: &serde_json::Map<String, Value>) -> bool {
    let list = || rule.as_array().into_iter().flatten();
    let keys = || {
        value
            .as_object()
            .into_iter()
            .flat_map(|object| object.keys())
    };
    let limit = rule.as_f64().unwrap_or(f64::NAN);
    let number = value.as_f64();
    match word {
        "$schema" | "title" | "description" | "deprecated" | "then" | "else" => true,
        "type" if rule.is_array() => list().any(|rule| holds(value, word, rule, all)),
        "pattern" => {
            assert_eq!(*rule, "[^0-9.]");
            let is_other = |it| !matches!(it, '0'..='9' | '.');
            value.as_str().is_none_or(|text| text.contains(is_other))
        }
        "type" => match rule.as_str() {
            Some("object") => value.is_object(),
            Some("array") => value.is_array(),
            Some("string") => value.is_string(),
            Some("number") => value.is_number(),
            other => panic!("type {other:?}"),
        },
        "properties" => {
            keys().all(|key| rule.get(key).is_none_or(|rule| fulfils(&value[key], rule)))
        }
        "additionalProperties" => {
            *rule == Value::Bool(false) && keys().all(|key| all["properties"].get(key).is_some())
        }
        "propertyNames" => keys().all(|key| fulfils(&Value::from(key.as_str()), rule)),
        "required" => list().all(|key| value.get(key.as_str().unwrap_or_default()).is_some()),
        "not" => !fulfils(value, rule),
        "anyOf" => list().any(|rule| fulfils(value, rule)),
        "minItems" => value
            .as_array()
            .is_none_or(|items| items.len() as f64 >= limit),
        "oneOf" => list().filter(|rule| fulfils(value, rule)).count() == 1,
        "items" => value
            .as_array()
            .into_iter()
            .flatten()
            .all(|item| fulfils(item, rule)),
        "enum" => list().any(|one| one == value),
        "const" => rule == value,
        "minimum" => number.is_none_or(|number| number >= limit),
        "exclusiveMinimum" => number.is_none_or(|number| number > limit),
        "maximum" => number.is_none_or(|number| number <= limit),
        "if" => fulfils(
            value,
            &all[if fulfils(value, rule) { "then" } else { "else" }],
        ),
        other => panic!("the test does not know the word {other}"),
    }
}

/// Whether schema and reader take a text.
fn taken(text: &str) -> Result<(bool, bool), Box<dyn std::error::Error>> {
    let value = serde_json::to_value(text.parse::<toml::Table>()?)?;
    Ok((
        fulfils(&value, &schema::machine()),
        Machine::from_toml(text).is_ok(),
    ))
}

#[test]
fn every_file_of_docs_fulfils_the_schema() -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scenes");
    let mut count = 0;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        assert_eq!(
            taken(&fs::read_to_string(&path)?)?,
            (true, true),
            "{path:?}"
        );
        count += 1;
    }
    assert!(count >= 16);
    Ok(())
}

#[test]
fn schema_and_reader_agree() -> Outcome {
    let si = "name = \"press\"\nmass = 1\nstiffness = 1\ndamping = 0.04\nclearance = 10\ncontact.damping = 0.18\n\
              [excitation]\namplitude = 1\nfrequency = 1.15\n\
              [stop]\nmodel = \"preloaded\"\nstiffness = 7\npreload = 70\n\
              [rigid]\ntravel = 5\nrestitution = 0.6\n[initial]\nposition = 1\n";
    let ratios = "description = \"paper\"\n[ratios]\ndamping = 0.02\nclearance = 10\ncontact.damping = 0.09\n\
                  excitation = { frequency = 1.15 }\n[ratios.stop]\nmodel = \"hertz\"\nstiffness = 150\n\
                  [ratios.piercing]\nstiffness = 21\nfriction = 23\nthickness = 0.4\ntravel = 0.5\n\
                  [initial]\nvelocity = 14\n";
    let slopes = "[ratios]\ndamping = 0.02\nclearance = 10\ncontact.damping = 0.09\n\
                  excitation.frequency = 1.15\ninitial.position = 1\n\
                  stop = { model = \"piecewiseLinear\", loading = [{ from = 0, stiffness = 20 }] }\n";
    let changes = [
        (si, "", "", true),
        (ratios, "", "", true),
        (si, "mass = 1", "mass = 0", false),
        (si, "mass = 1", "", false),
        (si, "mass = 1", "mass = \"1\"", false),
        (
            si,
            "mass = 1",
            "mass = \"2 * stiffness / excitation.frequency^2\"",
            true,
        ),
        (si, "damping = 0.04", "damping = -0.04", false),
        (si, "clearance = 10", "clearance = -10", true),
        (si, "clearance", "clearence", false),
        (si, "contact.damping", "contact_damping", true),
        (
            si,
            "contact.damping = 0.18",
            "contact.damping = 0.18\ncontact_damping = 0.18",
            false,
        ),
        (si, "contact.damping = 0.18", "", false),
        (si, "frequency = 1.15", "frequency_hz = 50", true),
        (
            si,
            "frequency = 1.15",
            "frequency = 1\nfrequency_hz = 50",
            false,
        ),
        (si, "frequency = 1.15", "frequency = 1.15\nphase = -2", true),
        (si, "preload = 70", "preload_deflection = 10", true),
        (
            si,
            "preload = 70",
            "preload = 70\npreload_deflection = 10",
            false,
        ),
        (si, "preload = 70", "", false),
        (si, "preload = 70", "restitution = 0.5", false),
        (si, "\"preloaded\"", "\"none\"", false),
        (si, "\"preloaded\"", "\"soft\"", false),
        (si, "restitution = 0.6", "restitution = 1.6", false),
        (si, "travel = 5", "", false),
        (si, "[initial]", "[start]", true),
        (ratios, "damping = 0.02", "mass = 1\ndamping = 0.02", false),
        (
            ratios,
            "frequency = 1.15",
            "frequency = 1.15, amplitude = 1",
            false,
        ),
        (ratios, "frequency = 1.15", "frequency_hz = 1.15", false),
        (ratios, "[ratios]", "mass = 1\n[ratios]", false),
        (
            ratios,
            "stiffness = 150",
            "stiffness = 150\nexponent = 0.5",
            false,
        ),
        (
            ratios,
            "stiffness = 150",
            "stiffness = 150\nexponent = 2\ndissipation = 0.1",
            true,
        ),
        (ratios, "friction = 23", "", false),
        (si, "[initial]", "[start]\nvelocity = 2\n[initial]", false),
        (si, "clearance = 10", "clearance = 1e25", false),
        (si, "position = 1", "position = 1e25", false),
        (ratios, "clearance = 10\n", "", false),
        (ratios, "contact.damping = 0.09\n", "", false),
        (ratios, "[ratios]", "[ratios]\ninitial.position = 1", false),
        ("[ratios]\nclearance = 10\n", "", "", false),
        (slopes, "", "", true),
        (slopes, "[{ from = 0, stiffness = 20 }]", "[]", false),
    ];
    for (file, from, to, good) in changes {
        let text = file.replacen(from, to, 1);
        assert_eq!(taken(&text)?, (good, good), "{from} -> {to}");
    }
    Ok(())
}
