//! Machines as their users state them: files, keys, units.

use std::fs;
use std::path::Path;

use approx::assert_relative_eq;
use softstop::{
    Allowed, CheckedScene, Clock, Dimension, Machine, MachineError, MotionError, Parameter, Ratios,
    Scene, Start, Stop, UnitSystem,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A machine in SI units with everything that one can have beside this stop.
fn full(stop: &str) -> Result<Machine, MachineError> {
    Machine::from_toml(&format!(
        "mass = 20\nstiffness = 8e4\ndamping = 50\nclearance = 0.012\ncontact.damping = 230\n\
         excitation = {{ amplitude = 96, frequency = 73, phase = 0.5 }}\nstop = {stop}\n\
         piercing = {{ stiffness = 1e6, friction = 2e6, thickness = 0.001, travel = 0.002 }}\n\
         rigid = {{ travel = 0.003, restitution = 0.6 }}\n\
         initial = {{ position = 0.001, velocity = -0.5 }}\n"
    ))
}

/// The paper's loaded machine with another stop, in ratios.
fn ratios(stop: &str) -> Result<Machine, MachineError> {
    Machine::from_toml(&format!(
        "name = \"model\"\n[ratios]\ndamping = 0.02\nclearance = 10\ncontact.damping = 0.09\n\
         excitation.frequency = 1.15\nstop = {stop}\n\
         piercing = {{ stiffness = 21, friction = 23, thickness = 0.4, travel = 0.5 }}\n\
         rigid = {{ travel = 5, restitution = 0.6 }}\n[initial]\nvelocity = 14\n"
    ))
}

const STOPS: [&str; 11] = [
    "{ model = \"none\" }",
    "{ model = \"kelvinVoigt\", stiffness = 100 }",
    "{ model = \"piecewiseLinear\", loading = [{ from = 0, stiffness = 20 }, { from = 0.3, stiffness = 90 }] }",
    "{ model = \"hertz\", stiffness = 150, dissipation = 0.06 }",
    "{ model = \"preloaded\", stiffness = 7, preload = 70 }",
    "{ model = \"rigid\", restitution = 0.6 }",
    "{ model = \"none\", below = { clearance = 3, model = \"kelvinVoigt\", stiffness = 100 } }",
    "{ model = \"rigid\", restitution = 0.6, below = { clearance = 3, model = \"rigid\", restitution = 0.7 } }",
    "{ model = \"kelvinVoigt\", stiffness = 100, below = { clearance = 3, model = \"hertz\", stiffness = 9, dissipation = 0.1 } }",
    "{ model = \"hertz\", stiffness = 100, below = { clearance = 3, model = \"preloaded\", stiffness = 9, preload = 8 } }",
    "{ model = \"preloaded\", stiffness = 7, preload = 70, below = { clearance = 3, model = \"piecewiseLinear\", \
     loading = [{ from = 0, stiffness = 20 }] } }",
];

/// A checked scene that takes the laws of another one over moves as one that is lowered anew, to the last bit.
#[test]
fn checked_scenes_lend_their_phases() -> Outcome {
    let end = |scene: &CheckedScene| -> Result<Start, MotionError> {
        let mut motion = scene.motion(Start::new(0.0, 14.0))?;
        motion.advance(Clock::at_cycle(20), &mut ())?;
        Ok(motion.state())
    };
    for stop in STOPS {
        let scene = ratios(stop)?.scene;
        let known = scene.check()?;
        end(&known)?;
        let mut changed = Vec::new();
        for frequency in [0.9, 1.6] {
            let mut driven = scene.at_frequency(frequency);
            driven.excitation.amplitude = 1.3;
            driven.excitation.phase = 0.7;
            changed.push(driven);
        }
        let mass = 1.1 * scene.mass;
        changed.push(Scene {
            mass,
            ..scene.clone()
        });
        for other in changed {
            let (lent, anew) = (known.recheck(other.clone())?, other.check()?);
            assert_eq!(end(&lent)?, end(&anew)?, "{stop}");
            let turned = end(&lent.at_phase(0.2)?)?;
            let mut other = other;
            other.excitation.phase = 0.2;
            assert_eq!(turned, end(&other.check()?)?, "{stop}");
        }
        for frequency in [f64::NAN, -1.0, 0.0] {
            let mut driven = scene.clone();
            driven.excitation.frequency = frequency;
            assert!(known.recheck(driven).is_err(), "{stop} {frequency}");
        }
        assert!(known.clone().at_phase(f64::NAN).is_err());
        let mut written = serde_json::to_value(&known)?;
        assert_eq!(
            serde_json::from_value::<CheckedScene>(written.clone())?,
            known
        );
        written["mass"] = (-1.0).into();
        assert!(serde_json::from_value::<CheckedScene>(written).is_err());
    }
    Ok(())
}

#[test]
fn every_parameter_is_set_by_its_name_its_letter_and_its_older_names() -> Outcome {
    let mut seen = Vec::new();
    for read in [full, ratios] {
        for stop in STOPS {
            let machine = read(stop)?;
            for parameter in machine.parameters() {
                seen.push(parameter);
                let about = parameter.about();
                let (text, value) = match about.allowed {
                    Allowed::Share => ("0.25", 0.25),
                    _ => ("1.75", 1.75),
                };
                let mut changed = machine.clone();
                changed.apply([(about.name, text)])?;
                assert_eq!(changed.value(parameter), Some(value), "{}", about.name);
                assert_ne!(changed, machine, "{}", about.name);
                let others = machine.parameters().filter(|other| *other != parameter);
                for other in others {
                    assert_eq!(
                        changed.value(other),
                        machine.value(other),
                        "{}",
                        other.name()
                    );
                }
                for alias in about.aliases {
                    let found = machine.parameter(alias)?;
                    assert!(found.is_called(alias));
                    assert_eq!(machine.parameter(&alias.replace('_', "-"))?, found);
                }
                match machine.parameter(about.letter) {
                    Err(MachineError::Ratio(_, key)) if machine.unit_system == UnitSystem::Si => {
                        assert_eq!(key, about.name);
                    }
                    found => assert_eq!(found?.about().letter, about.letter),
                }
            }
        }
    }
    for parameter in Parameter::ALL {
        assert!(seen.contains(&parameter), "{} is nowhere", parameter.name());
    }
    Ok(())
}

#[test]
fn no_name_or_letter_means_two_parameters_of_one_machine() -> Outcome {
    for read in [full, ratios] {
        for stop in STOPS {
            let machine = read(stop)?;
            let has: Vec<Parameter> = machine.parameters().collect();
            for parameter in &has {
                let about = parameter.about();
                let same = has
                    .iter()
                    .filter(|other| other.about().letter == about.letter);
                // R is that of the stop, if that is rigid; one behind it is out of reach.
                let most = if about.letter == "R" { 2 } else { 1 };
                assert!(same.count() <= most, "{}", about.letter);
            }
        }
    }
    assert_eq!(
        full(STOPS[4])?.parameter("stiffness")?,
        Parameter::Suspension
    );
    assert_eq!(
        ratios(STOPS[4])?.parameter("stiffness")?,
        Parameter::StopStiffness
    );
    Ok(())
}

#[test]
fn the_files_of_docs_are_read_as_before() -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scenes");
    let mut count = 0;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let text = fs::read_to_string(&path)?;
        let machine = Machine::from_toml(&text).map_err(|error| format!("{path:?}: {error}"))?;
        assert_eq!(machine.unit_system, UnitSystem::Si);
        let older = text
            .replace("contact.damping", "contact_damping")
            .replace("[initial]", "[start]");
        assert_eq!(Machine::from_toml(&older)?, machine, "{path:?}");
        count += 1;
    }
    assert!(count >= 16);
    Ok(())
}

