//! What the importer's handle points to: an instance and the way to the importer's log.

use std::borrow::Cow;
use std::ffi::CString;

use libc::{c_char, c_int, c_void, size_t};

use super::pointers::string;
use crate::fault::{Fault, Status};
use crate::guid::library_uuid;
use crate::instance::Instance;
use crate::log::{Category, Wanted};
use crate::step::StepReport;
use crate::unit::Unit;

/// `fmi2CoSimulation` of `fmi2Type`.
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

/// The importer's end of the log.
struct Sink {
    name: CString,
    logger: Option<Logger>,
    environment: *mut c_void,
}

/// An instance with its log.
pub(super) struct Component<U: Unit> {
    pub(super) instance: Instance<U>,
    pub(super) wanted: Wanted,
    logging_on: bool,
    sink: Sink,
}

impl Sink {
    fn send(&self, status: Status, category: Category, text: &str) {
        let Some(logger) = self.logger else {
            return;
        };
        let c_string = |text: &str| CString::new(text.replace('\0', " ")).unwrap_or_default();
        let (category, text) = (c_string(category.name()), c_string(text));
        // SAFETY: the importer's function, called as the standard says; all strings outlive it.
        unsafe {
            logger(
                self.environment,
                self.name.as_ptr(),
                status as c_int,
                category.as_ptr(),
                c"%s".as_ptr(),
                text.as_ptr(),
            );
        }
    }
}

impl<U: Unit> Component<U> {
    /// Sends one line, if lines of its category are wanted.
    pub(super) fn log(&self, status: Status, category: Category, text: &str) {
        if self.wanted.has(category) {
            self.sink.send(status, category, text);
        }
    }

    /// Tells of the events in a step, and of a gap before it.
    pub(super) fn tell(&self, report: &StepReport) {
        if let Some(gap) = report.gap {
            let text = format!(
                "currentCommunicationPoint lies {gap:e} s from the end of the last step: the motion goes on \
                 without a gap"
            );
            self.log(Status::Ok, Category::Warnings, &text);
        }
        for event in &report.events.lines {
            self.log(Status::Ok, Category::Events, event);
        }
    }

    /// Everything as after instantiation, the log included.
    pub(super) fn reset(&mut self) {
        self.instance = Instance::new();
        self.wanted = Wanted::all(self.logging_on);
    }
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
    // SAFETY: by this function's contract.
    let (functions, name, guid) = unsafe {
        (
            functions.as_ref(),
            string("instanceName", name),
            string("fmuGUID", guid),
        )
    };
    let sink = Sink {
        name: CString::new(name.as_deref().unwrap_or_default()).unwrap_or_default(),
        logger: functions.and_then(|functions| functions.logger),
        environment: functions.map_or(std::ptr::null_mut(), |functions| functions.environment),
    };
    match check::<U>(name, fmu_type, guid) {
        Ok(()) => Some(Box::new(Component {
            instance: Instance::new(),
            wanted: Wanted::all(logging_on),
            logging_on,
            sink,
        })),
        Err(fault) => {
            let text = format!("fmi2Instantiate: {fault}");
            sink.send(Status::Error, Category::Errors, &text);
            None
        }
    }
}

fn check<U: Unit>(
    name: Result<Cow<str>, Fault>,
    fmu_type: c_int,
    guid: Result<Cow<str>, Fault>,
) -> Result<(), Fault> {
    if name?.is_empty() {
        return Err(Fault::Instantiation("instanceName is empty".to_owned()));
    }
    if fmu_type != CO_SIMULATION {
        return Err(Fault::Instantiation(format!(
            "fmuType = {fmu_type}: only fmi2CoSimulation ({CO_SIMULATION}) is available"
        )));
    }
    let own = library_uuid::<U>()?.braced().to_string();
    let guid = guid?;
    if guid == own {
        Ok(())
    } else {
        Err(Fault::Instantiation(format!(
            "fmuGUID is {guid:?}, this library's is {own:?}"
        )))
    }
}
