//! States kept, written to bytes and taken up again, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use crate::common::{ERROR, OK, OUTPUTS, Unit, call, switch_guid};
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
        assert_eq!(one.get("impact.count"), other.get("impact.count"));
        assert_eq!(
            one.derivatives(&OUTPUTS, &[("force", 1.0)]),
            other.derivatives(&OUTPUTS, &[("force", 1.0)])
        );
    }
}

#[test]
fn bytes_lead_on_bit_for_bit_in_every_stop_model() {
    for model in [1.0, 2.0, 3.0, 4.0, 5.0, 6.0] {
        let (one, other) = (Unit::new(), Unit::new());
        assert_eq!(one.set("stop.model", model), OK);
        assert_eq!(one.set("damping", 0.03), OK);
        one.begin();
        let mut time = 0.0;
        for _ in 0..17 {
            assert_eq!(one.step(time, 0.9), OK);
            time += 0.9;
        }
        assert_eq!(one.set("excitation.frequency", 1.1), OK);
        assert_eq!(one.set("material", 0.0), OK);
        assert_eq!(other.take_up(&one.serialized()), OK);
        assert_eq!(other.get("damping"), 0.03);
        assert_eq!(one.serialized(), other.serialized());
        assert_same_future(&one, &other, time);
    }
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

#[test]
fn bytes_without_room_are_left_as_they_are() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 12.0), OK);
    let (state, needed) = (unit.keep(), unit.serialized().len());
    for size in [0, 1, needed / 2, needed - 1] {
        let mut bytes = vec![b'x'; needed + 8];
        let place = bytes.as_mut_ptr().cast();
        let status = unsafe { fmi2SerializeFMUstate(unit.component, state, place, size) };
        let words = format!("size = {size}: the serialized FMU state needs {needed} bytes");
        unit.refused(status, &["fmi2SerializeFMUstate", &words]);
        assert!(bytes.iter().all(|byte| *byte == b'x'), "{size}");
    }
    unit.free(state);
}

/// What another FMU has kept begins with another GUID, and so do its bytes.
#[test]
fn states_of_another_fmu_are_refused() {
    let unit = Unit::new();
    unit.begin();
    assert_eq!(unit.step(0.0, 1.0), OK);
    let (position, mut bytes, mut foreign) = (unit.get("position"), unit.serialized(), unit.keep());
    bytes[12] ^= 1;
    unit.refused(
        unit.take_up(&bytes),
        &["fmi2DeSerializeFMUstate", "another GUID"],
    );
    switch_guid(foreign);
    let (component, state, mut size) = (unit.component, foreign, 0);
    let calls = unsafe {
        [
            call!(fmi2GetFMUstate(component, &raw mut foreign)),
            call!(fmi2SetFMUstate(component, state)),
            call!(fmi2SerializedFMUstateSize(component, state, &raw mut size)),
            call!(fmi2SerializeFMUstate(
                component,
                state,
                bytes.as_mut_ptr().cast(),
                bytes.len()
            )),
            call!(fmi2FreeFMUstate(component, &raw mut foreign)),
        ]
    };
    let lines = unit.take_log();
    assert_eq!(lines.len(), calls.len(), "{lines:?}");
    for ((function, status), line) in calls.iter().zip(lines) {
        let words = format!("{function}: the FMU state is of another FMU, or is none");
        assert!(*status == ERROR && line.contains(&words), "{line}");
    }
    assert_eq!((foreign, size), (state, 0));
    switch_guid(state);
    assert_eq!(unit.step(1.0, 1.0), OK);
    assert_eq!(unsafe { fmi2SetFMUstate(component, state) }, OK);
    assert_eq!(unit.get("position"), position);
    unit.free(state);
}
