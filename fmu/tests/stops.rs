//! The stops through the C functions: what is refused, and what is left then.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use crate::common::{OK, Unit};
use softstop_fmi2::*;

const PIECEWISE_LINEAR: f64 = 3.0;
const HERTZ: f64 = 4.0;
const RIGID: f64 = 6.0;

/// A unit without a strip, so that the stop stands at the clearance.
fn unit(model: f64) -> Unit {
    let unit = Unit::new();
    assert_eq!(unit.set("stop.model", model), OK);
    assert_eq!(unit.set("piercing.thickness", 0.0), OK);
    assert_eq!(unit.set("piercing.travel", 0.0), OK);
    unit
}

#[test]
fn slopes_that_make_no_chain() {
    let unit = unit(PIECEWISE_LINEAR);
    assert_eq!(unit.set("stop.loading.count", 2.0), OK);
    let words = ["stop.loading.from[2] = 0", "stop.loading.count"];
    unit.refused(unit.try_to_begin(), &words);
    assert_eq!(unit.set("stop.loading.from[2]", 0.5), OK);
    assert_eq!(unit.set("stop.loading.stiffness[2]", 9.0), OK);
    assert_eq!(unit.set("stop.unloading.count", 1.0), OK);
    assert_eq!(unit.set("stop.unloading.stiffness[1]", 8.0), OK);
    let exit = || unsafe { fmi2ExitInitializationMode(unit.component) };
    unit.refused(
        exit(),
        &["stop.unloading", "must not exceed", "stop.loading"],
    );
    assert_eq!(unit.set("stop.unloading.stiffness[1]", 6.0), OK);
    assert_eq!(exit(), OK);
    assert_eq!(unit.step(0.0, 10.0), OK);
}

#[test]
fn a_start_beyond_the_rigid_stop() {
    let unit = unit(RIGID);
    assert_eq!(unit.set("initial.position", 10.5), OK);
    let words = [
        "fmi2ExitInitializationMode",
        "position = 10.5",
        "10 m",
        "rigid",
    ];
    unit.refused(unit.try_to_begin(), &words);
    unsafe { assert_eq!(fmi2Reset(unit.component), OK) };
    unit.begin();
    assert_eq!(unit.step(0.0, 10.0), OK);
}

#[test]
fn a_rigid_stop_tuned_to_before_the_mass() {
    let unit = unit(RIGID);
    unit.begin();
    assert_eq!(unit.step(0.0, 0.1), OK);
    let position = unit.get("position");
    let words = ["fmi2SetReal", "position = ", "<= 1 m", "rigid"];
    unit.refused(unit.set("clearance", 1.0), &words);
    assert_eq!(unit.get("clearance"), 10.0);
    assert_eq!(unit.get("position"), position);
    assert_eq!(unit.set("clearance", position), OK);
    assert_eq!(unit.step(0.1, 10.0), OK);
    assert!(unit.get("position") <= position);
    assert!(unit.get("impact.count") > 0.0);
}

#[test]
fn time_scales_that_doubles_do_not_resolve() {
    let unit = unit(HERTZ);
    for (name, value) in [("excitation.frequency", 0.01), ("contact.damping", 2e7)] {
        assert_eq!(unit.set(name, value), OK, "{name}");
    }
    let words = [
        "contact.damping = 20000000",
        "at most 10000000",
        "time scales",
    ];
    unit.refused(unit.try_to_begin(), &words);
    assert_eq!(unit.set("contact.damping", 9e6), OK);
    assert_eq!(unsafe { fmi2ExitInitializationMode(unit.component) }, OK);
}

#[test]
fn a_mass_between_two_stops() {
    let unit = unit(RIGID);
    assert_eq!(unit.set("stop.below.model", HERTZ), OK);
    unit.set_all(&[
        ("clearance", 0.5),
        ("stop.below.clearance", 0.25),
        ("stop.below.stiffness", 300.0),
        ("stop.below.dissipation", 0.1),
        ("initial.position", 0.125),
        ("initial.velocity", 1.0),
    ]);
    unit.begin();
    let mut scene = softstop::Ratios::unloaded().scene().expect("a machine");
    scene.stop = softstop::Stop::Rigid { restitution: 0.6 };
    scene.clearance = 0.5;
    let below = softstop::Below {
        clearance: 0.25,
        stop: softstop::Stop::Hertz {
            stiffness: 300.0,
            exponent: 1.5,
            dissipation: 0.1,
        },
    };
    scene.below = Some(below.into());
    let start = softstop::Start::new(0.125, 1.0);
    let mut machine = softstop::Simulation::new(&scene, start).expect("a start");
    let mut pressed_up = false;
    for step in 0..400 {
        let time = 0.125 * f64::from(step);
        assert_eq!(unit.step(time, 0.125), OK);
        machine.advance(time + 0.125).expect("a motion");
        let sample = machine.sample();
        assert_eq!(unit.get("position"), sample.position);
        assert_eq!(unit.get("contact.force"), sample.contact_force);
        let contacts = machine.contacts().expect("told again");
        assert_eq!(unit.get("contact.peak"), contacts.peak);
        assert_eq!(unit.get("impact.count"), machine.impact_count() as f64);
        let below = machine.impact_count_below() as f64;
        assert_eq!(unit.get("impact.below.count"), below);
        pressed_up |= sample.contact_force < 0.0 && contacts.peak > 0.0;
    }
    let [all, below] = ["impact.count", "impact.below.count"].map(|name| unit.get(name));
    assert!(
        pressed_up && below >= 10.0 && all >= below + 10.0,
        "{all} {below}"
    );
}

/// Two clearances set one by one are checked together, by the call that needs them: the order does not count, and what
/// does not go together leaves the machine as it was.
#[test]
fn two_clearances_in_any_order() {
    let names = ["clearance", "stop.below.clearance"];
    let values = [-1.5, 3.0];
    let begun = || {
        let unit = unit(RIGID);
        unit.set_all(&[("stop.model", 2.0), ("stop.below.model", 2.0)]);
        unit.set_all(&names.map(|name| (name, 1.0)));
        unit.set_all(&[("initial.position", 0.0), ("initial.velocity", 3.0)]);
        unit.begin();
        assert_eq!(unit.step(0.0, 0.1), OK);
        unit
    };
    let ends = [[0, 1], [1, 0]].map(|order| {
        let unit = begun();
        for index in order {
            assert_eq!(unit.set(names[index], values[index]), OK);
        }
        assert_eq!(unit.step(0.1, 0.5), OK);
        assert_eq!(names.map(|name| unit.get(name)), values);
        unit.get("position")
    });
    assert_eq!(ends[0], ends[1]);
    let (unit, untouched) = (begun(), begun());
    let words = [
        "fmi2DoStep",
        "clearance = -1.5",
        "stop.below.clearance = 1",
        "must be > 0",
    ];
    assert_eq!(unit.set("clearance", values[0]), OK);
    unit.refused(unit.step(0.1, 0.5), &words);
    assert_eq!(unit.get("clearance"), 1.0);
    for unit in [&unit, &untouched] {
        assert_eq!(unit.step(0.1, 0.5), OK);
    }
    assert_eq!(unit.get("position"), untouched.get("position"));
    // To end needs neither.
    assert_eq!(unit.set("clearance", values[0]), OK);
    assert_eq!(unsafe { fmi2Terminate(unit.component) }, OK);
    assert_eq!(unit.get("clearance"), 1.0);
    assert_eq!(unit.get("position"), untouched.get("position"));
}