#[test]
fn ratios_are_the_papers() -> Outcome {
    let machine = Machine::from_toml(
        "[ratios]\ndamping = 0.02\nclearance = 10\ncontact.damping = 0.09\n\
         excitation.frequency = 1.15\nstop = { model = \"preloaded\", stiffness = 7, preload_deflection = 10 }\n",
    )?;
    assert_eq!(machine.scene, Ratios::unloaded().scene()?);
    assert_eq!(machine.ratios(), Some(Ratios::unloaded()));
    assert_eq!(machine.value(Parameter::Damping), Some(0.02));
    assert_eq!(machine.value(Parameter::Mass), None);
    assert_eq!(machine.unit(Dimension::Length), "");
    assert_eq!(
        Machine::named("unloaded").and_then(|it| it.ratios()),
        Some(Ratios::unloaded())
    );
    assert_eq!(
        Machine::named("loaded").and_then(|it| it.ratios()),
        Some(Ratios::loaded())
    );
    Ok(())
}

#[test]
fn a_preload_stated_as_a_deflection_follows_the_stiffness() -> Outcome {
    let mut machine = Machine::named("unloaded").ok_or("none")?;
    machine.apply([("preload_deflection", "10"), ("k4", "8")])?;
    assert_eq!(Parameter::Preload.get(&machine.scene), Some(80.0));
    assert_eq!(machine.value(Parameter::Preload), Some(10.0));
    machine.set(Parameter::StopStiffness, 9.0);
    assert_eq!(Parameter::Preload.get(&machine.scene), Some(90.0));
    machine.apply([("stop.preload", "70"), ("stop.stiffness", "3")])?;
    assert_eq!(machine.value(Parameter::Preload), Some(70.0));
    Ok(())
}

