//! Instances that are refused, and NULL where something is asked for, through the C functions.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::c_char;
use std::ptr;

use crate::common::{ERROR, OK, Unit, reference};
use softstop_fmi2::*;
use softstop_fmu::library_guid;

#[test]
fn refused_instances() {
    let guid = library_guid();
    let guid = guid.as_deref();
    for (name, kind, given, word) in [
        (None, 1, guid, "instanceName"),
        (Some(""), 1, guid, "instanceName"),
        (Some("unit"), 0, guid, "fmuType = 0"),
        (Some("unit"), 1, None, "fmuGUID"),
        (Some("unit"), 1, Some("{other}"), "{other}"),
    ] {
        let lines = Unit::with(name, kind, given).err().expect("no instance");
        assert_eq!(lines.len(), 1);
        assert!(lines[0].contains(word), "{lines:?}");
    }
}

#[test]
fn no_callbacks_at_all() {
    let guid = std::ffi::CString::new(library_guid().expect("a GUID")).expect("no NUL");
    let silent = CallbackFunctions {
        logger: None,
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        environment: ptr::null_mut(),
    };
    for functions in [ptr::null(), &raw const silent] {
        unsafe {
            let unit = fmi2Instantiate(
                c"unit".as_ptr(),
                1,
                guid.as_ptr(),
                ptr::null(),
                functions,
                0,
                1,
            );
            assert!(!unit.is_null());
            assert_eq!(fmi2DoStep(unit, 0.0, 1.0, 1), ERROR);
            fmi2FreeInstance(unit);
        }
    }
}

#[test]
fn null_component() {
    unsafe {
        fmi2FreeInstance(ptr::null_mut());
        assert_eq!(fmi2DoStep(ptr::null_mut(), 0.0, 1.0, 1), ERROR);
        assert_eq!(fmi2Reset(ptr::null_mut()), ERROR);
    }
}

#[test]
fn null_arrays_and_strings() {
    let unit = Unit::new();
    let mass = reference("mass");
    let mut value = 0.0;
    let text: *const c_char = ptr::null();
    unsafe {
        unit.refused(
            fmi2GetReal(unit.component, ptr::null(), 1, &raw mut value),
            &["vr is NULL"],
        );
        unit.refused(
            fmi2GetReal(unit.component, &raw const mass, 1, ptr::null_mut()),
            &["value is NULL"],
        );
        unit.refused(
            fmi2SetReal(
                unit.component,
                &raw const mass,
                usize::MAX,
                &raw const value,
            ),
            &["vr", "elements"],
        );
        unit.refused(
            fmi2SetString(unit.component, &raw const mass, 1, &raw const text),
            &["value is NULL"],
        );
        unit.refused(
            fmi2SetDebugLogging(unit.component, 1, 2, ptr::null()),
            &["categories"],
        );
        unit.refused(
            fmi2GetRealStatus(unit.component, 2, ptr::null_mut()),
            &["value is NULL"],
        );
        unit.refused(
            fmi2GetFMUstate(unit.component, ptr::null_mut()),
            &["FMUstate is NULL"],
        );
        unit.refused(
            fmi2SetFMUstate(unit.component, ptr::null_mut()),
            &["FMUstate is NULL"],
        );
        assert_eq!(fmi2FreeFMUstate(unit.component, ptr::null_mut()), OK);
        assert_eq!(
            fmi2GetReal(unit.component, ptr::null(), 0, ptr::null_mut()),
            OK
        );
        assert_eq!(
            fmi2GetString(unit.component, ptr::null(), 0, ptr::null_mut()),
            OK
        );
    }
}
