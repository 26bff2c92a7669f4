//! Scenes of the paper, and those of tests/reference/stops.py and force.py.

use serde_json::Value;
use softstop::{
    Clock, Excitation, Instant, Machine, Ratios, Release, RigidStop, Scene, Slope, Stop, Strip,
    Units,
};

use crate::reference::number;

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

/// A machine of the paper, `unloaded` or `loaded`, with changes as `--set` takes them: `rho=22 eta=1.005`.
///
/// # Panics
/// If there is no such machine.
#[track_caller]
pub fn with_changes(name: &str, changes: &str) -> Scene {
    let mut machine = Machine::named(name).expect(name);
    let changes = changes.split_whitespace();
    let changed = machine.apply(changes.map(|it| it.split_once('=').expect("KEY=VALUE")));
    changed.unwrap_or_else(|error| panic!("{error}"));
    machine.scene
}

/// A power law: N/m^exponent, and Hunt and Crossley's factor in s/m.
pub const fn hertz(stiffness: f64, exponent: f64, dissipation: f64) -> Stop {
    Stop::Hertz {
        stiffness,
        exponent,
        dissipation,
    }
}

/// A spring, in N/m, that is loaded with a force, in N.
pub const fn preloaded(stiffness: f64, preload: f64) -> Stop {
    Stop::Preloaded { stiffness, preload }
}

/// A spring, in N/m, beside a damper.
pub const fn kelvin_voigt(stiffness: f64, release: Release) -> Stop {
    Stop::KelvinVoigt { stiffness, release }
}

/// A rigid stop, so far in m behind another one.
pub const fn rigid_stop(travel: f64, restitution: f64) -> RigidStop {
    RigidStop {
        travel,
        restitution,
    }
}

/// A slope of a chain: from a deflection in m on, in N/m.
pub const fn slope(from: f64, stiffness: f64) -> Slope {
    Slope { from, stiffness }
}

/// A strip: k2 and k3 in N/m, thickness and travel in m.
pub const fn piercing(stiffness: f64, friction: f64, thickness: f64, travel: f64) -> Strip {
    Strip {
        stiffness,
        friction,
        thickness,
        travel,
    }
}

/// Units of a machine in ratios: kg, N/m, N.
pub const fn units(mass: f64, stiffness: f64, force: f64) -> Units {
    Units {
        mass,
        stiffness,
        force,
    }
}

/// The scene of a case.
pub fn scene(value: &Value) -> Scene {
    let part = |key: &str| value[key].clone();
    let stop: Stop = serde_json::from_value(part("stop")).expect("a stop");
    Scene {
        damping: number(value, "damping"),
        excitation: Excitation {
            amplitude: 1.0,
            frequency: number(value, "frequency"),
            phase: number(value, "phase"),
        },
        clearance: number(value, "clearance"),
        contact_damping: number(value, "contact_damping"),
        piercing: serde_json::from_value(part("strip")).expect("a strip"),
        rigid: serde_json::from_value(part("rigid")).expect("a rigid stop"),
        ..Scene::of_stop(stop)
    }
}

/// The instant after a number of drive periods.
pub fn instant(scene: &Scene, periods: f64) -> Instant {
    Instant {
        offset: periods.fract() * scene.period(),
        ..Clock::at_cycle(periods.floor() as u64)
    }
}