#[test]
fn frequencies_are_spoken_in_hertz_if_stated_so() -> Outcome {
    let text = "mass = 1\nstiffness = 1\ndamping = 0.04\nclearance = 10\ncontact.damping = 0.18\n\
                excitation = { amplitude = 1, frequency_hz = 0.2 }\nstop.model = \"none\"\n";
    let mut machine = Machine::from_toml(text)?;
    assert_relative_eq!(
        machine.scene.excitation.frequency,
        0.2 * std::f64::consts::TAU
    );
    assert_relative_eq!(machine.value(Parameter::Frequency).ok_or("none")?, 0.2);
    assert_eq!(
        machine.label_of(Parameter::Frequency),
        "drive frequency (Hz)"
    );
    machine.apply([("excitation.frequency", "1.15")])?;
    assert_eq!(machine.scene.excitation.frequency, 1.15);
    machine.apply([("excitation.frequency_hz", "0.5")])?;
    assert_relative_eq!(machine.scene.excitation.frequency, std::f64::consts::PI);
    Ok(())
}

/// The key decides the unit, whichever of the two a machine is stated in.
#[test]
fn keys_have_one_unit_on_every_machine() -> Outcome {
    let si = full(STOPS[4])?;
    let mut hertz = si.clone();
    hertz.apply([("excitation.frequency_hz", "11.6")])?;
    let paper = ratios(STOPS[4])?;
    let unit = |machine: &Machine, key: &str| machine.stated(key).map(|(_, unit)| unit);
    let tau = std::f64::consts::TAU;
    for (rad, hz) in [
        ("excitation.frequency", "excitation.frequency_hz"),
        ("frequency", "frequency-hz"),
    ] {
        assert_eq!(
            (unit(&si, rad)?, unit(&hertz, hz)?, unit(&paper, rad)?),
            (1.0, 1.0, 1.0)
        );
        assert_eq!((unit(&si, hz)?, unit(&hertz, rad)?), (tau, 1.0 / tau));
        assert!(unit(&paper, hz).is_err());
    }
    let mut deflected = si.clone();
    deflected.apply([("stop.preload_deflection", "0.01")])?;
    for (machine, is, other) in [
        (&si, "stop.preload", "stop.preload_deflection"),
        (&deflected, "stop.preload_deflection", "stop.preload"),
    ] {
        assert_eq!(unit(machine, is)?, 1.0);
        let said = unit(machine, other).err().ok_or("accepted")?.to_string();
        assert!(said.contains(is), "{said}");
    }
    Ok(())
}

