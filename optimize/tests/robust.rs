//! Tolerances: what the machines of a box do, against what is known of them.

mod distribution;
mod indices;
mod nearest;
mod verify;
mod worst;

use softstop::{Machine, Parameter};
use softstop_dynamics::{Orbit, orbit};
use softstop_optimize::robust::{AbsoluteTolerance, Distribution, Tolerances};

use crate::Outcome;

/// A press in SI units, with its strip, whose preload is stated as a deflection.
fn press() -> Outcome<Machine> {
    Ok(Machine::from_toml(
        r#"
        name = "press"
        mass = 120.0
        stiffness = 2.4e6
        damping = 680.0
        clearance = 0.0375
        contact.damping = 3050.0
        excitation = { amplitude = 9000.0, frequency_hz = 25.9 }
        stop = { model = "preloaded", stiffness = 1.68e7, preload_deflection = 0.0375 }
        piercing = { stiffness = 5.0e7, friction = 5.5e7, thickness = 0.002, travel = 0.002 }
        "#,
    )?)
}

/// The paper's machine of this name, and the press.
fn machines() -> Outcome<[Machine; 3]> {
    let [a, b] = ["unloaded", "loaded"].map(|name| Machine::named(name).ok_or("a machine"));
    Ok([a?, b?, press()?])
}

/// Tolerances by so many percent, each times `factor`, and the motion of the design.
fn spread(
    machine: &Machine,
    percent: &[(Parameter, f64)],
    factor: f64,
) -> Outcome<(Tolerances, Orbit)> {
    let half_width = |parameter: Parameter, percent: f64| {
        let value = match (parameter, machine.preload_deflection) {
            (Parameter::Preload, Some(deflection)) => Some(deflection),
            _ => parameter.get(&machine.scene),
        };
        Some(0.01 * percent * factor * value?.abs())
    };
    let tolerance = |(parameter, percent): &(Parameter, f64)| {
        let half_width = half_width(*parameter, *percent).ok_or("a parameter of the machine")?;
        Ok(AbsoluteTolerance {
            parameter: *parameter,
            half_width,
            distribution: Distribution::Box,
        })
    };
    let all: Result<Vec<AbsoluteTolerance>, &str> = percent.iter().map(tolerance).collect();
    let nominal = orbit::find(&machine.scene)?;
    Ok((Tolerances::new(machine, &all?)?, nominal))
}

/// Tolerances of a shop: in percent of the parameters' values.
const SHOP: [(Parameter, f64); 6] = [
    (Parameter::Clearance, 1.0),
    (Parameter::StopStiffness, 2.0),
    (Parameter::Preload, 2.0),
    (Parameter::ContactDamping, 5.0),
    (Parameter::Amplitude, 1.0),
    (Parameter::Frequency, 0.5),
];

/// Those of them that a machine has as its own: one in ratios has no drive amplitude.
fn shop(machine: &Machine) -> Vec<(Parameter, f64)> {
    let own = |(parameter, _): &(Parameter, f64)| machine.value(*parameter).is_some();
    SHOP.into_iter().filter(own).collect()
}
