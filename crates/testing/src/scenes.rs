//! Scenes of the paper, and those of tests/reference/stops.py and force.py.

use serde_json::Value;
use softstop::{
    Clock, Excitation, Instant, Piercing, Ratios, Release, RigidStop, Scene, Slope, Stop,
};

use crate::reference::{list, number};

/// The paper's unloaded machine at a frequency.
///
/// # Panics
/// If the frequency cannot be.
pub fn unloaded(frequency: f64) -> Scene {
    let ratios = Ratios::unloaded().at_frequency(frequency);
    ratios.scene().expect("valid")
}

/// The paper's loaded machine at point B.
pub fn loaded() -> Scene {
    Ratios::loaded().scene().expect("valid")
}

fn slopes(value: &Value, key: &str) -> Vec<Slope> {
    list(value, key)
        .iter()
        .map(|slope| Slope {
            from: slope[0].as_f64().expect("a deflection"),
            stiffness: slope[1].as_f64().expect("a stiffness"),
        })
        .collect()
}

fn stop(value: &Value) -> Stop {
    let stiffness = || number(value, "stiffness");
    match value["model"].as_str().expect("a model") {
        "kelvinVoigt" => Stop::KelvinVoigt {
            stiffness: stiffness(),
            release: match value["release"].as_str() {
                Some("zeroForce") => Release::ZeroForce,
                _ => Release::Clearance,
            },
        },
        "preloaded" => Stop::Preloaded {
            stiffness: stiffness(),
            preload: number(value, "preload"),
        },
        "piecewiseLinear" => Stop::PiecewiseLinear {
            loading: slopes(value, "loading"),
            unloading: slopes(value, "unloading"),
        },
        "hertz" => Stop::Hertz {
            stiffness: stiffness(),
            exponent: number(value, "exponent"),
            dissipation: number(value, "dissipation"),
        },
        "rigid" => Stop::Rigid {
            restitution: number(value, "restitution"),
        },
        "none" => Stop::None,
        other => panic!("unknown model {other}"),
    }
}

/// The scene of a case.
pub fn scene(value: &Value) -> Scene {
    let given = |key: &str| (!value[key].is_null()).then(|| &value[key]);
    Scene {
        damping: number(value, "damping"),
        excitation: Excitation {
            amplitude: 1.0,
            frequency: number(value, "frequency"),
            phase: number(value, "phase"),
        },
        clearance: number(value, "clearance"),
        contact_damping: number(value, "contact_damping"),
        piercing: given("strip").map(|strip| Piercing {
            stiffness: number(strip, "stiffness"),
            friction: number(strip, "friction"),
            thickness: number(strip, "thickness"),
            travel: number(strip, "travel"),
        }),
        rigid: given("rigid").map(|rigid| RigidStop {
            travel: number(rigid, "travel"),
            restitution: number(rigid, "restitution"),
        }),
        ..Scene::of_stop(stop(&value["stop"]))
    }
}

/// The instant after a number of drive periods.
pub fn instant(scene: &Scene, periods: f64) -> Instant {
    Instant {
        offset: periods.fract() * scene.period(),
        ..Clock::at_cycle(periods.floor() as u64)
    }
}
