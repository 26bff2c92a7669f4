//! Model exchange: an importer's integration beside the unit's own motion.

use softstop_fmi3::*;

use super::events::MACHINES;
use super::integrator::{Integrator, States};
use super::unit::Unit;
use crate::common::{DISCARD, OK};

const PERIOD: f64 = std::f64::consts::TAU / 1.15;

/// Times of the events of co-simulation up to a time, with the states after them.
fn events_of_co_simulation(values: &[(&str, f64)], end: f64) -> Vec<(f64, States)> {
    let unit = Unit::begun((false, true), values);
    let mut events = Vec::new();
    unit.run(end, end, |unit, ending| {
        events.push((
            ending.time,
            ["position", "velocity"].map(|name| unit.get(name)),
        ));
    });
    events
}

#[test]
fn events_are_those_of_co_simulation_to_the_bit() {
    for (machine, values) in MACHINES.iter().enumerate() {
        let expected = events_of_co_simulation(values, 10.0 * PERIOD);
        for size in [0.01, 0.05] {
            let mut importer = Integrator::begun(values);
            importer.run(10.0 * PERIOD, size);
            for (time, _, after) in &importer.events {
                let is_expected = expected.contains(&(*time, *after));
                assert!(
                    is_expected,
                    "machine {machine}: {time} {after:?}, {:?}",
                    expected.iter().find(|e| (e.0 - time).abs() < 1e-6)
                );
            }
            // Events within the importer's resolution of time are one to it.
            let together = expected.len() - importer.events.len();
            assert!(
                expected.len() > 10 && together * 10 < expected.len(),
                "machine {machine}: {together}"
            );
            let end = importer.unit.get("impact.time");
            let unit = Unit::begun((false, false), values);
            unit.step(0.0, 10.0 * PERIOD);
            assert_eq!(end, unit.get("impact.time"), "machine {machine}");
            assert_eq!(importer.unit.get("impact.count"), unit.get("impact.count"));
            let dissipated = importer.unit.get("energy.dissipated") - unit.get("energy.dissipated");
            assert!(dissipated.abs() < 1e-9, "machine {machine}: {dissipated}");
        }
    }
}

#[test]
fn states_before_an_event_are_those_of_the_integrator_and_agree_with_those_after_it() {
    let mut importer = Integrator::begun(MACHINES[1]);
    importer.run(10.0 * PERIOD, 0.01);
    for (_, before, after) in &importer.events {
        let missed = (before[0] - after[0])
            .abs()
            .max((before[1] - after[1]).abs());
        assert!(missed < 1e-6, "{missed}");
    }
}

/// A rigid stop that a mass comes to rest on.
pub const RESTING: [(&str, f64); 7] = [
    ("stop.model", 6.0),
    ("piercing.thickness", 0.0),
    ("piercing.travel", 0.0),
    ("stop.restitution", 0.5),
    ("clearance", -0.5),
    ("initial.position", -0.6),
    ("initial.velocity", 0.0),
];

#[test]
fn a_row_of_bounces_ends_in_rest_that_is_held_until_it_was_said_to_end() {
    let mut importer = Integrator::begun(&RESTING);
    let mut rests = 0;
    while rests < 5 {
        importer.run(importer.next.expect("an event"), 0.02);
        assert_ne!(
            importer.unit.get("phase"),
            9.0,
            "bounces that are over at once are not seen"
        );
        if importer.unit.get("phase") != 7.0 {
            continue;
        }
        rests += 1;
        assert_eq!(
            (importer.states(), importer.derivatives()),
            ([-0.5, 0.0], [0.0; 2])
        );
        let release = importer.next.expect("a release");
        while importer.time + 0.02 < release {
            assert!(!importer.step(0.02));
            assert_eq!(
                (importer.states(), importer.derivatives()),
                ([-0.5, 0.0], [0.0; 2])
            );
            assert!(
                importer
                    .indicators()
                    .iter()
                    .all(|indicator| *indicator > 0.0)
            );
        }
        importer.run(release, 0.02);
        assert_eq!(importer.unit.get("phase"), 1.0);
        importer.step(1e-3);
        assert!(importer.states()[0] < -0.5);
    }
}

#[test]
fn what_is_set_in_event_mode_is_predicted_as_in_co_simulation() {
    for (name, value) in [
        ("force", -0.4),
        ("clearance", 7.5),
        ("base.acceleration", 0.2),
        ("material", 0.0),
    ] {
        let (mut importer, unit) = (Integrator::begun(&[]), Unit::begun((true, false), &[]));
        importer.run(2.0, 0.01);
        importer.unit.enter_event_mode();
        unit.step(0.0, 2.0);
        unit.enter_event_mode();
        assert_eq!(
            (importer.unit.set(name, value), unit.set(name, value)),
            (OK, OK)
        );
        importer.leave_event_mode();
        let (next, [length, _]) = (unit.update(), importer.nominals());
        assert!(length >= importer.states()[0].abs() && length < 100.0);
        assert_eq!(importer.next, next, "{name}");
        let at = next.expect("an event");
        importer.run(at, 0.01);
        unit.leave_event_mode();
        unit.step(2.0, at - 2.0);
        unit.enter_event_mode();
        unit.update();
        let states = ["position", "velocity"].map(|name| unit.get(name));
        assert_eq!(importer.states(), states, "{name}");
    }
}

