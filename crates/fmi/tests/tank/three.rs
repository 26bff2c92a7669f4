//! The tank through the C functions of FMI 3.0.

use std::ffi::{CString, c_int, c_void};
use std::ptr;

use softstop_fmi::{Imprint, Standard, description, guid_of, library_guid};

use super::fmi3::*;
use super::unit::Tank;
use super::{DISCARD, ERROR, INFLOW, LEVEL, OK};

/// Time, which is a variable in FMI 3.0.
const TIME: u32 = 256;

/// An instance without a log, or nothing if it is refused.
fn instantiate(event_mode: u8, early: u8) -> *mut c_void {
    let token = CString::new(library_guid::<Tank>()).expect("no NUL");
    let (token, nothing) = (token.as_ptr(), ptr::null());
    let (name, none) = (c"tank".as_ptr(), ptr::null_mut());
    unsafe {
        fmi3InstantiateCoSimulation(
            name,
            token,
            nothing,
            0,
            0,
            event_mode,
            early,
            ptr::null(),
            0,
            none,
            None,
            None,
        )
    }
}

fn begun(early: u8) -> *mut c_void {
    let tank = instantiate(0, early);
    assert!(!tank.is_null());
    unsafe {
        assert_eq!(fmi3EnterInitializationMode(tank, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi3ExitInitializationMode(tank), OK);
    }
    tank
}

fn set(tank: *mut c_void, reference: u32, value: f64) -> c_int {
    unsafe { fmi3SetFloat64(tank, &raw const reference, 1, &raw const value, 1) }
}

fn get(tank: *mut c_void, reference: u32) -> f64 {
    let mut value = f64::NAN;
    let status = unsafe { fmi3GetFloat64(tank, &raw const reference, 1, &raw mut value, 1) };
    assert_eq!(status, OK);
    value
}

/// Status, whether the step ended early, and where.
fn step(tank: *mut c_void, point: f64, size: f64) -> (c_int, u8, f64) {
    let (mut event, mut end, mut early, mut time) = (7, 7, 7, f64::NAN);
    let status = unsafe {
        let (event, end, early) = (&raw mut event, &raw mut end, &raw mut early);
        fmi3DoStep(tank, point, size, 1, event, end, early, &raw mut time)
    };
    (status, early, time)
}

#[test]
fn a_unit_without_events_has_no_event_mode() {
    assert!(instantiate(1, 1).is_null());
    let tank = begun(1);
    assert_eq!(step(tank, 0.0, 10.0), (OK, 0, 10.0));
    assert_eq!(get(tank, TIME), 10.0);
    assert_eq!(unsafe { fmi3EnterEventMode(tank) }, ERROR);
    unsafe { fmi3FreeInstance(tank) };
}

#[test]
fn a_step_that_does_not_come_to_its_end_ends_early_or_is_taken_back() {
    let [early, whole] = [begun(1), begun(0)];
    for tank in [early, whole] {
        assert_eq!(set(tank, INFLOW, 1.0), OK);
    }
    assert_eq!(step(early, 0.0, 250.0), (OK, 1, 100.0));
    assert_eq!(step(early, 100.0, 150.0), (OK, 1, 200.0));
    assert_eq!(step(early, 200.0, 50.0), (OK, 0, 250.0));
    assert_eq!(get(early, LEVEL), 251.5);
    assert_eq!(step(whole, 0.0, 250.0).0, DISCARD);
    assert_eq!((get(whole, LEVEL), get(whole, TIME)), (1.5, 0.0));
    assert_eq!(step(whole, 0.0, 10.0), (OK, 0, 10.0));
    assert_eq!(get(whole, LEVEL), 11.5);
    // What cannot be taken back ends the simulation.
    assert_eq!(step(whole, 10.0, 2e3).0, ERROR);
    assert_eq!(step(whole, 110.0, 1.0).0, ERROR);
    for tank in [early, whole] {
        unsafe { fmi3FreeInstance(tank) };
    }
}

#[test]
fn a_value_that_is_not_taken_is_discarded_and_an_error_ends_the_simulation() {
    let tank = begun(0);
    assert_eq!(set(tank, INFLOW, f64::NAN), DISCARD);
    assert_eq!(set(tank, super::GAIN, 7.0), DISCARD);
    assert_eq!(set(tank, super::GAIN, 0.5), OK);
    assert_eq!(set(tank, LEVEL, 7.0), ERROR);
    assert_eq!(set(tank, super::GAIN, 0.5), ERROR);
    assert_eq!(get(tank, LEVEL), 1.5);
    unsafe {
        assert_eq!(fmi3Reset(tank), OK);
        assert_eq!(set(tank, super::GAIN, 0.5), OK);
        fmi3FreeInstance(tank);
    }
}

#[test]
fn its_description() {
    let imprint = Imprint::<Tank>::library();
    let token = guid_of(&imprint);
    let xml = description::write(&imprint.with_standard(Standard::Fmi3), &token);
    for words in [
        "fmiVersion=\"3.0\"",
        "modelIdentifier=\"tank\"",
        "hasEventMode=\"false\"",
        "<Float64 name=\"time\" valueReference=\"256\"",
        "<Unit name=\"s\">",
        "<InitialUnknown valueReference=\"200\" dependencies=\"2\"",
        "start=\"1.5\"",
    ] {
        assert!(xml.contains(words), "{words}: {xml}");
    }
}
