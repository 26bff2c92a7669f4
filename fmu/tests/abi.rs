//! The exported functions have the types of the standards' headers, written out by hand.
#![allow(
    unsafe_code,
    reason = "names C function types, most of them unsafe to call"
)]

use std::collections::BTreeSet;
use std::ffi::{c_char, c_int, c_uint, c_void};
use std::mem::{offset_of, size_of};

use softstop_fmi2::*;
use softstop_fmi3::*;

type Handle = *mut c_void;
type Text = *const c_char;
type References = *const c_uint;

/// The names of functions, each of which takes these arguments and returns this.
macro_rules! functions {
    ($($arguments:tt -> $result:ty: $($function:ident)+;)*) => {{
        $($(functions!(@type $function $arguments $result);)+)*
        BTreeSet::from([$($(stringify!($function)),+),*])
    }};
    (@type $function:ident ($($argument:ty),*) $result:ty) => {
        let _: unsafe extern "C" fn($($argument),*) -> $result = $function;
    };
}

/// The names in a module definition file.
fn exports(definitions: &str) -> BTreeSet<&str> {
    let (_, names) = definitions.split_once("EXPORTS").expect("exports");
    names.split_whitespace().collect()
}

#[test]
fn functions_have_the_types_of_fmi_2() {
    let typed = functions! {
        () -> Text: fmi2GetTypesPlatform fmi2GetVersion;
        (Text, c_int, Text, Text, *const CallbackFunctions, c_int, c_int) -> Handle: fmi2Instantiate;
        (Handle) -> (): fmi2FreeInstance;
        (Handle, c_int, usize, *const Text) -> c_int: fmi2SetDebugLogging;
        (Handle, c_int, f64, f64, c_int, f64) -> c_int: fmi2SetupExperiment;
        (Handle) -> c_int: fmi2EnterInitializationMode fmi2ExitInitializationMode fmi2Terminate fmi2Reset fmi2CancelStep
            fmi2EnterEventMode fmi2EnterContinuousTimeMode;
        (Handle, References, usize, *mut f64) -> c_int: fmi2GetReal;
        (Handle, References, usize, *mut c_int) -> c_int: fmi2GetInteger fmi2GetBoolean;
        (Handle, References, usize, *mut Text) -> c_int: fmi2GetString;
        (Handle, References, usize, *const f64) -> c_int: fmi2SetReal;
        (Handle, References, usize, *const c_int) -> c_int: fmi2SetInteger fmi2SetBoolean;
        (Handle, References, usize, *const Text) -> c_int: fmi2SetString;
        (Handle, *mut Handle) -> c_int: fmi2GetFMUstate fmi2FreeFMUstate;
        (Handle, Handle) -> c_int: fmi2SetFMUstate;
        (Handle, Handle, *mut usize) -> c_int: fmi2SerializedFMUstateSize;
        (Handle, Handle, *mut c_char, usize) -> c_int: fmi2SerializeFMUstate;
        (Handle, *const c_char, usize, *mut Handle) -> c_int: fmi2DeSerializeFMUstate;
        (Handle, References, usize, References, usize, *const f64, *mut f64) -> c_int: fmi2GetDirectionalDerivative;
        (Handle, References, usize, *const c_int, *const f64) -> c_int: fmi2SetRealInputDerivatives;
        (Handle, References, usize, *const c_int, *mut f64) -> c_int: fmi2GetRealOutputDerivatives;
        (Handle, f64, f64, c_int) -> c_int: fmi2DoStep;
        (Handle, c_int, *mut c_int) -> c_int: fmi2GetStatus fmi2GetIntegerStatus fmi2GetBooleanStatus;
        (Handle, c_int, *mut f64) -> c_int: fmi2GetRealStatus;
        (Handle, c_int, *mut Text) -> c_int: fmi2GetStringStatus;
        (Handle, *mut EventInfo) -> c_int: fmi2NewDiscreteStates;
        (Handle, c_int, *mut c_int, *mut c_int) -> c_int: fmi2CompletedIntegratorStep;
        (Handle, f64) -> c_int: fmi2SetTime;
        (Handle, *const f64, usize) -> c_int: fmi2SetContinuousStates;
        (Handle, *mut f64, usize) -> c_int: fmi2GetDerivatives fmi2GetEventIndicators fmi2GetContinuousStates
            fmi2GetNominalsOfContinuousStates;
    };
    assert_eq!(typed, exports(include_str!("../fmi2/exports.def")));
}