#[test]
fn what_is_set_after_the_update_holds_as_well() {
    let mut importer = Integrator::begun(&[]);
    importer.run(2.0, 0.01);
    importer.unit.enter_event_mode();
    importer.unit.update();
    assert_eq!(importer.unit.set("force", 0.5), OK);
    // SAFETY: the instance is alive.
    importer
        .unit
        .check(unsafe { fmi3EnterContinuousTimeMode(importer.unit.instance) });
    importer.run(2.5, 0.01);
    let states = importer.states();
    importer.unit.enter_event_mode();
    importer.leave_event_mode();
    let missed = (importer.states()[0] - states[0]).abs();
    assert!(missed > 0.0 && missed < 1e-8, "{missed}");
}

#[test]
fn an_input_that_changes_between_events_is_predicted_anew() {
    let mut importer = Integrator::begun(&[]);
    importer.run(2.0, 0.01);
    let told = importer.next.expect("an event");
    // Later than it was told, if at all: nothing is asked for.
    assert_eq!(importer.unit.set("force", -2.0), OK);
    assert!(!importer.step(0.01));
    importer.unit.enter_event_mode();
    importer.leave_event_mode();
    assert!(importer.next.is_none_or(|next| next > told));
    // Sooner, and soon.
    importer.run(4.0, 0.01);
    assert_eq!(importer.unit.set("force", 40.0), OK);
    let asked = (0..100)
        .find(|_| importer.step(0.01))
        .expect("an event is asked for");
    importer.unit.enter_event_mode();
    importer.leave_event_mode();
    let next = importer.next.expect("an event");
    assert!(next - importer.time < 0.11, "{asked} {next}");
    let states = importer.states();
    importer.run(next, 0.001);
    // Under an input that has changed the unit goes on from the integrator's states.
    assert!(
        importer
            .events
            .last()
            .is_some_and(|(at, before, _)| *at == next && *before != states)
    );
    assert!((importer.states()[0] - 10.0).abs() < 1e-6);
}

#[test]
fn discrete_inputs_and_parameters_wait_for_event_mode() {
    let mut importer = Integrator::begun(&[]);
    importer.run(1.0, 0.01);
    let before = importer.unit.everything();
    for (name, value) in [("clearance", 9.5), ("material", 0.0)] {
        let held = importer.unit.get(name);
        assert_eq!(importer.unit.set(name, held), OK, "{name}");
        assert_eq!(importer.unit.set(name, value), DISCARD, "{name}");
        assert_eq!(importer.unit.everything(), before, "{name}");
    }
    importer.unit.enter_event_mode();
    assert_eq!(importer.unit.set("clearance", 9.5), OK);
    importer.leave_event_mode();
    assert_eq!(importer.unit.get("clearance"), 9.5);
}

#[test]
fn the_unit_goes_on_from_states_that_are_not_its_own() {
    let mut importer = Integrator::begun(&[]);
    importer.run(1.0, 0.01);
    let states = importer.states();
    for (miss, is_taken) in [(0.01, false), (3.0, true)] {
        importer.put(1.0, [states[0], states[1] - miss]);
        importer.unit.enter_event_mode();
        let has_new_states = importer.leave_event_mode();
        assert_eq!(has_new_states, !is_taken);
        assert_eq!(importer.states()[1] == states[1] - miss, is_taken);
    }
}

#[test]
fn a_kept_state_leads_on_bit_for_bit() {
    let (mut one, mut other) = (Integrator::begun(&RESTING), Integrator::begun(&RESTING));
    one.run(0.6, 0.01);
    // Beyond the rigid stop, where an integrator may try a step.
    one.put(one.time, [-0.5 + 1e-4, one.states()[1]]);
    assert_eq!(one.unit.get("position"), -0.5 + 1e-4);
    other.unit.take_up(&one.unit);
    (other.time, other.next) = (one.time, one.next);
    assert_eq!(one.unit.everything(), other.unit.everything());
    for importer in [&mut one, &mut other] {
        importer.run(20.0, 0.01);
    }
    assert_eq!(one.unit.everything(), other.unit.everything());
}

#[test]
fn a_state_beyond_the_end_of_a_law_shows_under_inputs_that_vary() {
    let mut importer = Integrator::begun(&[]);
    importer.run(1.0, 0.01);
    importer.put(1.0, [10.5, 9.0]);
    let (position, indicators) = (importer.unit.get("position"), importer.indicators());
    assert!(position == 10.5 && indicators.iter().any(|indicator| *indicator < 0.0));
    for name in ["force", "base.acceleration"] {
        assert_eq!(importer.unit.set(name, 0.3), OK);
        assert_eq!(importer.unit.get("position"), position, "{name}");
        assert_eq!(importer.indicators(), indicators, "{name}");
    }
}
