//! What an importer agrees on with an instance by FMI 3.0.

use std::ffi::CString;

use libc::{c_char, c_int, c_void};

use crate::abi::component::{Component, Importer, IntermediateUpdate, Sink};
use crate::fault::Fault;
use crate::options::Options;
use crate::standard::Standard;
use crate::unit::Unit;

/// `fmi3LogMessageCallback`: environment, status, category, message.
pub type LogMessageCallback =
    Option<unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char)>;
/// `fmi3IntermediateUpdateCallback`, if there is one.
pub type IntermediateUpdateCallback = Option<IntermediateUpdate>;
/// `fmi3ClockUpdateCallback`, of scheduled execution.
pub type ClockUpdateCallback = Option<unsafe extern "C" fn(*mut c_void)>;
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`, of scheduled execution.
pub type PreemptionCallback = Option<unsafe extern "C" fn()>;

/// The importer's logger, which may be missing.
pub(super) fn sink(environment: *mut c_void, log: LogMessageCallback) -> Sink {
    let Some(log) = log else {
        return Box::new(|_, _, _| {});
    };
    Box::new(move |status, category, text| {
        // By the standard a single # begins a value reference.
        let text = text.to_string_lossy().replace('#', "##");
        let text = CString::new(text).unwrap_or_default();
        // SAFETY: the importer's function, called as the standard says; both strings outlive it.
        unsafe {
            log(
                environment,
                status as c_int,
                category.as_ptr(),
                text.as_ptr(),
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
    token: *const c_char,
    logging_on: bool,
    importer: Importer,
    sink: Sink,
) -> Option<Box<Component<U>>> {
    let call = match importer.integrates {
        true => "fmi3InstantiateModelExchange",
        false => "fmi3InstantiateCoSimulation",
    };
    let standard = Standard::Fmi3;
    let importer = Importer {
        standard,
        ..importer
    };
    let check = |options| check_interface::<U>(importer, options?);
    let token = ("instantiationToken", token);
    // SAFETY: by this function's contract.
    unsafe { Component::instantiate(call, name, token, logging_on, importer, sink, check) }
}

fn check_interface<U: Unit>(importer: Importer, options: Options) -> Result<Options, Fault> {
    if importer.handling.in_event_mode && !U::HAS_EVENTS {
        let text = "eventModeUsed is true, hasEventMode is false".to_owned();
        return Err(Fault::Instantiation(text));
    }
    match importer.integrates && U::about().state_space.is_none() {
        true => Err(Fault::NotOffered("the unit is for co-simulation only")),
        false => Ok(options),
    }
}
