//! The functions of the standard.
//!
//! Each turns pointers into slices, calls the safe [`Instance`] and turns a [`Fault`] into `fmi2Error`
//! and one log line. Enumerations and Booleans of the importer come in as plain integers, since a number
//! out of their range must not be undefined behaviour.

use libc::{c_char, c_int, c_uint, c_void, size_t};

use super::host::{CallbackFunctions, EventInfo, answer, instantiate};
use crate::abi::component::Component;
use crate::abi::guard::{guarded, handle, silent};
use crate::abi::pointers::{read, string, write, write_one};
use crate::abi::state;
use crate::fault::Fault;
use crate::instance::Instance;
use crate::reading::Type;
use crate::standard::Standard::Fmi2;
use crate::unit::Unit;

const LAST_SUCCESSFUL_TIME: c_int = 2;
const DO_STEP_STATUS: c_int = 0;
const PENDING_STATUS: c_int = 1;
const TERMINATED: c_int = 3;

functions! { $ export_v2 v2;
    /// The platform types this library was built with.
    fn fmi2GetTypesPlatform<U>() -> *const c_char {
        c"default".as_ptr()
    }

    /// The version of the standard.
    fn fmi2GetVersion<U>() -> *const c_char {
        c"2.0".as_ptr()
    }

    /// Makes an instance, or returns NULL after one log line.
    fn fmi2Instantiate<U>(
        instance_name: *const c_char, fmu_type: c_int, guid: *const c_char,
        _resource_location: *const c_char, functions: *const CallbackFunctions,
        _visible: c_int, logging_on: c_int
    ) -> *mut c_void {
        handle(|| instantiate::<U>(instance_name, fmu_type, guid, functions, logging_on != 0))
    }

    ;

    /// Sets start time, stop time and tolerance; the last is of no use to an exact solution.
    fn fmi2SetupExperiment<U>(
        component, tolerance_defined: c_int, tolerance: f64, start_time: f64,
        stop_time_defined: c_int, stop_time: f64
    ) {
        let tolerance = (tolerance_defined != 0).then_some(tolerance);
        component.setup(tolerance, start_time, (stop_time_defined != 0).then_some(stop_time))
    }

    /// Enters initialisation.
    fn fmi2EnterInitializationMode<U>(component) {
        component.instance.enter_initialization()
    }

    /// Reads real values.
    fn fmi2GetReal<U>(component, references: *const c_uint, count: size_t, values: *mut f64) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::REAL, |value| value)
    }

    /// Reads integers and enumerations.
    fn fmi2GetInteger<U>(component, references: *const c_uint, count: size_t, values: *mut c_int) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::of(Fmi2, "Integer"), |value| value as i32)
    }

    /// Reads Booleans.
    fn fmi2GetBoolean<U>(component, references: *const c_uint, count: size_t, values: *mut c_int) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::of(Fmi2, "Boolean"), |value| value as i32)
    }

    /// Reads strings, of which there are none.
    fn fmi2GetString<U>(
        component, references: *const c_uint, count: size_t, values: *mut *const c_char
    ) {
        write("value", values, count)?;
        component.instance.none_of(Type::of(Fmi2, "String"), read("vr", references, count)?)
    }

    /// Sets real values.
    fn fmi2SetReal<U>(component, references: *const c_uint, count: size_t, values: *const f64) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::REAL, |value| value)
    }

    /// Sets integers and enumerations.
    fn fmi2SetInteger<U>(component, references: *const c_uint, count: size_t, values: *const c_int) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::of(Fmi2, "Integer"), f64::from)
    }

    /// Sets Booleans; every number but 0 means true.
    fn fmi2SetBoolean<U>(component, references: *const c_uint, count: size_t, values: *const c_int) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::of(Fmi2, "Boolean"), |value| f64::from(u8::from(value != 0)))
    }

    /// Sets strings, of which there are none.
    fn fmi2SetString<U>(
        component, references: *const c_uint, count: size_t, values: *const *const c_char
    ) {
        for &value in read("value", values, count)? {
            string("value", value)?;
        }
        component.instance.none_of(Type::of(Fmi2, "String"), read("vr", references, count)?)
    }

    /// Derivatives of outputs along a direction of inputs.
    fn fmi2GetDirectionalDerivative<U>(
        component, unknowns: *const c_uint, unknown_count: size_t, knowns: *const c_uint,
        known_count: size_t, seed: *const f64, sensitivity: *mut f64
    ) {
        let unknowns = read("vUnknown_ref", unknowns, unknown_count)?;
        let knowns = read("vKnown_ref", knowns, known_count)?;
        let seed = read("dvKnown", seed, known_count)?;
        let sensitivity = write("dvUnknown", sensitivity, unknown_count)?;
        component.instance.directional_derivative(unknowns, knowns, seed, sensitivity)
    }

    /// Sets time derivatives of inputs.
    fn fmi2SetRealInputDerivatives<U>(
        component, references: *const c_uint, count: size_t, orders: *const c_int,
        values: *const f64
    ) {
        let references = read("vr", references, count)?;
        let orders = read("order", orders, count)?;
        let values = read("value", values, count)?;
        component.co_simulation()?.set_input_derivatives(references, orders, values)
    }

    /// Reads time derivatives of outputs.
    fn fmi2GetRealOutputDerivatives<U>(
        component, references: *const c_uint, count: size_t, orders: *const c_int,
        values: *mut f64
    ) {
        let references = read("vr", references, count)?;
        let orders = read("order", orders, count)?;
        let values = write("value", values, count)?;
        component.co_simulation()?.get_output_derivatives(references, orders, values)
    }

    /// Carries the motion on by one communication step.
    fn fmi2DoStep<U>(component, point: f64, step: f64, _no_set_state_prior: c_int) {
        component.co_simulation()?;
        component.reported(|instance, report| instance.do_step(point, step, None, report))
    }

    /// There is never a step to cancel.
    fn fmi2CancelStep<U>(_component) {
        Err(Fault::NotPending)
    }

    /// How the last step ended.
    fn fmi2GetStatus<U>(component, kind: c_int, value: *mut c_int) {
        let status = component.instance.last_status() as c_int;
        answer("status", kind, DO_STEP_STATUS, value, status)
    }

    /// The time up to which the motion is known.
    fn fmi2GetRealStatus<U>(component, kind: c_int, value: *mut f64) {
        answer("Real", kind, LAST_SUCCESSFUL_TIME, value, component.instance.time())
    }

    /// There is no integer status.
    fn fmi2GetIntegerStatus<U>(_component, kind: c_int, value: *mut c_int) {
        write_one("value", value)?;
        Err(Fault::StatusKind { kind, wanted: "Integer" })
    }

    /// The unit never ends by itself.
    fn fmi2GetBooleanStatus<U>(_component, kind: c_int, value: *mut c_int) {
        answer("Boolean", kind, TERMINATED, value, 0)
    }

    /// There is no pending step to tell of.
    fn fmi2GetStringStatus<U>(_component, kind: c_int, value: *mut *const c_char) {
        answer("String", kind, PENDING_STATUS, value, c"".as_ptr())?;
        Err(Fault::NotPending)
    }

    /// Enters event mode.
    fn fmi2EnterEventMode<U>(component) {
        component.exchange()?.enter_event_mode_of_exchange()
    }

    /// Lets the event happen, and tells when the next one comes.
    fn fmi2NewDiscreteStates<U>(component, event_info: *mut EventInfo) {
        let info = write_one("fmi2eventInfo", event_info)?;
        component.exchange()?;
        let iteration = component.reported(Instance::update_discrete_states)?;
        *info = EventInfo {
            new_discrete_states_needed: iteration.is_unfinished.into(),
            terminate_simulation: 0,
            nominals_of_continuous_states_changed: iteration.has_new_nominals.into(),
            values_of_continuous_states_changed: iteration.has_new_states.into(),
            next_event_time_defined: iteration.next.is_some().into(),
            next_event_time: iteration.next.unwrap_or(0.0),
        };
        Ok(())
    }
}

shared_functions! { $ export_v2_shared v2 c_int, c_char, "x", "x_nominal";
    fmi2FreeInstance fmi2SetDebugLogging fmi2ExitInitializationMode fmi2Terminate fmi2Reset
    fmi2GetFMUstate fmi2SetFMUstate fmi2FreeFMUstate fmi2SerializedFMUstateSize fmi2SerializeFMUstate
    fmi2DeSerializeFMUstate
    fmi2EnterContinuousTimeMode fmi2CompletedIntegratorStep fmi2SetTime fmi2SetContinuousStates
    fmi2GetDerivatives fmi2GetEventIndicators fmi2GetContinuousStates fmi2GetNominalsOfContinuousStates
}