#[test]
fn functions_have_the_types_of_fmi_3() {
    let typed = functions! {
        () -> Text: fmi3GetVersion;
        (Text, Text, Text, u8, u8, Handle, LogMessageCallback) -> Handle: fmi3InstantiateModelExchange;
        (Text, Text, Text, u8, u8, u8, u8, References, usize, Handle, LogMessageCallback, IntermediateUpdateCallback) -> Handle:
            fmi3InstantiateCoSimulation;
        (Text, Text, Text, u8, u8, Handle, LogMessageCallback, ClockUpdateCallback, PreemptionCallback, PreemptionCallback)
            -> Handle: fmi3InstantiateScheduledExecution;
        (Handle) -> (): fmi3FreeInstance;
        (Handle, u8, usize, *const Text) -> c_int: fmi3SetDebugLogging;
        (Handle, u8, f64, f64, u8, f64) -> c_int: fmi3EnterInitializationMode;
        (Handle) -> c_int: fmi3ExitInitializationMode fmi3EnterEventMode fmi3Terminate fmi3Reset fmi3EnterConfigurationMode
            fmi3ExitConfigurationMode fmi3EvaluateDiscreteStates fmi3EnterContinuousTimeMode fmi3EnterStepMode;
        (Handle, References, usize, *mut f32, usize) -> c_int: fmi3GetFloat32;
        (Handle, References, usize, *mut f64, usize) -> c_int: fmi3GetFloat64;
        (Handle, References, usize, *mut i8, usize) -> c_int: fmi3GetInt8;
        (Handle, References, usize, *mut u8, usize) -> c_int: fmi3GetUInt8 fmi3GetBoolean;
        (Handle, References, usize, *mut i16, usize) -> c_int: fmi3GetInt16;
        (Handle, References, usize, *mut u16, usize) -> c_int: fmi3GetUInt16;
        (Handle, References, usize, *mut i32, usize) -> c_int: fmi3GetInt32;
        (Handle, References, usize, *mut u32, usize) -> c_int: fmi3GetUInt32;
        (Handle, References, usize, *mut i64, usize) -> c_int: fmi3GetInt64;
        (Handle, References, usize, *mut u64, usize) -> c_int: fmi3GetUInt64;
        (Handle, References, usize, *mut Text, usize) -> c_int: fmi3GetString;
        (Handle, References, usize, *mut usize, *mut *const u8, usize) -> c_int: fmi3GetBinary;
        (Handle, References, usize, *mut u8) -> c_int: fmi3GetClock;
        (Handle, References, usize, *const f32, usize) -> c_int: fmi3SetFloat32;
        (Handle, References, usize, *const f64, usize) -> c_int: fmi3SetFloat64;
        (Handle, References, usize, *const i8, usize) -> c_int: fmi3SetInt8;
        (Handle, References, usize, *const u8, usize) -> c_int: fmi3SetUInt8 fmi3SetBoolean;
        (Handle, References, usize, *const i16, usize) -> c_int: fmi3SetInt16;
        (Handle, References, usize, *const u16, usize) -> c_int: fmi3SetUInt16;
        (Handle, References, usize, *const i32, usize) -> c_int: fmi3SetInt32;
        (Handle, References, usize, *const u32, usize) -> c_int: fmi3SetUInt32;
        (Handle, References, usize, *const i64, usize) -> c_int: fmi3SetInt64;
        (Handle, References, usize, *const u64, usize) -> c_int: fmi3SetUInt64;
        (Handle, References, usize, *const Text, usize) -> c_int: fmi3SetString;
        (Handle, References, usize, *const usize, *const *const u8, usize) -> c_int: fmi3SetBinary;
        (Handle, References, usize, *const u8) -> c_int: fmi3SetClock;
        (Handle, c_uint, *mut usize) -> c_int: fmi3GetNumberOfVariableDependencies;
        (Handle, c_uint, *mut usize, *mut c_uint, *mut usize, *mut c_int, usize) -> c_int: fmi3GetVariableDependencies;
        (Handle, *mut Handle) -> c_int: fmi3GetFMUState fmi3FreeFMUState;
        (Handle, Handle) -> c_int: fmi3SetFMUState;
        (Handle, Handle, *mut usize) -> c_int: fmi3SerializedFMUStateSize;
        (Handle, Handle, *mut u8, usize) -> c_int: fmi3SerializeFMUState;
        (Handle, *const u8, usize, *mut Handle) -> c_int: fmi3DeserializeFMUState;
        (Handle, References, usize, References, usize, *const f64, usize, *mut f64, usize) -> c_int:
            fmi3GetDirectionalDerivative fmi3GetAdjointDerivative;
        (Handle, References, usize, *mut f64, *mut c_int) -> c_int: fmi3GetIntervalDecimal;
        (Handle, References, usize, *mut u64, *mut u64, *mut c_int) -> c_int: fmi3GetIntervalFraction;
        (Handle, References, usize, *mut f64) -> c_int: fmi3GetShiftDecimal;
        (Handle, References, usize, *mut u64, *mut u64) -> c_int: fmi3GetShiftFraction;
        (Handle, References, usize, *const f64) -> c_int: fmi3SetIntervalDecimal fmi3SetShiftDecimal;
        (Handle, References, usize, *const u64, *const u64) -> c_int: fmi3SetIntervalFraction fmi3SetShiftFraction;
        (Handle, *mut u8, *mut u8, *mut u8, *mut u8, *mut u8, *mut f64) -> c_int: fmi3UpdateDiscreteStates;
        (Handle, u8, *mut u8, *mut u8) -> c_int: fmi3CompletedIntegratorStep;
        (Handle, f64) -> c_int: fmi3SetTime;
        (Handle, *const f64, usize) -> c_int: fmi3SetContinuousStates;
        (Handle, *mut f64, usize) -> c_int: fmi3GetContinuousStateDerivatives fmi3GetEventIndicators fmi3GetContinuousStates
            fmi3GetNominalsOfContinuousStates;
        (Handle, *mut usize) -> c_int: fmi3GetNumberOfEventIndicators fmi3GetNumberOfContinuousStates;
        (Handle, References, usize, *const i32, *mut f64, usize) -> c_int: fmi3GetOutputDerivatives;
        (Handle, f64, f64, u8, *mut u8, *mut u8, *mut u8, *mut f64) -> c_int: fmi3DoStep;
        (Handle, c_uint, f64) -> c_int: fmi3ActivateModelPartition;
    };
    assert_eq!(typed, exports(include_str!("../fmi3/exports.def")));
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
