//! Steps that cannot be carried out as a whole.
#![allow(unsafe_code, reason = "calls a C function as an importer does")]

use std::ffi::c_int;

use crate::common::{DISCARD, ERROR, OK, Unit};
use softstop_fmi2::fmi2SetFMUstate;

fn assert_discarded(unit: &Unit, status: c_int) {
    let lines = unit.take_log();
    assert_eq!(status, DISCARD, "{lines:?}");
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert!(lines[0].starts_with("2 errors fmi2DoStep"), "{lines:?}");
    assert_eq!(unit.step_status(), DISCARD);
}

/// Elastic bounces on a rigid stop under a fast drive: more impacts than a step may cost.
pub const BUSY: [(&str, f64); 10] = [
    ("stop.model", 6.0),
    ("piercing.thickness", 0.0),
    ("piercing.travel", 0.0),
    ("clearance", 0.0),
    ("stop.restitution", 1.0),
    ("damping", 0.0),
    ("contact.damping", 0.0),
    ("stiffness", 1e8),
    ("initial.position", -1.0),
    ("initial.velocity", 0.0),
];

#[test]
fn a_step_of_too_many_impacts_is_carried_out_in_part() {
    let [unit, direct] = [Unit::new(), Unit::new()];
    for unit in [&unit, &direct] {
        unit.set_all(&BUSY);
        unit.begin();
    }
    assert_discarded(&unit, unit.step(0.0, 1e9));
    let reached = unit.last_successful_time();
    assert!(reached > 1e2 && reached < 1e9, "{reached}");
    let impacts = unit.get("impact.count");
    assert!(impacts > 0.9 * reached * 1e4 / std::f64::consts::PI);
    assert!(unit.get("impact.time") <= reached);
    let kept = unit.keep();

    // It goes on from there ...
    assert_eq!(unit.step(reached, 1e-3), OK);
    assert_eq!(unit.step_status(), OK);
    assert_eq!(unit.last_successful_time(), reached + 1e-3);
    // ... but, that done, not from the old start.
    let status = unit.step(0.0, 1.0);
    unit.refused(status, &["currentCommunicationPoint"]);

    // Or a shorter step from the old start, as if nothing had been.
    assert_eq!(unsafe { fmi2SetFMUstate(unit.component, kept) }, OK);
    unit.free(kept);
    assert_eq!(unit.step_status(), DISCARD);
    // An importer sets its inputs again before it repeats a step.
    for unit in [&unit, &direct] {
        assert_eq!(unit.set("force", 1e4), OK);
        assert_eq!(unit.step(0.0, 1.0), OK, "{:?}", unit.take_log());
    }
    for name in ["position", "energy.supplied", "impact.time"] {
        assert_eq!(unit.get(name).to_bits(), direct.get(name).to_bits());
    }
}

#[test]
fn a_step_beyond_the_resolution_of_time_is_refused() {
    let unit = Unit::new();
    unit.set_all(&[
        ("stop.model", 1.0),
        ("piercing.thickness", 0.0),
        ("piercing.travel", 0.0),
        ("stiffness", 0.0),
        ("damping", 0.0),
        ("contact.damping", 0.0),
        ("mass", 1e-12),
        ("initial.position", 0.0),
        ("initial.velocity", -1e12),
    ]);
    unit.begin();
    assert_eq!(unit.set("force", -1e12), OK);
    assert_eq!(unit.step(0.0, 1.0), OK);
    let before = (unit.get("position"), unit.get("velocity"));
    let status = unit.step(1.0, 1e200);
    unit.refused(status, &["time = 1e200"]);
    assert_eq!((unit.get("position"), unit.get("velocity")), before);
    assert_eq!(unit.last_successful_time(), 1.0);
    assert_eq!(unit.step(1.0, 1.0), OK, "{:?}", unit.take_log());
}

/// Inputs that grow beyond all numbers in the step, or at once: it is discarded or refused, and goes well with others.
#[test]
fn a_step_whose_inputs_overflow_can_be_repeated_with_others() {
    for (input, takes, order, slope, status) in [
        ("force", "", 3, 1e300, DISCARD),
        ("base.acceleration", "", 3, 1e300, DISCARD),
        ("drive.speed", "drive.takes.speed", 1, 1e300, ERROR),
        ("drive.speed", "drive.takes.speed", 3, 1e100, DISCARD),
        ("drive.amplitude", "drive.takes.amplitude", 6, 1e308, ERROR),
    ] {
        let units = [Unit::new(), Unit::new()];
        for unit in &units {
            if !takes.is_empty() {
                assert_eq!(unit.set(takes, 1.0), OK);
            }
            unit.begin();
            assert_eq!(unit.step(0.0, 0.5), OK);
        }
        let [unit, other] = units;
        let start = unit.get(input);
        assert_eq!(unit.slope(input, order, slope), OK);
        let found = unit.step(0.5, 4.0);
        let lines = unit.take_log();
        assert_eq!((found, lines.len()), (status, 1), "{input}: {lines:?}");
        assert!(found == DISCARD || lines[0].contains(input), "{lines:?}");
        let reached = unit.last_successful_time();
        assert!((0.5..4.5).contains(&reached), "{input}: {reached}");
        assert_eq!(unit.set(input, start), OK);
        assert_eq!(unit.step(0.5, 1.0), OK, "{:?}", unit.take_log());
        assert_eq!(other.step(0.5, 1.0), OK);
        for name in ["position", "drive.angle", "energy.supplied"] {
            let difference = unit.get(name) - other.get(name);
            assert!(difference.abs() < 1e-12, "{input}, {name}: {difference}");
        }
    }
}

/// What an importer may ask for: a step of any size is answered with what one step may cost.
#[test]
fn a_step_of_an_age_costs_no_more_than_a_step_may() {
    let unit = Unit::new();
    unit.begin();
    assert_discarded(&unit, unit.step(0.0, 1e12));
    let (reached, impacts) = (unit.last_successful_time(), unit.get("impact.count"));
    assert!(reached > 1e3 && reached < 1e12, "{reached}");
    // Half a million crossings at most; an impact comes with the way back.
    assert!(impacts > 1e3 && impacts <= f64::from(1 << 18), "{impacts}");
    assert_eq!(unit.step(reached, 1.0), OK, "{:?}", unit.take_log());
    assert_eq!(unit.last_successful_time(), reached + 1.0);
}
