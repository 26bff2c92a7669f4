//! Machine files that the program writes are the machines that they were written of.

use proptest::prelude::*;
use softstop::{Machine, Parameter, Scene, Start, UnitSystem, Units};
use softstop_testing::machines::machines;
use softstop_testing::random::cases;

/// What a user may have said besides the scene: no control characters, but lines and tabs in a description.
type Words = (Option<String>, Option<String>, [f64; 2]);

fn words() -> impl Strategy<Value = Words> {
    let name = prop::option::of(r"[^\p{Cc}]{0,30}");
    let description = prop::option::of(r"[\n\t[^\p{Cc}]]{0,30}");
    (name, description, [-20.0..20.0f64, -20.0..20.0f64])
}

fn machine(scene: Scene, (name, description, start): Words) -> Machine {
    Machine {
        name,
        description,
        start: Start::new(start[0], start[1]),
        ..Machine::from(scene)
    }
}

fn comes_back(machine: &Machine) -> Result<(), TestCaseError> {
    let text = machine.to_toml();
    let read = Machine::from_toml(&text);
    let read = read.map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
    prop_assert_eq!(&read, machine, "{}", text);
    Ok(())
}

proptest! {
    #![proptest_config(cases(2_000))]

    #[test]
    fn in_ratios_and_si(scene in machines(), words in words(), mass in 0.1..500.0f64, stiffness in 1e3..1e7f64) {
        let ratios = Machine { unit_system: UnitSystem::Ratios, ..machine(scene.clone(), words.clone()) };
        comes_back(&ratios)?;
        let units = Units { mass, stiffness, force: 1e3 };
        comes_back(&machine(scene.in_units(units)?, words))?;
    }

    #[test]
    fn in_hertz_with_a_preload_as_a_deflection(
        scene in machines(), words in words(), hertz in 0.05..400.0f64, deflection in 0.0..0.5f64,
    ) {
        let mut machine = Machine { unit_system: UnitSystem::Hertz, ..machine(scene, words) };
        machine.set(Parameter::Frequency, hertz);
        if machine.value(Parameter::Preload).is_some() {
            machine.preload_deflection = Some(0.0);
            machine.set(Parameter::Preload, deflection);
        }
        comes_back(&machine)?;
    }
}

/// Not every frequency in rad/s is that of a number of Hz.
#[test]
fn a_frequency_that_no_number_of_hertz_gives_is_rounded_once()
-> Result<(), Box<dyn std::error::Error>> {
    let mut machine = Machine::named("unloaded").ok_or("the paper's")?;
    machine.unit_system = UnitSystem::Hertz;
    let mut frequency = 1.15f64;
    for _ in 0..1_000 {
        frequency = frequency.next_up();
        machine.scene.excitation.frequency = frequency;
        let once = Machine::from_toml(&machine.to_toml())?;
        let near = once.scene.excitation.frequency;
        assert!((frequency.next_down()..=frequency.next_up()).contains(&near));
        assert_eq!(Machine::from_toml(&once.to_toml())?, once);
    }
    Ok(())
}
