//! The 34 C functions of FMI 2.0 for co-simulation.
//!
//! Each turns pointers into slices, calls the safe [`Instance`] and turns a
//! [`Fault`] into `fmi2Error` and one log line. Enumerations and Booleans of the importer come in
//! as plain integers, since a number out of their range must not be undefined behaviour.
#![allow(
    unsafe_code,
    reason = "the C interface: pointers of the importer and exported symbols"
)]
#![expect(
    clippy::missing_safety_doc,
    reason = "names and contracts are those of the FMI 2.0 standard"
)]

mod component;
mod guard;
mod pointers;

use std::ffi::{c_char, c_int, c_uint, c_void};

pub use crate::status::Status;
pub use component::{CallbackFunctions, Logger};
use component::{Component, instantiate};
use guard::{guarded, silent};
use pointers::{read, string, write, write_one};

use crate::error::Fault;
use crate::instance::Instance;
use crate::log::Category;

/// `fmi2CoSimulation` of `fmi2Type`.
pub const CO_SIMULATION: c_int = 1;

const LAST_SUCCESSFUL_TIME: c_int = 2;
const DO_STEP_STATUS: c_int = 0;
const PENDING_STATUS: c_int = 1;
const TERMINATED: c_int = 3;

macro_rules! export {
    ($(
        $(#[$doc:meta])*
        fn $name:ident($component:ident $(, $argument:ident: $type:ty)*) $body:block
    )*) => {
        $(
            $(#[$doc])*
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $name(
                component: *mut c_void
                $(, $argument: $type)*
            ) -> c_int {
                // SAFETY: the importer passes NULL or what fmi2Instantiate gave it.
                let component = unsafe { component.cast::<Component>().as_mut() };
                guarded(component, stringify!($name), |$component| {
                    // SAFETY: by the standard arrays are as long as the importer says; NULL is
                    // refused where there is something to read or to write.
                    #[allow(unused_unsafe, reason = "not every function takes an array")]
                    unsafe { $body }
                })
            }
        )*
    };
}

/// What a snapshot's handle points to.
///
/// # Safety
/// NULL, or what `fmi2GetFMUstate` or `fmi2DeSerializeFMUstate` gave and nobody has freed.
unsafe fn kept<'a>(state: *mut c_void) -> Result<&'a Instance, Fault> {
    // SAFETY: by this function's contract.
    unsafe { state.cast::<Instance>().as_ref() }.ok_or(Fault::Null {
        argument: "FMUstate",
    })
}

/// The platform types this library was built with.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// The version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Makes an instance, or returns NULL after one log line.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instance_name: *const c_char,
    fmu_type: c_int,
    guid: *const c_char,
    _resource_location: *const c_char,
    functions: *const CallbackFunctions,
    _visible: c_int,
    logging_on: c_int,
) -> *mut c_void {
    silent(|| {
        // SAFETY: by the standard these are NULL or point to what they say.
        let component =
            unsafe { instantiate(instance_name, fmu_type, guid, functions, logging_on != 0) };
        component.map_or(std::ptr::null_mut(), |made| Box::into_raw(made).cast())
    })
    .unwrap_or(std::ptr::null_mut())
}

/// Frees an instance; NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: *mut c_void) {
    if !component.is_null() {
        // SAFETY: the pointer came from Box::into_raw in fmi2Instantiate and is given back once.
        let freed = silent(|| drop(unsafe { Box::from_raw(component.cast::<Component>()) }));
        debug_assert!(freed.is_ok());
    }
}

