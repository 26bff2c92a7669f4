//! A machine in ratios and its twin in SI units have the same motions, each in its own units.

use approx::assert_relative_eq;
use softstop::{Machine, Parameter, Ratios, Units};
use softstop_console::report::{stated, stated_machine};
use softstop_dynamics::orbit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

const UNITS: Units = Units {
    mass: 20.0,
    stiffness: 8e4,
    force: 96.0,
};

/// In ratios: the paper's machines and others.
fn machines() -> Result<Vec<Machine>, Box<dyn std::error::Error>> {
    let named = [Ratios::unloaded(), Ratios::loaded()].map(|ratios| Machine::of_ratios(&ratios));
    let mut machines = named.into_iter().collect::<Result<Vec<_>, _>>()?;
    let others: [&[(&str, &str)]; 3] = [
        &[("stop.model", "kelvinVoigt"), ("stop.stiffness", "60")],
        &[("stop.model", "hertz"), ("stop.stiffness", "150")],
        &[("stop.model", "rigid"), ("stop.restitution", "0.6")],
    ];
    for changes in others {
        let mut machine = machines[0].clone();
        machine.apply(changes.iter().copied())?;
        machines.push(machine);
    }
    Ok(machines)
}

/// The same machine in SI units, its frequency in Hz.
fn twin(machine: &Machine) -> Result<Machine, Box<dyn std::error::Error>> {
    let mut twin = Machine::from(machine.scene.in_units(UNITS)?);
    let hertz = twin.scene.excitation.frequency / std::f64::consts::TAU;
    twin.apply([("excitation.frequency_hz", format!("{hertz:?}").as_str())])?;
    Ok(twin)
}

#[test]
fn orbits_of_twins_are_the_same() -> Outcome {
    for machine in machines()? {
        let twin = twin(&machine)?;
        let (own, other) = (orbit::find(&machine.scene)?, orbit::find(&twin.scene)?);
        let (length, velocity) = (UNITS.length(), UNITS.length() * UNITS.frequency());
        let near = |a: f64, b: f64| assert_relative_eq!(a, b, max_relative = 1e-9);
        near(own.position * length, other.position);
        near(own.velocity * velocity, other.velocity);
        near(
            own.before_impact_velocity() * velocity,
            other.before_impact_velocity(),
        );
        near(own.max_position * length, other.max_position);
        near(own.monodromy.trace(), other.monodromy.trace());
        let hertz = twin.value(Parameter::Frequency).ok_or("no frequency")?;
        let eta = machine.value(Parameter::Frequency).ok_or("no frequency")?;
        near(hertz * std::f64::consts::TAU, eta * UNITS.frequency());
    }
    Ok(())
}

#[test]
fn reports_speak_the_units_of_the_machine() -> Outcome {
    let machine = &machines()?[0];
    let paper = serde_json::to_value(stated(machine))?;
    assert_eq!(paper["regime"], "unloaded");
    assert_eq!(paper["stiffness"], 7.0);
    assert_eq!(paper["machine"]["language"], "ratios");
    assert_eq!(paper["machine"]["units"]["length"], "F0/k1");
    assert_eq!(paper["machine"]["units"]["damping"], "2 sqrt(m k1)");
    assert!(paper["machine"]["parameters"].get("mass").is_none());
    let twin = serde_json::to_value(stated(&twin(machine)?))?;
    assert!(twin.get("regime").is_none());
    let twin = &twin["machine"];
    assert_eq!(twin["language"], "hertz");
    assert_eq!(twin["units"]["frequency"], "Hz");
    assert_eq!(twin["units"]["length"], "m");
    assert_eq!(twin["parameters"]["mass"], 20.0);
    assert_eq!(twin["parameters"]["clearance"], 10.0 * UNITS.length());
    assert!(twin["parameters"]["excitation.frequency_hz"].is_number());
    Ok(())
}

#[test]
fn reports_tell_machines_apart_that_move_differently() -> Outcome {
    let slopes = "[{ from = 0, stiffness = 9 }]";
    let differences: [&[(&str, &str)]; 9] = [
        &[],
        &[("excitation.frequency", "1.2")],
        &[("excitation.phase", "0.3")],
        &[("name", "press")],
        &[("stop.preload_deflection", "10")],
        &[("stop.model", "kelvin-voigt"), ("stop.stiffness", "60")],
        &[
            ("stop.model", "kelvinVoigt"),
            ("stop.stiffness", "60"),
            ("stop.release", "zeroForce"),
        ],
        &[("stop.model", "piecewiseLinear"), ("stop.loading", slopes)],
        &[
            ("stop.model", "piecewiseLinear"),
            ("stop.loading", slopes),
            ("stop.unloading", "[{ from = 0, stiffness = 5 }]"),
        ],
    ];
    let mut reports = Vec::new();
    for changes in differences {
        let mut machine = machines()?[0].clone();
        machine.apply(changes.iter().copied())?;
        reports.push(serde_json::to_value(stated_machine(&machine))?);
    }
    for (index, report) in reports.iter().enumerate() {
        assert!(!reports[..index].contains(report), "{report}");
    }
    let keys = |index: usize| reports[index]["parameters"].clone();
    assert_eq!(keys(5)["stop.model"], "kelvinVoigt");
    assert_eq!(keys(5)["stop.release"], "clearance");
    assert_eq!(keys(8)["stop.unloading"][0]["stiffness"], 5.0);
    Ok(())
}
