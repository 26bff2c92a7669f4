//! The exported functions have the types of the standard's header, written out by hand.
#![allow(
    unsafe_code,
    reason = "names C function types, most of them unsafe to call"
)]

use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};

use softstop_fmi2::*;

type Component = *mut c_void;

/// Those of model exchange, which no other test calls.
#[test]
fn functions_have_the_types_of_the_standard() {
    let _: [unsafe extern "C" fn(Component) -> c_int; 2] =
        [fmi2EnterEventMode, fmi2EnterContinuousTimeMode];
    let _: unsafe extern "C" fn(Component, *mut EventInfo) -> c_int = fmi2NewDiscreteStates;
    let _: unsafe extern "C" fn(Component, c_int, *mut c_int, *mut c_int) -> c_int =
        fmi2CompletedIntegratorStep;
    let _: unsafe extern "C" fn(Component, f64) -> c_int = fmi2SetTime;
    let _: unsafe extern "C" fn(Component, *const f64, usize) -> c_int = fmi2SetContinuousStates;
    let _: [unsafe extern "C" fn(Component, *mut f64, usize) -> c_int; 4] = [
        fmi2GetDerivatives,
        fmi2GetEventIndicators,
        fmi2GetContinuousStates,
        fmi2GetNominalsOfContinuousStates,
    ];
}

#[test]
fn callbacks_lie_as_in_the_standard() {
    let pointer = size_of::<*const c_void>();
    assert_eq!(size_of::<CallbackFunctions>(), 5 * pointer);
    assert_eq!(offset_of!(CallbackFunctions, logger), 0);
    assert_eq!(offset_of!(CallbackFunctions, allocate_memory), pointer);
    assert_eq!(offset_of!(CallbackFunctions, free_memory), 2 * pointer);
    assert_eq!(offset_of!(CallbackFunctions, step_finished), 3 * pointer);
    assert_eq!(offset_of!(CallbackFunctions, environment), 4 * pointer);
    let flag = size_of::<c_int>();
    assert_eq!(offset_of!(EventInfo, next_event_time_defined), 4 * flag);
    assert_eq!(offset_of!(EventInfo, next_event_time), 6 * flag);
    assert_eq!(size_of::<EventInfo>(), 6 * flag + size_of::<f64>());
}