export! {
    /// Switches categories of log lines.
    fn fmi2SetDebugLogging(
        component, logging_on: c_int, count: usize, categories: *const *const c_char
    ) {
        let names = read("categories", categories, count)?;
        let names = names
            .iter()
            .map(|&name| string("categories", name))
            .collect::<Result<Vec<_>, _>>()?;
        component.wanted.switch(logging_on != 0, &names)
    }

    /// Sets start time, stop time and tolerance; the last is of no use to an exact solution.
    fn fmi2SetupExperiment(
        component, tolerance_defined: c_int, tolerance: f64, start_time: f64,
        stop_time_defined: c_int, stop_time: f64
    ) {
        component.instance.setup(
            (tolerance_defined != 0).then_some(tolerance),
            start_time,
            (stop_time_defined != 0).then_some(stop_time),
        )?;
        if tolerance_defined != 0 {
            let text = format!("tolerance = {tolerance:e} has no effect: the motion is exact");
            component.log(Status::Ok, Category::Warnings, &text);
        }
        Ok(())
    }

    /// Enters initialisation.
    fn fmi2EnterInitializationMode(component) {
        component.instance.enter_initialization()
    }

    /// Leaves initialisation.
    fn fmi2ExitInitializationMode(component) {
        component.instance.exit_initialization()
    }

    /// Ends the experiment.
    fn fmi2Terminate(component) {
        component.instance.terminate()
    }

    /// Leads back to the state right after instantiation.
    fn fmi2Reset(component) {
        component.reset();
        Ok(())
    }

    /// Reads real values.
    fn fmi2GetReal(component, references: *const c_uint, count: usize, values: *mut f64) {
        let references = read("vr", references, count)?;
        component.instance.get_real(references, write("value", values, count)?)
    }

    /// Reads integers and enumerations.
    fn fmi2GetInteger(component, references: *const c_uint, count: usize, values: *mut c_int) {
        let references = read("vr", references, count)?;
        component.instance.get_integer(references, write("value", values, count)?)
    }

    /// Reads Booleans.
    fn fmi2GetBoolean(component, references: *const c_uint, count: usize, values: *mut c_int) {
        let references = read("vr", references, count)?;
        component.instance.get_boolean(references, write("value", values, count)?)
    }

    /// Reads strings, of which there are none.
    fn fmi2GetString(
        component, references: *const c_uint, count: usize, values: *mut *const c_char
    ) {
        write("value", values, count)?;
        component.instance.strings(read("vr", references, count)?)
    }

    /// Sets real values.
    fn fmi2SetReal(component, references: *const c_uint, count: usize, values: *const f64) {
        let references = read("vr", references, count)?;
        component.instance.set_real(references, read("value", values, count)?)
    }

    /// Sets integers and enumerations.
    fn fmi2SetInteger(component, references: *const c_uint, count: usize, values: *const c_int) {
        let references = read("vr", references, count)?;
        component.instance.set_integer(references, read("value", values, count)?)
    }

    /// Sets Booleans.
    fn fmi2SetBoolean(component, references: *const c_uint, count: usize, values: *const c_int) {
        let references = read("vr", references, count)?;
        component.instance.set_boolean(references, read("value", values, count)?)
    }

    /// Sets strings, of which there are none.
    fn fmi2SetString(
        component, references: *const c_uint, count: usize, values: *const *const c_char
    ) {
        for &value in read("value", values, count)? {
            string("value", value)?;
        }
        component.instance.strings(read("vr", references, count)?)
    }

    /// Keeps a snapshot; one that was kept before is overwritten.
    fn fmi2GetFMUstate(component, state: *mut *mut c_void) {
        let state = write_one("FMUstate", state)?;
        match state.cast::<Instance>().as_mut() {
            Some(kept) => kept.clone_from(&component.instance),
            None => *state = Box::into_raw(Box::new(component.instance.clone())).cast(),
        }
        Ok(())
    }

    /// Goes back to a snapshot.
    fn fmi2SetFMUstate(component, state: *mut c_void) {
        component.instance.clone_from(kept(state)?);
        Ok(())
    }

    /// Frees a snapshot and sets its pointer to NULL; NULL is allowed.
    fn fmi2FreeFMUstate(component, state: *mut *mut c_void) {
        let _ = &component;
        if let Some(state) = state.as_mut()
            && !state.is_null()
        {
            drop(Box::from_raw(state.cast::<Instance>()));
            *state = std::ptr::null_mut();
        }
        Ok(())
    }

    /// How many bytes a snapshot takes.
    fn fmi2SerializedFMUstateSize(component, state: *mut c_void, size: *mut usize) {
        let _ = &component;
        *write_one("size", size)? = kept(state)?.size_in_bytes()?;
        Ok(())
    }

    /// Writes a snapshot as bytes; what is left of them becomes zero.
    fn fmi2SerializeFMUstate(
        component, state: *mut c_void, bytes: *mut c_char, size: usize
    ) {
        let _ = &component;
        let written = kept(state)?.to_bytes()?;
        let needed = written.len();
        if size < needed {
            return Err(Fault::Room { size, needed });
        }
        let bytes = write("serializedState", bytes.cast::<u8>(), size)?;
        let (room, beyond) = bytes.split_at_mut(needed);
        room.copy_from_slice(&written);
        beyond.fill(0);
        Ok(())
    }

    /// Makes a snapshot of bytes. The pointer's old content is not looked at.
    fn fmi2DeSerializeFMUstate(
        component, bytes: *const c_char, size: usize, state: *mut *mut c_void
    ) {
        let _ = &component;
        let state = write_one("FMUstate", state)?;
        let kept = Instance::from_bytes(read("serializedState", bytes.cast::<u8>(), size)?)?;
        *state = Box::into_raw(Box::new(kept)).cast();
        Ok(())
    }

    /// Derivatives of outputs along a direction of inputs.
    fn fmi2GetDirectionalDerivative(
        component, unknowns: *const c_uint, unknown_count: usize, knowns: *const c_uint,
        known_count: usize, seed: *const f64, sensitivity: *mut f64
    ) {
        let unknowns = read("vUnknown_ref", unknowns, unknown_count)?;
        let knowns = read("vKnown_ref", knowns, known_count)?;
        let seed = read("dvKnown", seed, known_count)?;
        let sensitivity = write("dvUnknown", sensitivity, unknown_count)?;
        component.instance.directional_derivative(unknowns, knowns, seed, sensitivity)
    }

    /// Sets time derivatives of inputs.
    fn fmi2SetRealInputDerivatives(
        component, references: *const c_uint, count: usize, orders: *const c_int,
        values: *const f64
    ) {
        let references = read("vr", references, count)?;
        let orders = read("order", orders, count)?;
        let values = read("value", values, count)?;
        component.instance.set_input_derivatives(references, orders, values)
    }

    /// Reads time derivatives of outputs.
    fn fmi2GetRealOutputDerivatives(
        component, references: *const c_uint, count: usize, orders: *const c_int,
        values: *mut f64
    ) {
        let references = read("vr", references, count)?;
        let orders = read("order", orders, count)?;
        let values = write("value", values, count)?;
        component.instance.get_output_derivatives(references, orders, values)
    }

    /// Carries the motion on by one communication step.
    fn fmi2DoStep(component, point: f64, step: f64, _no_set_state_prior: c_int) {
        let (report, outcome) = component.instance.do_step(point, step)?;
        component.tell(&report);
        outcome
    }

    /// There is never a step to cancel.
    fn fmi2CancelStep(component) {
        let _ = &component;
        Err(Fault::NotPending)
    }

    /// How the last step ended.
    fn fmi2GetStatus(component, kind: c_int, value: *mut c_int) {
        let value = write_one("value", value)?;
        if kind != DO_STEP_STATUS {
            return Err(Fault::StatusKind { kind, wanted: "status" });
        }
        *value = component.instance.last_status() as c_int;
        Ok(())
    }

    /// The time up to which the motion is known.
    fn fmi2GetRealStatus(component, kind: c_int, value: *mut f64) {
        let value = write_one("value", value)?;
        if kind != LAST_SUCCESSFUL_TIME {
            return Err(Fault::StatusKind { kind, wanted: "Real" });
        }
        *value = component.instance.time();
        Ok(())
    }

    /// There is no integer status.
    fn fmi2GetIntegerStatus(component, kind: c_int, value: *mut c_int) {
        let _ = (&component, write_one("value", value)?);
        Err(Fault::StatusKind { kind, wanted: "Integer" })
    }

    /// The unit never ends by itself.
    fn fmi2GetBooleanStatus(component, kind: c_int, value: *mut c_int) {
        let _ = &component;
        let value = write_one("value", value)?;
        if kind != TERMINATED {
            return Err(Fault::StatusKind { kind, wanted: "Boolean" });
        }
        *value = 0;
        Ok(())
    }

    /// There is no pending step to tell of.
    fn fmi2GetStringStatus(component, kind: c_int, value: *mut *const c_char) {
        let _ = &component;
        let value = write_one("value", value)?;
        if kind != PENDING_STATUS {
            return Err(Fault::StatusKind { kind, wanted: "String" });
        }
        *value = c"".as_ptr();
        Err(Fault::NotPending)
    }
}
