//! The JSON Schema of machine files, made from the list of parameters, and parts of that of task files.

use clap::ValueEnum;
use serde_json::{Map, Value, json};
use softstop::internals::{MAX_DAMPER_RATE, MAX_SPRING_RATE};
use softstop::{Allowed, Below, Machine, Parameter, Release, Scene, Stop, UnitSystem};

/// The draft in which schemas are written.
pub const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// One of the words of the command line.
pub fn words<T: ValueEnum>() -> Value {
    let words = T::value_variants().iter();
    let words = words.filter_map(|word| Some(word.to_possible_value()?.get_name().to_owned()));
    json!({ "enum": words.collect::<Vec<_>>() })
}

/// The schema of machine files (draft 2020-12). Editors find it by a first line
/// `#:schema ./machine.schema.json`.
pub fn machine() -> Value {
    let mut si = sections(UnitSystem::Si);
    let mut required = required(&si);
    si.extend([
        ("name".to_owned(), text("Its name, also that of its FMU.")),
        ("description".to_owned(), text("What it is, in a sentence.")),
        ("ratios".to_owned(), ratios()),
    ]);
    let start = older(&si["initial"], "initial");
    let damping = older(&si["contact"]["properties"]["damping"], "contact.damping");
    let task = |name: &str| {
        let kind = if name == "case" { "array" } else { "object" };
        json!({ "type": kind, "description": "For softstop optimize; `softstop schema task` tells more." })
    };
    si.extend(Machine::TASK.map(|table| (table.to_owned(), task(table))));
    si.insert("start".to_owned(), start);
    si.insert("contact_damping".to_owned(), damping);
    let own = ["name", "description", "initial", "start", "ratios"];
    let beside = [&own[..], &Machine::TASK].concat();
    required.retain(|key| key != "contact");
    json!({
        "$schema": DRAFT,
        "title": "softstop machine",
        "description": "An impact oscillator in SI units, or in the paper's ratios (m = k1 = F0 = 1).",
        "type": "object",
        "properties": si,
        "additionalProperties": false,
        "not": { "required": ["initial", "start"] },
        "if": { "required": ["ratios"] },
        "then": {
            "propertyNames": { "enum": beside },
            "not": {
                "properties": { "ratios": { "required": ["initial"] } },
                "anyOf": [{ "required": ["initial"] }, { "required": ["start"] }],
            },
        },
        "else": {
            "required": required,
            "oneOf": [{ "required": ["contact"] }, { "required": ["contact_damping"] }],
        },
    })
}

/// The table of ratios.
fn ratios() -> Value {
    let sections = sections(UnitSystem::Ratios);
    let required = required(&sections);
    let mut ratios = object(sections);
    ratios["required"] = required.into();
    ratios
}

/// The keys of a machine in a language, by their tables.
fn sections(language: UnitSystem) -> Map<String, Value> {
    let mut all: Map<String, Value> = Map::new();
    for parameter in Parameter::ALL {
        match parameter.name().split_once('.') {
            _ if language == UnitSystem::Ratios && parameter.is_unit() => {}
            None => {
                all.insert(parameter.name().to_owned(), number(parameter, language));
            }
            Some(("stop", _)) => {}
            Some((section, field)) => {
                let section = all.entry(section).or_insert_with(|| object(Map::new()));
                section["properties"][field] = number(parameter, language);
            }
        }
    }
    for section in all.values_mut() {
        require_all(section);
    }
    let drive = &mut all["excitation"];
    drive["required"] = json!(["amplitude", "frequency"]);
    if language == UnitSystem::Ratios {
        drive["required"] = json!(["frequency"]);
    } else {
        let what =
            "drive frequency in Hz, instead of frequency; text, charts and JSON then speak Hz";
        drive["properties"]["frequency_hz"] = or_expression(within(Allowed::Positive, what));
        drive["required"] = json!(["amplitude"]);
        drive["oneOf"] = json!([{ "required": ["frequency"] }, { "required": ["frequency_hz"] }]);
    }
    let state = |what| within(Allowed::Finite, what);
    let initial = [
        ("position".to_owned(), state("position at time 0")),
        ("velocity".to_owned(), state("velocity at time 0")),
    ];
    all.insert("initial".to_owned(), object(Map::from_iter(initial)));
    all.insert("stop".to_owned(), stop(language));
    all
}

/// Keys that every machine states.
fn required(sections: &Map<String, Value>) -> Vec<String> {
    let optional = ["piercing", "rigid", "initial"];
    let mut keys: Vec<String> = sections.keys().cloned().collect();
    keys.retain(|key| !optional.contains(&key.as_str()));
    keys
}

fn text(what: &str) -> Value {
    json!({ "type": "string", "description": what })
}

