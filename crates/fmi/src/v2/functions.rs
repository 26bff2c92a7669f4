//! The functions of the standard.
//!
//! Each turns pointers into slices, calls the safe [`Instance`] and turns a [`Fault`] into `fmi2Error`
//! and one log line. Enumerations and Booleans of the importer come in as plain integers, since a number
//! out of their range must not be undefined behaviour.
#![expect(
    clippy::missing_safety_doc,
    non_snake_case,
    reason = "names and contracts are those of the FMI 2.0 standard"
)]

use libc::{c_char, c_int, c_uint, c_void, size_t};

use super::host::{CallbackFunctions, Importer, answer, instantiate};
use crate::abi::component::Component;
use crate::abi::guard::{guarded, silent};
use crate::abi::pointers::{read, string, write, write_one};
use crate::abi::state;
use crate::fault::Fault;
use crate::log::Category;
use crate::reading::Type;
use crate::step::StepReport;
use crate::unit::Unit;

const LAST_SUCCESSFUL_TIME: c_int = 2;
const DO_STEP_STATUS: c_int = 0;
const PENDING_STATUS: c_int = 1;
const TERMINATED: c_int = 3;

functions! { $ export_v2 v2 Importer;
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
        let make = || instantiate::<U>(instance_name, fmu_type, guid, functions, logging_on != 0);
        let made = silent(|| make().map(|made| Box::into_raw(made).cast()));
        made.ok().flatten().unwrap_or(std::ptr::null_mut())
    }

    /// Frees an instance, once; NULL is allowed.
    fn fmi2FreeInstance<U>(component: *mut c_void) -> () {
        if !component.is_null() {
            let freed = silent(|| drop(Box::from_raw(component.cast::<Component<U, Importer>>())));
            debug_assert!(freed.is_ok());
        }
    }

    ;

    /// Switches categories of log lines.
    fn fmi2SetDebugLogging<U>(
        component, logging_on: c_int, count: size_t, categories: *const *const c_char
    ) {
        let names = read("categories", categories, count)?;
        let names = names
            .iter()
            .map(|&name| string("categories", name))
            .collect::<Result<Vec<_>, _>>()?;
        component.wanted.switch(logging_on != 0, &names)
    }

    /// Sets start time, stop time and tolerance; the last is of no use to an exact solution.
    fn fmi2SetupExperiment<U>(
        component, tolerance_defined: c_int, tolerance: f64, start_time: f64,
        stop_time_defined: c_int, stop_time: f64
    ) {
        component.instance.setup(
            (tolerance_defined != 0).then_some(tolerance),
            start_time,
            (stop_time_defined != 0).then_some(stop_time),
        )?;
        if tolerance_defined != 0 {
            component.tell_tolerance(tolerance);
        }
        Ok(())
    }

    /// Enters initialisation.
    fn fmi2EnterInitializationMode<U>(component) {
        component.instance.enter_initialization()
    }

    /// Leaves initialisation.
    fn fmi2ExitInitializationMode<U>(component) {
        component.exit_initialization()
    }

    /// Ends the experiment.
    fn fmi2Terminate<U>(component) {
        component.instance.terminate()
    }

    /// Leads back to the state right after instantiation.
    fn fmi2Reset<U>(component) {
        component.reset();
        Ok(())
    }

    /// Reads real values.
    fn fmi2GetReal<U>(component, references: *const c_uint, count: size_t, values: *mut f64) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::Real, |value| value)
    }

    /// Reads integers and enumerations.
    fn fmi2GetInteger<U>(component, references: *const c_uint, count: size_t, values: *mut c_int) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::Integer, |value| value as i32)
    }

    /// Reads Booleans.
    fn fmi2GetBoolean<U>(component, references: *const c_uint, count: size_t, values: *mut c_int) {
        let (references, values) = (read("vr", references, count)?, write("value", values, count)?);
        component.instance.read(references, values, Type::Boolean, |value| value as i32)
    }

    /// Reads strings, of which there are none.
    fn fmi2GetString<U>(
        component, references: *const c_uint, count: size_t, values: *mut *const c_char
    ) {
        write("value", values, count)?;
        component.instance.none_of(Type::String, read("vr", references, count)?)
    }

    /// Sets real values.
    fn fmi2SetReal<U>(component, references: *const c_uint, count: size_t, values: *const f64) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::Real, |value| value)
    }

    /// Sets integers and enumerations.
    fn fmi2SetInteger<U>(component, references: *const c_uint, count: size_t, values: *const c_int) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::Integer, f64::from)
    }

    /// Sets Booleans; every number but 0 means true.
    fn fmi2SetBoolean<U>(component, references: *const c_uint, count: size_t, values: *const c_int) {
        let (references, values) = (read("vr", references, count)?, read("value", values, count)?);
        component.instance.set(references, values, Type::Boolean, |value| f64::from(u8::from(value != 0)))
    }

    /// Sets strings, of which there are none.
    fn fmi2SetString<U>(
        component, references: *const c_uint, count: size_t, values: *const *const c_char
    ) {
        for &value in read("value", values, count)? {
            string("value", value)?;
        }
        component.instance.none_of(Type::String, read("vr", references, count)?)
    }

    /// Keeps a snapshot; one that was kept before is overwritten.
    fn fmi2GetFMUstate<U>(component, state: *mut *mut c_void) {
        state::keep(component, state)
    }

    /// Goes back to a snapshot.
    fn fmi2SetFMUstate<U>(component, state: *mut c_void) {
        state::go_back(component, state)
    }

    /// Frees a snapshot and sets its pointer to NULL; NULL is allowed.
    fn fmi2FreeFMUstate<U>(_component, state: *mut *mut c_void) {
        state::free::<U>(state)
    }

    /// How many bytes a snapshot takes.
    fn fmi2SerializedFMUstateSize<U>(_component, state: *mut c_void, size: *mut size_t) {
        state::measure::<U>(state, size)
    }

    /// Writes a snapshot as bytes; what is left of them becomes zero.
    fn fmi2SerializeFMUstate<U>(
        _component, state: *mut c_void, bytes: *mut c_char, size: size_t
    ) {
        state::store::<U>(state, bytes.cast(), size)
    }

    /// Makes a snapshot of bytes. The pointer's old content is not looked at.
    fn fmi2DeSerializeFMUstate<U>(
        _component, bytes: *const c_char, size: size_t, state: *mut *mut c_void
    ) {
        state::restore::<U>(bytes.cast(), size, state)
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
        component.require_co_simulation()?;
        component.instance.set_input_derivatives(references, orders, values)
    }

    /// Reads time derivatives of outputs.
    fn fmi2GetRealOutputDerivatives<U>(
        component, references: *const c_uint, count: size_t, orders: *const c_int,
        values: *mut f64
    ) {
        let references = read("vr", references, count)?;
        let orders = read("order", orders, count)?;
        let values = write("value", values, count)?;
        component.require_co_simulation()?;
        component.instance.get_output_derivatives(references, orders, values)
    }

    /// Carries the motion on by one communication step.
    fn fmi2DoStep<U>(component, point: f64, step: f64, _no_set_state_prior: c_int) {
        component.require_co_simulation()?;
        let mut report = StepReport::new(component.wanted.has(Category::Events));
        let outcome = component.instance.do_step(point, step, &mut report);
        component.tell(&report);
        outcome
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
}
