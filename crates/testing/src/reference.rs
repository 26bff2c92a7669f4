//! The results of the many-digit integrations of tests/reference, each file parsed once.

use std::sync::LazyLock;

use serde_json::Value;
use softstop::{Ratios, Strip};

/// Clearance, and velocity and frequency at the fold of z = 1, unloaded, k4/k1 = 7 (from an independent exact
/// integrator).
pub const FOLDS: [(f64, f64, f64); 9] = [
    (2.0, 10.74, 1.69031),
    (4.0, 16.10, 1.57552),
    (6.0, 17.34, 1.49593),
    (8.0, 17.27, 1.42847),
    (10.0, 16.87, 1.36904),
    (12.0, 16.23, 1.31583),
    (14.0, 15.37, 1.26746),
    (16.0, 14.25, 1.22271),
    (18.0, 12.81, 1.18034),
];

/// A number that the reference files hold as text (30 or 40 digits) or as a double.
pub fn number(value: &Value, key: &str) -> f64 {
    match &value[key] {
        Value::String(text) => text.parse().expect("a number"),
        other => other
            .as_f64()
            .unwrap_or_else(|| panic!("{key} missing in {value}")),
    }
}

/// The list under a key.
pub fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key]
        .as_array()
        .unwrap_or_else(|| panic!("{key} missing in {value}"))
}

/// A JSON file of tests/reference.
macro_rules! data {
    ($name:literal) => {
        LazyLock::new(|| {
            let text = include_str!(concat!("../../../tests/reference/", $name));
            serde_json::from_str(text).expect($name)
        })
    };
}

/// The 40-digit results of tests/reference/flow.py.
pub static FLOW: LazyLock<Value> = data!("flow.json");
/// The 40-digit results of tests/reference/force.py.
pub static FORCE: LazyLock<Value> = data!("force.json");
/// The 30-digit results of tests/reference/machine.py.
pub static MACHINE: LazyLock<Value> = data!("machine.json");
/// The 30-digit results of tests/reference/stops.py.
pub static STOPS: LazyLock<Value> = data!("stops.json");
/// The 30-digit results of tests/reference/zones.py.
pub static ZONES: LazyLock<Value> = data!("zones.json");

/// The machine that a record of machine.json describes.
pub fn ratios(parameters: &Value) -> Ratios {
    let get = |key: &str, default: f64| match parameters.get(key) {
        Some(_) => number(parameters, key),
        None => default,
    };
    Ratios {
        frequency: get("frequency", 1.0),
        clearance: number(parameters, "clearance"),
        damping: number(parameters, "damping"),
        contact_damping: number(parameters, "contact_damping"),
        stiffness: number(parameters, "stiffness"),
        preload: number(parameters, "preload"),
        rigid: None,
        piercing: (parameters["regime"] == "loaded").then(|| Strip {
            stiffness: number(parameters, "k2"),
            friction: number(parameters, "k3"),
            thickness: number(parameters, "sigma"),
            travel: number(parameters, "sigma_nu") - number(parameters, "sigma"),
        }),
    }
}
