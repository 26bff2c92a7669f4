//! The lifecycle and its misuse, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::{c_int, c_void};
use std::ptr;

use crate::common::{OK, Unit, reference};
use softstop_fmi2::*;

#[test]
fn a_life_without_faults() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 10.0), OK);
    assert!(unit.get("impact.velocity") > 8.0);
    unsafe {
        assert_eq!(fmi2Terminate(unit.component), OK);
        assert_eq!(unit.reset(), OK);
    }
    assert!(unit.take_log().is_empty());
}

#[test]
fn calls_in_the_wrong_state() {
    let unit = Unit::new();
    let component = unit.component;
    unsafe {
        unit.refused(
            unit.step(0.0, 1.0),
            &["fmi2DoStep", "before initialisation"],
        );
        unit.refused(
            fmi2EnterInitializationMode(component),
            &["fmi2SetupExperiment"],
        );
        unit.refused(
            fmi2ExitInitializationMode(component),
            &["before initialisation"],
        );
        unit.refused(fmi2Terminate(component), &["before initialisation"]);
        unit.begin();
        unit.refused(
            fmi2SetupExperiment(component, 0, 0.0, 0.0, 0, 0.0),
            &["after initialisation"],
        );
        unit.refused(fmi2CancelStep(component), &["no step is under way"]);
        unit.refused(unit.set("mass", 2.0), &["mass is a fixed parameter"]);
        assert_eq!(unit.step(0.0, 1.0), OK);
        assert_eq!(fmi2Terminate(component), OK);
        unit.refused(fmi2Terminate(component), &["after fmi2Terminate"]);
        unit.refused(unit.set("force", 1.0), &["after fmi2Terminate"]);
        assert!(unit.get("position").is_finite());
    }
}

#[test]
fn an_experiment_that_makes_no_sense() {
    let unit = Unit::new();
    for (tolerance, start, stop, word) in [
        (f64::NAN, 0.0, 1.0, "tolerance"),
        (-1.0, 0.0, 1.0, "tolerance"),
        (1e-6, f64::INFINITY, 1.0, "startTime"),
        (1e-6, 2.0, 1.0, "stopTime"),
    ] {
        let status = unsafe { fmi2SetupExperiment(unit.component, 1, tolerance, start, 1, stop) };
        unit.refused(status, &[word]);
    }
    unit.begin();
}

/// A tolerance is of no use to an exact solution: it is taken, with a warning for those who listen.
#[test]
fn a_tolerance_has_no_effect() {
    let unit = Unit::new();
    let setup = || unsafe { fmi2SetupExperiment(unit.component, 1, 1e-4, 0.0, 0, 0.0) };
    assert_eq!(setup(), OK);
    assert!(unit.take_log().is_empty());
    assert_eq!(unit.listen("warnings"), OK);
    assert_eq!(setup(), OK);
    let lines = unit.take_log();
    assert_eq!(lines.len(), 1);
    assert!(
        lines[0].starts_with("0 warnings tolerance = 1e-4"),
        "{lines:?}"
    );
}

/// The standard's names are taken as well; of lines a unit says which of its own categories they are.
#[test]
fn categories_have_the_names_of_the_standard() {
    for (name, lines) in [("logStatusWarning", 1), ("logAll", 2), ("logEvents", 1)] {
        let unit = Unit::new();
        unit.begin();
        assert_eq!(unit.listen(name), OK);
        assert_eq!(unit.step(0.0, 10.0), OK);
        assert_eq!(unit.step(10.0 + 1e-9, 1e-3), OK);
        assert_eq!(unit.take_log().len(), lines, "{name}");
    }
    let unit = Unit::new();
    unit.refused(
        unit.listen("logStatusPending"),
        &["logStatusPending", "logStatusError"],
    );
}

/// Importers that count in nanoseconds come close to the end of the last step, not onto it.
#[test]
fn a_gap_between_steps_is_told() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.listen("warnings"), OK);
    assert_eq!(unit.step(0.0, 1.0), OK);
    assert_eq!(unit.step(1.0 + 4.0 * f64::EPSILON, 1.0), OK);
    assert!(unit.take_log().is_empty());
    assert_eq!(unit.step(2.0 + 1e-10, 1.0), OK);
    let lines = unit.take_log();
    assert_eq!(lines.len(), 1);
    assert!(lines[0].contains("currentCommunicationPoint"), "{lines:?}");
}

#[test]
fn values_are_set_all_or_none() {
    let unit = Unit::new();
    let references = [reference("mass"), reference("clearance")];
    let values = [2.0, f64::NAN];
    let status = unsafe { fmi2SetReal(unit.component, references.as_ptr(), 2, values.as_ptr()) };
    unit.refused(status, &["clearance = NaN"]);
    assert_eq!(unit.get("mass"), 1.0);
}

#[test]
fn status_of_the_last_step() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 2.5), OK);
    let (mut status, mut time, mut ended): (c_int, f64, c_int) = (-1, -1.0, -1);
    let mut text = ptr::null();
    unsafe {
        assert_eq!(fmi2GetStatus(unit.component, 0, &raw mut status), OK);
        assert_eq!(fmi2GetRealStatus(unit.component, 2, &raw mut time), OK);
        assert_eq!(fmi2GetBooleanStatus(unit.component, 3, &raw mut ended), OK);
        assert_eq!((status, time, ended), (OK, 2.5, 0));
        unit.refused(
            fmi2GetIntegerStatus(unit.component, 0, &raw mut status),
            &["kind 0"],
        );
        unit.refused(
            fmi2GetStringStatus(unit.component, 1, &raw mut text),
            &["fmi2Pending"],
        );
        unit.refused(
            fmi2GetRealStatus(unit.component, 77, &raw mut time),
            &["kind 77"],
        );
    }
}

#[test]
fn snapshots_are_overwritten_in_place() {
    let unit = Unit::new();
    unit.begin();
    let mut state: *mut c_void = ptr::null_mut();
    unsafe {
        assert_eq!(fmi2GetFMUstate(unit.component, &raw mut state), OK);
        let first = state;
        assert_eq!(unit.step(0.0, 3.0), OK);
        assert_eq!(fmi2GetFMUstate(unit.component, &raw mut state), OK);
        assert_eq!(state, first);
        let position = unit.get("position");
        assert_eq!(unit.reset(), OK);
        assert_eq!(fmi2SetFMUstate(unit.component, state), OK);
        assert_eq!(unit.get("position"), position);
        assert_eq!(unit.step(3.0, 1.0), OK);
        assert_eq!(fmi2FreeFMUstate(unit.component, &raw mut state), OK);
        assert!(state.is_null());
    }
}

#[test]
fn ten_thousand_instances_from_several_threads() {
    let threads: Vec<_> = (0..4)
        .map(|_| {
            std::thread::spawn(|| {
                let units: Vec<_> = (0..2500).map(|_| Unit::new()).collect();
                units.iter().for_each(Unit::begin);
                assert!(units.iter().all(|unit| unit.step(0.0, 1.0) == OK));
                units[0].get("position")
            })
        })
        .collect();
    let ends: Vec<_> = threads
        .into_iter()
        .map(|t| t.join().expect("no panic"))
        .collect();
    assert!(ends.iter().all(|end| *end == ends[0]));
}