#[test]
fn letters_of_ratios_are_refused_in_si_units() -> Outcome {
    let si = full(STOPS[4])?;
    let mut hertz = si.clone();
    hertz.apply([("frequency_hz", "11.6")])?;
    let letters = [
        "beta1", "eta", "rho", "beta", "k4", "Fp", "k2", "k3", "sigma", "nu", "epsilon",
    ];
    for letter in letters {
        let error = si
            .clone()
            .apply([(letter, "0.5")])
            .err()
            .ok_or("accepted")?;
        assert!(matches!(error, MachineError::Ratio(..)), "{error}");
    }
    for letter in [
        "m", "k1", "b1", "F0", "w", "phi", "r", "b", "s", "v", "e", "R",
    ] {
        si.clone().apply([(letter, "0.5")])?;
    }
    for (machine, key) in [
        (si, "excitation.frequency"),
        (hertz, "excitation.frequency_hz"),
    ] {
        let said = machine
            .parameter("eta")
            .err()
            .ok_or("accepted")?
            .to_string();
        assert_eq!(
            said,
            format!("eta: is a ratio, but this machine is in SI units; say {key}")
        );
    }
    Ok(())
}

#[test]
fn a_new_stop_takes_only_what_is_set_with_it() -> Outcome {
    let mut machine = full(STOPS[4])?;
    machine.apply([("stop.model", "rigid"), ("stop.restitution", "0.5")])?;
    assert_eq!(machine.scene.stop, Stop::Rigid { restitution: 0.5 });
    let error = machine.apply([("stop.model", "preloaded"), ("k4", "5")]);
    assert!(error.is_err_and(|error| error.to_string().contains("preload")));
    machine.apply([
        ("stop.model", "piecewiseLinear"),
        ("stop.loading", "[{ from = 0, stiffness = 30 }]"),
    ])?;
    assert!(matches!(machine.scene.stop, Stop::PiecewiseLinear { .. }));
    Ok(())
}

/// A number of a slope is set by its key, and is the one that the whole chain would set; what is no slope is refused.
#[test]
fn slopes_are_set_one_by_one() -> Outcome {
    let changed = |first: f64, changes: &[(&'static str, &str)]| {
        let stop = format!(
            "{{ model = \"piecewiseLinear\", unloading = [{{ from = 0, stiffness = 5 }}], \
             loading = [{{ from = 0, stiffness = {first} }}, {{ from = 0.3, stiffness = 90 }}] }}"
        );
        let mut machine = full(&stop)?;
        machine.apply(changes.iter().copied())?;
        Ok::<Machine, MachineError>(machine)
    };
    let whole = changed(21.0, &[])?;
    let one = changed(30.0, &[("stop.loading.0.stiffness", "21")])?;
    assert_eq!(one.scene, whole.scene);
    for (key, value, message) in [
        ("stop.loading.2.stiffness", "5", "the stop has 2 of loading"),
        ("stop.unloading.0.stiffness", "soft", "soft"),
        ("stop.unloading.0.stiffness", "25", "unloading"),
        ("stop.loading.1.from", "-1", "-1"),
        ("stop.loading.0.mass", "1", "unknown key"),
    ] {
        let error = changed(20.0, &[(key, value)])
            .err()
            .map(|error| error.to_string());
        assert!(
            error.is_some_and(|error| error.contains(message)),
            "{key}: {message}"
        );
    }
    let chain = "[{ from = 0, stiffness = 1 }, { from = 0.3, stiffness = 90 }]";
    let both = [("stop.loading.0.stiffness", "21"), ("stop.loading", chain)];
    assert_eq!(changed(20.0, &both)?.scene, whole.scene);
    let twice = [("stop.loading.0.stiffness", "8"); 2];
    assert!(changed(20.0, &twice).is_err_and(|error| error.to_string().contains("twice")));
    Ok(())
}

/// What a scene says of itself is what its parameters say.
#[test]
fn parameters_reach_every_number_of_a_scene() -> Outcome {
    for stop in STOPS {
        let scene = full(stop)?.scene;
        let mut blank: Scene = scene.clone();
        for parameter in Parameter::ALL {
            parameter.set(&mut blank, f64::MAX);
        }
        for parameter in Parameter::ALL {
            if let Some(value) = parameter.get(&scene) {
                assert_eq!(parameter.get(&blank), Some(f64::MAX));
                parameter.set(&mut blank, value);
            }
        }
        assert_eq!(blank, scene);
    }
    Ok(())
}
