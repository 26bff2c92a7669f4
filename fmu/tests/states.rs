//! States kept, written to bytes and taken up again, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::{c_char, c_void};
use std::ptr;

use crate::common::{ERROR, OK, OUTPUTS, Unit};
use softstop_fmi2::*;

fn outputs(unit: &Unit) -> [u64; 9] {
    OUTPUTS.map(|name| unit.get(name).to_bits())
}

/// The same steps, inputs and tuned parameters on both units give the same bits.
fn assert_same_future(one: &Unit, other: &Unit, mut time: f64) {
    for number in 0..40 {
        for unit in [one, other] {
            if number == 7 {
                assert_eq!(unit.set("force", 0.3), OK);
            }
            if number == 11 {
                assert_eq!(unit.set("clearance", 9.5), OK);
            }
            assert_eq!(unit.step(time, 0.731), OK, "{:?}", unit.take_log());
        }
        time += 0.731;
        assert_eq!(outputs(one), outputs(other), "step {number}");
        assert_eq!(
            one.get_integer("impact.count"),
            other.get_integer("impact.count")
        );
        assert_eq!(
            one.derivatives(&OUTPUTS, &[("force", 1.0)]),
            other.derivatives(&OUTPUTS, &[("force", 1.0)])
        );
    }
}

#[test]
fn bytes_lead_on_bit_for_bit_in_every_stop_model() {
    for model in 1..=6 {
        let (one, other) = (Unit::new(), Unit::new());
        assert_eq!(one.set_integer("stop.model", model), OK);
        assert_eq!(one.set("damping", 0.03), OK);
        one.begin();
        let mut time = 0.0;
        for _ in 0..17 {
            assert_eq!(one.step(time, 0.9), OK);
            time += 0.9;
        }
        assert_eq!(one.set("excitation.frequency", 1.1), OK);
        assert_eq!(one.set_boolean("material", 0), OK);
        assert_eq!(other.take_up(&one.serialized()), OK);
        assert_eq!(other.get("damping"), 0.03);
        assert_eq!(one.serialized(), other.serialized());
        assert_same_future(&one, &other, time);
    }
}

#[test]
fn bytes_keep_what_was_set_and_not_yet_used() {
    let (one, other) = (Unit::new(), Unit::new());
    assert_eq!(one.set("initial.velocity", 4.0), OK);
    assert_eq!(other.take_up(&one.serialized()), OK);
    one.begin();
    other.begin();
    assert_eq!(one.set("force", 0.25), OK);
    assert_eq!(other.take_up(&one.serialized()), OK);
    assert_eq!(other.get("force"), 0.25);
    assert_same_future(&one, &other, 0.0);
}

/// Not one byte can be altered, and none be missing.
#[test]
fn damaged_bytes_are_refused() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 12.0), OK);
    let bytes = unit.serialized();
    let before = outputs(&unit);
    for place in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[place] ^= 0x10;
        unit.refused(
            unit.take_up(&altered),
            &["fmi2DeSerializeFMUstate", "state"],
        );
        unit.refused(unit.take_up(&bytes[..place]), &["serialized FMU state"]);
    }
    let mut longer = bytes.clone();
    longer.push(1);
    unit.refused(unit.take_up(&longer), &["goes on after its end"]);
    longer[bytes.len()] = 0;
    assert_eq!(unit.take_up(&longer), OK);
    unit.refused(unit.take_up(&[b'x'; 4096]), &["not written by softstop"]);
    assert_eq!(outputs(&unit), before);
    assert_eq!(unit.step(12.0, 1.0), OK);
}

/// What another FMU has kept begins with another GUID.
#[test]
fn states_of_another_fmu_are_refused() {
    const GUID: usize = 8;
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 1.0), OK);
    let mut foreign = unit.keep();
    let alter = |state: *mut c_void| unsafe { *state.cast::<u8>().add(GUID) ^= 1 };
    alter(foreign);
    let position = unit.get("position");
    for status in unsafe {
        [
            fmi2SetFMUstate(unit.component, foreign),
            fmi2GetFMUstate(unit.component, &raw mut foreign),
            fmi2FreeFMUstate(unit.component, &raw mut foreign),
        ]
    } {
        assert_eq!(status, ERROR);
    }
    let said = unit.take_log();
    for function in ["fmi2SetFMUstate", "fmi2GetFMUstate", "fmi2FreeFMUstate"] {
        let words = format!("{function}: the FMU state is of another FMU, or is none");
        assert!(said.iter().any(|it| it.contains(&words)), "{said:?}");
    }
    alter(foreign);
    assert_eq!(unit.step(1.0, 1.0), OK);
    assert_eq!(unsafe { fmi2SetFMUstate(unit.component, foreign) }, OK);
    assert_eq!(unit.get("position"), position);
    unit.free(foreign);
}

#[test]
fn too_little_room_is_refused() {
    let unit = Unit::new();
    unit.begin();
    let state = unit.keep();
    let mut bytes = [0 as c_char; 100];
    let mut size = 0;
    let status = unsafe { fmi2SerializeFMUstate(unit.component, state, bytes.as_mut_ptr(), 100) };
    unit.refused(status, &["size = 100", "bytes"]);
    assert_eq!(bytes, [0; 100]);
    unsafe {
        unit.refused(
            fmi2SerializedFMUstateSize(unit.component, ptr::null_mut(), &raw mut size),
            &["FMUstate is NULL"],
        );
        unit.refused(
            fmi2SerializedFMUstateSize(unit.component, state, ptr::null_mut()),
            &["size is NULL"],
        );
    }
    unit.free(state);
}
