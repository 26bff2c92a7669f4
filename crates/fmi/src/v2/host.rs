//! What an importer agrees on with an instance by FMI 2.0: callbacks, and what it is told of the last step.

use std::ffi::CString;

use libc::{c_char, c_int, c_void, size_t};

use crate::abi::component::{Component, Importer, Sink};
use crate::abi::pointers::{string, write_one};
use crate::fault::Fault;
use crate::options::Options;
use crate::unit::Unit;

/// `fmi2ModelExchange` and `fmi2CoSimulation` of `fmi2Type`.
const MODEL_EXCHANGE: c_int = 0;
const CO_SIMULATION: c_int = 1;

/// `fmi2CallbackLogger`: environment, instance name, status, category, format, arguments.
pub type Logger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

/// `fmi2CallbackFunctions`. Only the logger is used.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct CallbackFunctions {
    /// Takes log lines.
    pub logger: Option<Logger>,
    /// Not used.
    pub allocate_memory: Option<unsafe extern "C" fn(size_t, size_t) -> *mut c_void>,
    /// Not used.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Not used: a step always completes.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    /// Handed back to the logger.
    pub environment: *mut c_void,
}

/// `fmi2EventInfo`.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct EventInfo {
    /// Another iteration is needed.
    pub new_discrete_states_needed: c_int,
    /// The unit asks to end the simulation.
    pub terminate_simulation: c_int,
    /// What is much of a state has changed.
    pub nominals_of_continuous_states_changed: c_int,
    /// States have changed.
    pub values_of_continuous_states_changed: c_int,
    /// There is a next event.
    pub next_event_time_defined: c_int,
    /// When it comes, in s.
    pub next_event_time: f64,
}

/// The importer's logger; its callbacks may be missing.
fn sink(name: CString, functions: Option<&CallbackFunctions>) -> Sink {
    let Some((logger, environment)) =
        functions.and_then(|functions| Some((functions.logger?, functions.environment)))
    else {
        return Box::new(|_, _, _| {});
    };
    Box::new(move |status, category, text| {
        let (name, category, text) = (name.as_ptr(), category.as_ptr(), text.as_ptr());
        // SAFETY: the importer's function, called as the standard says; all strings outlive it.
        unsafe {
            logger(
                environment,
                name,
                status as c_int,
                category,
                c"%s".as_ptr(),
                text,
            )
        };
    })
}

/// Makes an instance, or sends one line that says why not.
///
/// # Safety
/// Pointers other than NULL must point to what the standard says.
pub(super) unsafe fn instantiate<U: Unit>(
    name: *const c_char,
    fmu_type: c_int,
    guid: *const c_char,
    functions: *const CallbackFunctions,
    logging_on: bool,
) -> Option<Box<Component<U>>> {
    let importer = Importer {
        integrates: fmu_type == MODEL_EXCHANGE,
        ..Importer::default()
    };
    let check = |options| check_type::<U>(fmu_type, options);
    let guid = ("fmuGUID", guid);
    // SAFETY: by this function's contract.
    unsafe {
        let own = string("instanceName", name).unwrap_or_default();
        let sink = sink(CString::new(&*own).unwrap_or_default(), functions.as_ref());
        Component::instantiate(
            "fmi2Instantiate",
            name,
            guid,
            logging_on,
            importer,
            sink,
            check,
        )
    }
}

/// Model exchange is for FMUs that tell of it, by whose GUID one knows them.
fn check_type<U: Unit>(fmu_type: c_int, options: Result<Options, Fault>) -> Result<Options, Fault> {
    let has_exchange = options.as_ref().is_ok_and(|options| options.exchange);
    match fmu_type {
        CO_SIMULATION => options,
        MODEL_EXCHANGE if has_exchange && U::about().state_space.is_some() => options,
        _ => Err(Fault::Instantiation(format!(
            "fmuType = {fmu_type}: only fmi2CoSimulation ({CO_SIMULATION}) is available"
        ))),
    }
}

/// Answers a question about the last step, if it is of the one kind that has an answer of this type.
///
/// # Safety
/// As [`write_one`].
pub(super) unsafe fn answer<T>(
    wanted: &'static str,
    kind: c_int,
    answered: c_int,
    place: *mut T,
    value: T,
) -> Result<(), Fault> {
    // SAFETY: by this function's contract.
    let place = unsafe { write_one("value", place) }?;
    if kind != answered {
        return Err(Fault::StatusKind { kind, wanted });
    }
    *place = value;
    Ok(())
}
