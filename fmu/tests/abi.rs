//! The exported functions have the types of the standard's header, written out by hand.
#![allow(
    unsafe_code,
    reason = "names C function types, most of them unsafe to call"
)]

use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::mem::{offset_of, size_of};

use softstop_fmi2::*;

type Component = *mut c_void;
type State = *mut c_void;
type Text = *const c_char;
type Status = c_int;
type Only = unsafe extern "C" fn(Component) -> Status;
type Get<T> = unsafe extern "C" fn(Component, *const c_uint, usize, *mut T) -> Status;
type Set<T> = unsafe extern "C" fn(Component, *const c_uint, usize, *const T) -> Status;
type Kind<T> = unsafe extern "C" fn(Component, c_int, *mut T) -> Status;

#[test]
fn functions_have_the_types_of_the_standard() {
    let _: unsafe extern "C" fn() -> Text = fmi2GetTypesPlatform;
    let _: unsafe extern "C" fn() -> Text = fmi2GetVersion;
    let _: unsafe extern "C" fn(Component, c_int, usize, *const Text) -> Status =
        fmi2SetDebugLogging;
    let _: unsafe extern "C" fn(
        Text,
        c_int,
        Text,
        Text,
        *const CallbackFunctions,
        c_int,
        c_int,
    ) -> Component = fmi2Instantiate;
    let _: unsafe extern "C" fn(Component) = fmi2FreeInstance;
    let _: unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> Status =
        fmi2SetupExperiment;
    let _: [Only; 5] = [
        fmi2EnterInitializationMode,
        fmi2ExitInitializationMode,
        fmi2Terminate,
        fmi2Reset,
        fmi2CancelStep,
    ];
    let _: Get<f64> = fmi2GetReal;
    let _: Get<c_int> = fmi2GetInteger;
    let _: Get<c_int> = fmi2GetBoolean;
    let _: Get<Text> = fmi2GetString;
    let _: Set<f64> = fmi2SetReal;
    let _: Set<c_int> = fmi2SetInteger;
    let _: Set<c_int> = fmi2SetBoolean;
    let _: Set<Text> = fmi2SetString;
    let _: unsafe extern "C" fn(Component, *mut State) -> Status = fmi2GetFMUstate;
    let _: unsafe extern "C" fn(Component, State) -> Status = fmi2SetFMUstate;
    let _: unsafe extern "C" fn(Component, *mut State) -> Status = fmi2FreeFMUstate;
    let _: unsafe extern "C" fn(Component, State, *mut usize) -> Status =
        fmi2SerializedFMUstateSize;
    let _: unsafe extern "C" fn(Component, State, *mut c_char, usize) -> Status =
        fmi2SerializeFMUstate;
    let _: unsafe extern "C" fn(Component, *const c_char, usize, *mut State) -> Status =
        fmi2DeSerializeFMUstate;
    let _: unsafe extern "C" fn(
        Component,
        *const c_uint,
        usize,
        *const c_uint,
        usize,
        *const f64,
        *mut f64,
    ) -> Status = fmi2GetDirectionalDerivative;
    let _: unsafe extern "C" fn(
        Component,
        *const c_uint,
        usize,
        *const c_int,
        *const f64,
    ) -> Status = fmi2SetRealInputDerivatives;
    let _: unsafe extern "C" fn(Component, *const c_uint, usize, *const c_int, *mut f64) -> Status =
        fmi2GetRealOutputDerivatives;
    let _: unsafe extern "C" fn(Component, f64, f64, c_int) -> Status = fmi2DoStep;
    let _: [Only; 2] = [fmi2EnterEventMode, fmi2EnterContinuousTimeMode];
    let _: unsafe extern "C" fn(Component, *mut EventInfo) -> Status = fmi2NewDiscreteStates;
    let _: unsafe extern "C" fn(Component, c_int, *mut c_int, *mut c_int) -> Status =
        fmi2CompletedIntegratorStep;
    let _: unsafe extern "C" fn(Component, f64) -> Status = fmi2SetTime;
    let _: unsafe extern "C" fn(Component, *const f64, usize) -> Status = fmi2SetContinuousStates;
    let _: [unsafe extern "C" fn(Component, *mut f64, usize) -> Status; 4] = [
        fmi2GetDerivatives,
        fmi2GetEventIndicators,
        fmi2GetContinuousStates,
        fmi2GetNominalsOfContinuousStates,
    ];
    let _: Kind<Status> = fmi2GetStatus;
    let _: Kind<f64> = fmi2GetRealStatus;
    let _: Kind<c_int> = fmi2GetIntegerStatus;
    let _: Kind<c_int> = fmi2GetBooleanStatus;
    let _: Kind<Text> = fmi2GetStringStatus;
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

#[test]
fn version_and_platform() {
    // SAFETY: both return constant strings.
    let texts = unsafe {
        [
            CStr::from_ptr(fmi2GetVersion()),
            CStr::from_ptr(fmi2GetTypesPlatform()),
        ]
    };
    assert_eq!(texts, [c"2.0", c"default"]);
}
