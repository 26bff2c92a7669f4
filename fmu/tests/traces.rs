//! Reading and refused calls leave no trace, and a discarded step can be repeated in any way that the
//! standard allows.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::c_int;

use crate::common::{DISCARD, ERROR, OK, Unit};
use softstop_fmi2::*;

fn set_rate(unit: &Unit, rate: f64) -> c_int {
    unit.slope("force", 1, rate)
}

#[test]
fn a_force_that_changes_is_counted_from_the_start() {
    let unit = Unit::new();
    assert_eq!(set_rate(&unit, 0.1), OK);
    unit.enter(10.0);
    assert_eq!(unit.get("force"), 0.0);
    unit.get("position");
    assert_eq!(unit.get("force"), 0.0);
}

/// The mass starts beyond the clearance, where a strip would be.
#[test]
fn material_before_the_start_counts_whether_outputs_were_read_or_not() {
    let ends = [false, true].map(|read| {
        let unit = Unit::new();
        assert_eq!(unit.set("initial.position", 10.2), OK);
        unit.enter(0.0);
        if read {
            unit.get("contact.force");
        }
        assert_eq!(unit.set("material", 0.0), OK);
        assert_eq!(unsafe { fmi2ExitInitializationMode(unit.component) }, OK);
        assert_eq!(unit.step(0.0, 0.02), OK);
        unit.get("position")
    });
    assert_eq!(ends[0], ends[1]);
}

#[test]
fn what_was_set_before_the_end_shows_after_it() {
    let accelerations = [false, true].map(|read| {
        let unit = Unit::new();
        unit.begin();
        assert_eq!(unit.set("force", 0.5), OK);
        if read {
            unit.get("acceleration");
        }
        assert_eq!(unsafe { fmi2Terminate(unit.component) }, OK);
        unit.get("acceleration")
    });
    assert_eq!(accelerations[0], accelerations[1]);
}

/// A mass that is pressed on a Hertz stop for good: long steps cost much effort.
fn laborious() -> Unit {
    let unit = Unit::new();
    unit.set_all(&[
        ("stop.model", 4.0),
        ("piercing.thickness", 0.0),
        ("piercing.travel", 0.0),
        ("stop.stiffness", 100.0),
        ("clearance", 0.0),
        ("initial.position", 1.0),
        ("initial.velocity", 0.0),
        ("force", 20.0),
    ]);
    unsafe {
        assert_eq!(
            fmi2SetupExperiment(unit.component, 0, 0.0, 0.0, 1, 1e10),
            OK
        );
        assert_eq!(fmi2EnterInitializationMode(unit.component), OK);
        assert_eq!(fmi2ExitInitializationMode(unit.component), OK);
    }
    assert_eq!(unit.step(0.0, 5.0), OK);
    unit
}

fn outputs(unit: &Unit) -> [f64; 5] {
    [
        "position",
        "velocity",
        "energy.supplied",
        "impact.time",
        "force",
    ]
    .map(|name| unit.get(name))
}

/// A unit in the state of this one, which came over bytes.
fn copy(unit: &Unit) -> Unit {
    let copy = Unit::new();
    assert_eq!(copy.take_up(&unit.serialized()), OK);
    copy
}

/// One second from t = 5 s on after `change`, which is made before the step.
fn one_second(unit: &Unit, change: impl Fn(&Unit)) -> [f64; 5] {
    change(unit);
    assert_eq!(unit.step(5.0, 1.0), OK, "{:?}", unit.take_log());
    outputs(unit)
}

#[test]
fn a_discarded_step_is_repeated_or_carried_on() {
    let unit = laborious();
    assert_eq!(unit.step(5.0, 1e9), DISCARD);
    assert_eq!(unit.take_log().len(), 1);
    let reached = unit.last_successful_time();
    assert!(reached > 5.0 && reached < 1e9);

    let changes: [fn(&Unit); 4] = [
        |_| {},
        |unit| assert_eq!(unit.set("force", 19.0), OK),
        |unit| assert_eq!(set_rate(unit, 0.125), OK),
        |unit| {
            assert_eq!(unit.set("stop.stiffness", 90.0), OK);
            outputs(unit);
        },
    ];
    // The same second in units that have discarded nothing; the force of a rate begins at t = 5 s.
    for (number, change) in changes.into_iter().enumerate() {
        let expected = one_second(&laborious(), change);
        let repeated = one_second(&copy(&unit), change);
        assert_eq!(expected, repeated, "change {number}");
    }

    let onward = copy(&unit);
    assert_eq!(onward.step_status(), DISCARD);
    assert_eq!(onward.step(reached, 1.0), OK);
    assert_eq!(onward.last_successful_time(), reached + 1.0);
}

#[test]
fn a_refused_repetition_changes_nothing() {
    let unit = laborious();
    assert_eq!(unit.step(5.0, 1e9), DISCARD);
    unit.take_log();
    let (time, before) = (unit.last_successful_time(), outputs(&unit));
    for size in [1e11, 1e300, f64::NAN, -1.0] {
        assert_eq!(unit.step(5.0, size), ERROR, "{size}");
        assert_eq!(unit.take_log().len(), 1);
        assert_eq!(unit.last_successful_time(), time, "{size}");
        assert_eq!(outputs(&unit), before, "{size}");
    }
}
