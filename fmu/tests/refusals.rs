//! A call that is refused leaves one line that says what is wrong.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ptr;

use crate::common::{OK, Unit, reference};
use softstop_fmi2::*;

#[test]
fn calls_in_the_wrong_state() {
    let unit = Unit::new();
    let component = unit.component;
    let before = "before initialisation";
    unsafe {
        unit.refused(unit.step(0.0, 1.0), &["fmi2DoStep", before]);
        unit.refused(
            fmi2EnterInitializationMode(component),
            &["fmi2SetupExperiment"],
        );
        unit.refused(fmi2ExitInitializationMode(component), &[before]);
        unit.refused(fmi2Terminate(component), &[before]);
        for (tolerance, start, word) in [
            (f64::NAN, 0.0, "tolerance = NaN"),
            (-1.0, 0.0, "tolerance = -1"),
            (1e-6, f64::INFINITY, "startTime = inf"),
            (1e-6, 2.0, "stopTime = 1"),
        ] {
            let status = fmi2SetupExperiment(component, 1, tolerance, start, 1, 1.0);
            unit.refused(status, &[word]);
        }
        unit.begin();
        let setup = fmi2SetupExperiment(component, 0, 0.0, 0.0, 0, 0.0);
        unit.refused(setup, &["after initialisation"]);
        unit.refused(fmi2CancelStep(component), &["no step is under way"]);
        unit.refused(unit.set("mass", 2.0), &["mass is a fixed parameter"]);
        assert_eq!(fmi2Terminate(component), OK);
        unit.refused(fmi2Terminate(component), &["after fmi2Terminate"]);
        unit.refused(unit.set("force", 1.0), &["after fmi2Terminate"]);
    }
    assert!(unit.get("position").is_finite());
}

#[test]
fn values_out_of_range() {
    let unit = Unit::new();
    for (name, value, word) in [
        ("clearance", f64::NAN, "must be"),
        ("stop.restitution", 1.2, "1.0"),
        ("stop.exponent", 0.5, "must be"),
        ("stop.exponent", 21.0, "20"),
        ("stop.dissipation", -1.0, "must be"),
        ("rigid.travel", -1.0, "must be"),
        ("stop.loading.count", 0.0, "1 and 8"),
        ("stop.unloading.count", 9.0, "0 and 8"),
        ("stop.release", 3.0, "zeroForce"),
        ("stop.model", 7.0, "rigid"),
    ] {
        unit.refused(unit.set(name, value), &[&format!("{name} = {value}"), word]);
    }
    unit.begin();
    for name in ["stop.restitution", "rigid.present"] {
        unit.refused(unit.set(name, 0.0), &[name, "fixed"]);
    }
}

#[test]
fn derivatives() {
    let unit = Unit::new();
    let derivative = |unknown: &str, known: &str, seed: f64, words: &[&str]| {
        let status = unit.derivatives(&[unknown], &[(known, seed)]);
        unit.refused(status.expect_err("refused"), words);
    };
    derivative("position", "force", 1.0, &["before initialisation"]);
    unit.begin();
    assert_eq!(unit.step(0.0, 4.0), OK);
    assert_eq!(unit.step(4.0, 1.0), OK);
    let first = ["initial.position", "first step"];
    derivative("position", "initial.position", 1.0, &first);
    derivative("phase", "force", 1.0, &["phase", "Enumeration"]);
    derivative("mass", "force", 1.0, &["mass", "no real output"]);
    derivative("position", "material", 1.0, &["material", "Boolean"]);
    derivative("position", "velocity", 1.0, &["velocity"]);
    derivative("position", "mass", 1.0, &["mass", "force"]);
    derivative("position", "force", f64::NAN, &["dvKnown = NaN"]);
    assert_eq!(unit.derivatives(&[], &[]), Ok(vec![]));
    assert_eq!(unit.derivatives(&["position"], &[]), Ok(vec![0.0]));
    unit.refused(unit.slope("force", 8, 1.0), &["force", "order 8", "1 to 7"]);
    unit.refused(unit.slope("force", 0, 1.0), &["force", "order 0"]);
    unit.refused(
        unit.slope("force", 1, f64::NAN),
        &["force = NaN", "order 1"],
    );
    unit.refused(unit.slope("clearance", 1, 1.0), &["clearance"]);
}

/// NULL where something is asked for, and too little room.
#[test]
fn pointers_and_sizes() {
    let unit = Unit::new();
    let (component, mass, state) = (unit.component, &reference("mass"), unit.keep());
    let (mut value, mut size, mut bytes) = (0.0, 0, [0; 100]);
    let (value, size, none, no_real) =
        (&raw mut value, &raw mut size, ptr::null(), ptr::null_mut());
    unsafe {
        unit.refused(fmi2GetReal(component, none, 1, value), &["vr is NULL"]);
        unit.refused(fmi2GetReal(component, mass, 1, no_real), &["value is NULL"]);
        unit.refused(
            fmi2SetReal(component, mass, usize::MAX, value),
            &["vr", "elements"],
        );
        unit.refused(
            fmi2SetString(component, mass, 1, &ptr::null()),
            &["value is NULL"],
        );
        unit.refused(
            fmi2SetDebugLogging(component, 1, 2, ptr::null()),
            &["categories"],
        );
        unit.refused(fmi2GetRealStatus(component, 2, no_real), &["value is NULL"]);
        unit.refused(fmi2GetRealStatus(component, 77, value), &["kind 77"]);
        unit.refused(
            fmi2GetFMUstate(component, ptr::null_mut()),
            &["FMUstate is NULL"],
        );
        unit.refused(
            fmi2SetFMUstate(component, ptr::null_mut()),
            &["FMUstate is NULL"],
        );
        let measured = fmi2SerializedFMUstateSize(component, ptr::null_mut(), size);
        unit.refused(measured, &["FMUstate is NULL"]);
        let measured = fmi2SerializedFMUstateSize(component, state, ptr::null_mut());
        unit.refused(measured, &["size is NULL"]);
        let written = fmi2SerializeFMUstate(component, state, bytes.as_mut_ptr(), 100);
        unit.refused(written, &["size = 100", "bytes"]);
        let derived = fmi2GetDirectionalDerivative(component, none, 1, none, 0, no_real, no_real);
        unit.refused(derived, &["vUnknown_ref is NULL"]);
    }
    unit.refused(
        unit.listen("logStatusPending"),
        &["logStatusPending", "logStatusError"],
    );
    unit.free(state);
}