fn object(properties: Map<String, Value>) -> Value {
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

fn older(schema: &Value, name: &str) -> Value {
    let mut schema = schema.clone();
    schema["deprecated"] = true.into();
    schema["description"] = format!("older spelling of {name}").into();
    schema
}

fn require_all(section: &mut Value) {
    if let Some(properties) = section["properties"].as_object() {
        let keys: Vec<String> = properties.keys().cloned().collect();
        section["required"] = keys.into();
    }
}

/// A parameter: a number in its range, or an expression.
fn number(parameter: Parameter, language: UnitSystem) -> Value {
    let about = parameter.about();
    let what = match (language, about.dimension.unit()) {
        (UnitSystem::Ratios, _) => format!("{} ({})", about.meaning, about.symbol),
        (_, "") => about.meaning.to_owned(),
        (_, unit) => format!("{} in {unit}", about.meaning),
    };
    or_expression(within(about.allowed, &(what + &pace(parameter))))
}

/// A number, or an expression of other parameters.
fn or_expression(mut number: Value) -> Value {
    number["type"] = json!(["number", "string"]);
    number["pattern"] = json!("[^0-9.]");
    number
}

/// How far its time scale may lie from the drive's.
fn pace(parameter: Parameter) -> String {
    use Parameter as P;
    match parameter {
        P::Frequency => format!(
            "; at least {:e} of the rate sqrt(k1/m) of the suspension",
            1.0 / MAX_SPRING_RATE
        ),
        P::StopStiffness | P::BelowStiffness | P::PiercingStiffness | P::PiercingFriction => {
            format!("; its rate sqrt(k/m) is at most {MAX_SPRING_RATE:e} times the drive frequency")
        }
        P::Damping | P::ContactDamping => {
            format!(
                "; its rate, damping over mass, is at most {MAX_DAMPER_RATE:e} times the drive frequency"
            )
        }
        _ => String::new(),
    }
}

/// A number in a range.
fn within(allowed: Allowed, what: &str) -> Value {
    let (limit, least) = match allowed {
        Allowed::Finite => ("minimum", -Allowed::LARGEST),
        Allowed::Positive => ("exclusiveMinimum", 0.0),
        Allowed::NotNegative | Allowed::Share => ("minimum", 0.0),
        Allowed::Power => ("minimum", 1.0),
    };
    let most = match allowed {
        Allowed::Share => 1.0,
        Allowed::Power => Allowed::HIGHEST_POWER,
        _ => Allowed::LARGEST,
    };
    json!({ "type": "number", "description": what, limit: least, "maximum": most })
}

/// A stop of each law.
fn stops() -> [Stop; 6] {
    [
        Stop::None,
        Stop::KelvinVoigt {
            stiffness: 1.0,
            release: Release::Clearance,
        },
        Stop::PiecewiseLinear {
            loading: Vec::new(),
            unloading: Vec::new(),
        },
        Stop::Hertz {
            stiffness: 1.0,
            exponent: 1.5,
            dissipation: 0.0,
        },
        Stop::Preloaded {
            stiffness: 1.0,
            preload: 0.0,
        },
        Stop::Rigid { restitution: 1.0 },
    ]
}

fn stop(language: UnitSystem) -> Value {
    let below = stops().map(|stop| law(stop, language, true));
    let below = json!({ "type": "object", "required": ["model", "clearance"], "oneOf": below });
    let laws = stops().map(|stop| {
        let mut law = law(stop, language, false);
        law["properties"]["below"] = below.clone();
        law
    });
    json!({ "type": "object", "required": ["model"], "oneOf": laws })
}

/// The keys of one law, of the stop or of the one below.
fn law(stop: Stop, language: UnitSystem, is_below: bool) -> Value {
    let model = stop.model();
    let chained = matches!(stop, Stop::PiecewiseLinear { .. });
    let released = matches!(stop, Stop::KelvinVoigt { .. });
    let (machine, table) = if is_below {
        let mut scene = Scene::of_stop(Stop::None);
        let below = Below {
            clearance: 1.0,
            stop,
        };
        scene.below = Some(below.into());
        (Machine::from(scene), "stop.below.")
    } else {
        (Machine::from(Scene::of_stop(stop)), "stop.")
    };
    let own = machine.parameters().filter_map(|parameter| {
        let field = parameter.name().strip_prefix(table)?;
        Some((field.to_owned(), number(parameter, language)))
    });
    let mut properties = Map::from_iter(own);
    let optional = ["exponent", "dissipation"];
    let mut required: Vec<String> = properties.keys().cloned().collect();
    required.retain(|key| !optional.contains(&key.as_str()));
    required.push("model".to_owned());
    properties.insert("model".to_owned(), json!({ "const": model }));
    if released {
        let ways = ["clearance", "zeroForce"];
        properties.insert("release".to_owned(), json!({ "enum": ways }));
    }
    if chained {
        let chain = |least| json!({ "type": "array", "items": slope(), "minItems": least });
        properties.insert("loading".to_owned(), chain(1));
        properties.insert("unloading".to_owned(), chain(0));
        required.push("loading".to_owned());
    }
    let mut law = object(properties);
    if machine.value(Parameter::Preload).is_some() {
        required.retain(|key| key != "preload");
        let what = "preload as a deflection, instead of preload: the force follows the stiffness";
        law["properties"]["preload_deflection"] = or_expression(within(Allowed::NotNegative, what));
        law["oneOf"] = json!([
            { "required": ["preload"] },
            { "required": ["preload_deflection"] },
        ]);
    }
    law["required"] = required.into();
    law
}

fn slope() -> Value {
    let number = |what| within(Allowed::NotNegative, what);
    let mut slope = object(Map::from_iter([
        ("from".to_owned(), number("deflection at which it begins")),
        ("stiffness".to_owned(), number("its stiffness")),
    ]));
    require_all(&mut slope);
    slope
}
