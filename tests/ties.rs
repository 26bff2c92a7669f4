//! Parameters that follow others by an expression.

use softstop::{Machine, MachineError, Parameter, UnitSystem};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A drive by an unbalance: its amplitude is 0.7 kg m times the frequency squared.
const UNBALANCE: &str = r#"
mass = 2.0
stiffness = 50.0
damping = 0.4
clearance = "0.5 * excitation.amplitude / stiffness"
contact.damping = "3 * damping"
excitation = { amplitude = "0.7 * excitation.frequency^2", frequency = 6.0 }
stop = { model = "preloaded", stiffness = 400.0, preload = "0.2 * stop.stiffness / stiffness" }
"#;

fn value(machine: &Machine, name: &str) -> f64 {
    let parameter = machine.parameter(name).expect(name);
    machine.value(parameter).expect(name)
}

/// What follows others has the value of its formula, whatever is set, and in whatever order the file states it.
#[test]
fn followers_have_the_values_of_their_formulas() -> Outcome {
    let mut machine = Machine::from_toml(UNBALANCE)?;
    for (frequency, stiffness, stop, damping) in [(6.0, 50.0, 400.0, 0.4), (5.0, 80.0, 300.0, 0.1)]
    {
        machine.set(Parameter::Frequency, frequency);
        machine.set(Parameter::Suspension, stiffness);
        machine.set(Parameter::StopStiffness, stop);
        machine.set(Parameter::Damping, damping);
        let amplitude = 0.7 * frequency * frequency;
        for (name, expected) in [
            ("excitation.amplitude", amplitude),
            ("clearance", 0.5 * amplitude / stiffness),
            ("contact.damping", 3.0 * damping),
            ("stop.preload", 0.2 * stop / stiffness),
        ] {
            let found = value(&machine, name);
            assert!((found / expected - 1.0).abs() < 1e-15, "{name}: {found}");
        }
        // What follows is not set by itself.
        machine.set(Parameter::Clearance, 1.0);
        assert_eq!(Machine::from_toml(&machine.to_toml())?, machine);
    }
    Ok(())
}

/// Names have the units that they have as keys, in each way to state a machine.
#[test]
fn expressions_are_in_the_units_of_their_keys() -> Outcome {
    let mut hertz = Machine::from_toml(UNBALANCE)?;
    hertz.apply([
        ("excitation.frequency_hz", "1.5"),
        ("excitation.amplitude", "excitation.frequency_hz * 2"),
        ("clearance", "excitation.frequency / 1000"),
        ("stop.preload_deflection", "clearance / 4"),
        ("damping", "stop.preload_deflection + stop.preload / 100"),
    ])?;
    assert_eq!(Machine::from_toml(&hertz.to_toml())?, hertz);
    let mut by_key = Machine::from_toml(UNBALANCE)?;
    by_key.apply([("excitation.frequency_hz", "mass / 2")])?;
    assert_eq!(by_key.value(Parameter::Frequency), Some(1.0));
    assert_eq!(Machine::from_toml(&by_key.to_toml())?, by_key);
    assert_eq!(hertz.unit_system, UnitSystem::Hertz);
    assert_eq!(value(&hertz, "excitation.amplitude"), 3.0);
    let clearance = 1.5 * std::f64::consts::TAU / 1000.0;
    assert!((value(&hertz, "clearance") / clearance - 1.0).abs() < 1e-15);
    assert!((hertz.preload_deflection.ok_or("none")? / (clearance / 4.0) - 1.0).abs() < 1e-15);
    let force = Parameter::Preload.get(&hertz.scene).ok_or("none")?;
    assert!((force / (100.0 * clearance) - 1.0).abs() < 1e-15);

    let mut ratios = Machine::named("unloaded").ok_or("none")?;
    ratios.apply([("beta", "4.5 * beta1"), ("rho", "8 + 2 * eta")])?;
    ratios.set(Parameter::Frequency, 1.25);
    assert!((value(&ratios, "beta") - 0.09).abs() < 1e-16);
    assert_eq!(value(&ratios, "rho"), 10.5);
    let again = Machine::from_toml(&ratios.to_toml())?;
    assert_eq!(again, ratios);
    Ok(())
}

/// A number lets go; a new stop lets go what is no longer there; a new model may follow at once.
#[test]
fn numbers_and_other_stops_let_go() -> Outcome {
    let mut machine = Machine::from_toml(UNBALANCE)?;
    machine.apply([("excitation.amplitude", "30")])?;
    machine.set(Parameter::Frequency, 7.0);
    assert_eq!(value(&machine, "excitation.amplitude"), 30.0);
    assert!((value(&machine, "clearance") - 0.3).abs() < 1e-15);
    machine.apply([
        ("stop.model", "kelvinVoigt"),
        ("stop.stiffness", "8 * stiffness"),
    ])?;
    assert_eq!(value(&machine, "stop.stiffness"), 400.0);
    let followers = machine.followers(Parameter::Suspension);
    assert_eq!(followers, [Parameter::Clearance, Parameter::StopStiffness]);
    machine.set(Parameter::Suspension, 60.0);
    assert_eq!(value(&machine, "stop.stiffness"), 480.0);
    Ok(())
}

#[test]
fn what_is_wrong_is_named_with_its_place() -> Outcome {
    for (change, says) in [
        (
            "damping = \"0.4 * masss\"",
            "line 4: damping = \"0.4 * masss\": masss: unknown key (did you mean mass?",
        ),
        (
            "damping = \"0.4 *\"",
            "ends where a number, a name or a bracket must stand",
        ),
        (
            "damping = \"damping / 2\"",
            "damping = \"damping / 2\": follows itself",
        ),
        ("damping = \"contact.damping / 2\"", "follows itself"),
        (
            "damping = \"-1 * mass\"",
            "damping = -2: must be finite and >= 0",
        ),
        ("damping = \"ln(-1 * mass)\"", "damping = NaN"),
        (
            "damping = \"much\"",
            "line 4: damping = \"much\": must be a number",
        ),
    ] {
        let text = UNBALANCE.replace("damping = 0.4", change);
        let error = Machine::from_toml(&text).err().ok_or(change)?;
        assert!(error.to_string().contains(says), "{change}: {error}");
    }
    let mut machine = Machine::from_toml(UNBALANCE)?;
    let error = machine.apply([("mass", "clearance + 1")]).err();
    assert!(error.is_none(), "{error:?}");
    let error = machine
        .apply([("stiffness", "10 * mass")])
        .err()
        .ok_or("accepted")?;
    assert!(error.to_string().contains("follows itself"), "{error}");
    let machine = Machine::from_toml(UNBALANCE)?;
    assert!(matches!(
        machine.free_parameter("clearance"),
        Err(MachineError::Follows { .. })
    ));
    assert!(machine.free_parameter("excitation.frequency").is_ok());
    Ok(())
}
