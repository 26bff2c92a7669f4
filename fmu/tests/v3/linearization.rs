//! Model exchange: derivatives of the present outputs by states, inputs and tunable parameters.

use std::collections::BTreeSet;

use softstop_fmi::variable::Access;
use softstop_fmu::table;

use super::derivatives::assert_close;
use super::events::MACHINES;
use super::exchange::RESTING;
use super::integrator::Integrator;
use super::unit::Unit;
use crate::common::{ERROR, OK, reference};

const STATES: [&str; 2] = ["position", "velocity"];
const INPUTS: [&str; 4] = [
    "force",
    "base.acceleration",
    "drive.speed",
    "drive.amplitude",
];
const TUNABLE: [&str; 5] = [
    "excitation.amplitude",
    "excitation.frequency",
    "clearance",
    "stop.stiffness",
    "stop.preload",
];

/// Further machines, such that there is one in each phase.
const FURTHER: [&[(&str, f64)]; 4] = [
    &[("drive.takes.amplitude", 1.0), ("material", 0.0)],
    &[("drive.takes.speed", 1.0)],
    // Strip and stop stand behind the suspension's rest, where dry friction holds the mass.
    &[
        ("clearance", -2.0),
        ("excitation.amplitude", 1e-3),
        ("piercing.friction", 60.0),
        ("piercing.thickness", 4.0),
    ],
    &[
        ("stop.model", 2.0),
        ("stop.release", 2.0),
        ("contact.damping", 2.0),
        ("clearance", 7.0),
    ],
];

fn outputs() -> Vec<u32> {
    let rows = table().rows();
    let continuous = rows.filter(|row| matches!(row.access, Access::Continuous { .. }));
    continuous.map(|row| row.reference).collect()
}

/// Derivatives by central differences of what is set, from a state that is kept.
fn differences(unit: &Unit, of: &[u32], name: &str) -> Vec<f64> {
    let (kept, value, width) = (unit.keep(), unit.get(name), 1e-5);
    let [high, low] = [width, -width].map(|by| {
        unit.check(unit.set(name, value + by));
        let values = unit.reals(of);
        unit.go_back(kept);
        values
    });
    unit.free(kept);
    let pairs = high.iter().zip(low);
    pairs
        .map(|(high, low)| (high - low) / (2.0 * width))
        .collect()
}

/// Directional derivatives are those of differences, and adjoint ones the transposed of directional ones.
fn check<'a>(unit: &Unit, names: impl IntoIterator<Item = &'a &'a str>) {
    let of = outputs();
    let weights: Vec<_> = (0..of.len()).map(|k| 0.3 - 0.1 * k as f64).collect();
    for &name in names {
        let by = reference(name);
        let column = unit.directional(&of, &[by], &[1.0]);
        for ((of, exact), expected) in of.iter().zip(&column).zip(differences(unit, &of, name)) {
            let off = (exact - expected).abs();
            let phase = unit.get("phase");
            assert!(
                off <= 1e-6 * exact.abs().max(1.0),
                "{of} by {name} in phase {phase}: {exact} {expected}"
            );
        }
        let [sum] = *unit.adjoint(&of, &[by], &weights) else {
            panic!("one value");
        };
        let direct: f64 = column.iter().zip(&weights).map(|(of, by)| of * by).sum();
        let scale: f64 = column.iter().map(|of| of.abs()).sum();
        assert_close(sum, direct, 1e-13 * scale);
    }
}

#[test]
fn by_states_and_inputs_in_every_phase() {
    let mut phases = BTreeSet::new();
    for values in MACHINES.iter().chain(&FURTHER).chain([&&RESTING[..]]) {
        let mut importer = Integrator::begun(values);
        for number in 1..=60 {
            importer.run(0.22 * f64::from(number), 0.01);
            let unit = &importer.unit;
            phases.insert(unit.get("phase") as i32);
            check(unit, STATES.iter().chain(&INPUTS));
        }
    }
    // Chatter is over at once.
    assert_eq!(phases, (1..=8).collect(), "{phases:?}");
}

#[test]
fn beyond_the_end_of_a_law_where_an_integrator_tries_a_step() {
    for values in MACHINES.iter().chain(&FURTHER) {
        let mut importer = Integrator::begun(values);
        for number in 1..=40 {
            importer.run(0.31 * f64::from(number), 0.01);
            let states = importer.states();
            importer.put(importer.time + 0.05, [states[0] + 0.3, states[1] - 2.0]);
            let unit = &importer.unit;
            check(unit, STATES.iter().chain(&INPUTS));
            importer.put(importer.time, states);
        }
    }
}

#[test]
fn by_parameters_and_inputs_in_event_mode() {
    for values in MACHINES {
        let mut importer = Integrator::begun(values);
        for number in 1..=30 {
            importer.run(0.46 * f64::from(number), 0.01);
            importer.unit.enter_event_mode();
            let unit = &importer.unit;
            unit.update();
            check(unit, TUNABLE.iter().chain(&INPUTS));
            importer.leave_event_mode();
        }
    }
}

#[test]
fn states_can_be_set_and_are_knowns_where_the_importer_integrates() {
    let mut importer = Integrator::begun(&[]);
    importer.run(1.0, 0.01);
    let states = importer.states();
    importer.put(1.0, [7.0, 3.0]);
    let put = importer.unit.everything();
    importer.put(1.0, states);
    assert_eq!(importer.unit.set("position", 7.0), OK);
    assert_eq!(importer.unit.set("velocity", 3.0), OK);
    assert_eq!(importer.unit.everything(), put);
    assert_eq!(importer.states(), [7.0, 3.0]);
    importer.unit.enter_event_mode();
    // The unit sets them itself there.
    assert_eq!(importer.unit.set("position", 7.0), ERROR);
}
