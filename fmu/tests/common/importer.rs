//! An importer in a few lines: it calls the C functions and keeps the log.
#![allow(unsafe_code, reason = "calls the C functions as an importer does")]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use softstop_fmi::Row;
use softstop_fmi::variable::Kind;
use softstop_fmi2::*;
use softstop_fmu::{Machine, library_guid, table};

pub const OK: c_int = 0;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

/// What may come of a call.
pub type Statuses = &'static [c_int];

/// A call is carried out if all of these hold, else refused.
pub fn if_all(conditions: &[bool]) -> Statuses {
    match conditions.iter().all(|holds| *holds) {
        true => &[OK],
        false => &[ERROR],
    }
}

/// Name and status of a C call.
macro_rules! call {
    ($function:ident($($argument:expr),* $(,)?)) => {
        (stringify!($function), $function($($argument),*))
    };
}
pub(crate) use call;

/// All real outputs.
pub const OUTPUTS: [&str; 9] = [
    "position",
    "velocity",
    "acceleration",
    "contact.force",
    "energy.mechanical",
    "energy.supplied",
    "energy.dissipated",
    "impact.time",
    "impact.velocity",
];

/// The log of one instance: its environment pointer leads here.
#[derive(Default)]
pub struct Log {
    pub lines: Vec<String>,
}

// Takes one argument after the format where C takes any number; the library passes exactly one.
unsafe extern "C" fn logger(
    environment: *mut c_void,
    _name: *const c_char,
    status: c_int,
    category: *const c_char,
    format: *const c_char,
    text: *const c_char,
) {
    unsafe {
        assert_eq!(CStr::from_ptr(format), c"%s");
        let category = CStr::from_ptr(category).to_string_lossy();
        let text = CStr::from_ptr(text).to_string_lossy();
        let log = &mut *environment.cast::<Log>();
        log.lines.push(format!("{status} {category} {text}"));
    }
}

/// Callbacks that keep the log there.
pub fn callbacks(log: *mut Log) -> CallbackFunctions {
    CallbackFunctions {
        // On the platforms these tests run on, a variadic call with one pointer more looks
        // like a call with that pointer as the last argument.
        logger: Some(unsafe { std::mem::transmute::<*const (), Logger>(logger as *const ()) }),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        environment: log.cast(),
    }
}

/// The arguments of `fmi2Instantiate`.
#[derive(Debug, Clone)]
pub struct InstantiateArguments {
    pub name: Option<&'static CStr>,
    pub kind: c_int,
    pub guid: Option<String>,
    pub has_callbacks: bool,
    pub has_logger: bool,
    pub logging_on: bool,
}

impl InstantiateArguments {
    pub fn plain() -> Self {
        Self {
            name: Some(c"unit"),
            kind: 1,
            guid: Some(library_guid()),
            has_callbacks: true,
            has_logger: true,
            logging_on: false,
        }
    }
}

/// An instance of the unit, made and freed through the C functions.
pub struct Unit {
    pub component: *mut c_void,
    log: *mut Log,
}

impl Unit {
    pub fn new() -> Self {
        Self::instantiate(&InstantiateArguments::plain()).expect("an instance")
    }

    /// The instance, or the log of its refusal.
    pub fn instantiate(arguments: &InstantiateArguments) -> Result<Self, Vec<String>> {
        let log = Box::into_raw(Box::<Log>::default());
        let name = arguments.name.map_or(ptr::null(), CStr::as_ptr);
        let guid = arguments.guid.as_deref();
        let guid = guid.map(|guid| CString::new(guid).expect("no NUL"));
        let guid = guid.as_ref().map_or(ptr::null(), |guid| guid.as_ptr());
        let mut functions = callbacks(log);
        functions.logger = functions.logger.filter(|_| arguments.has_logger);
        let functions = match arguments.has_callbacks {
            true => &raw const functions,
            false => ptr::null(),
        };
        let (kind, logging_on) = (arguments.kind, arguments.logging_on.into());
        let component =
            unsafe { fmi2Instantiate(name, kind, guid, ptr::null(), functions, 0, logging_on) };
        let unit = Self { component, log };
        if component.is_null() {
            Err(unit.take_log())
        } else {
            Ok(unit)
        }
    }

    /// The log since it was last taken.
    pub fn take_log(&self) -> Vec<String> {
        std::mem::take(unsafe { &mut (*self.log).lines })
    }

    /// Asserts that a call was refused with one line that has all these words.
    pub fn refused(&self, status: c_int, words: &[&str]) {
        let lines = self.take_log();
        assert_eq!(status, ERROR, "{words:?}: {lines:?}");
        assert_eq!(lines.len(), 1, "{words:?}: {lines:?}");
        assert!(lines[0].starts_with("3 errors fmi2"), "{lines:?}");
        for word in words {
            assert!(lines[0].contains(word), "{lines:?} lacks {word:?}");
        }
    }

    pub fn begin(&self) {
        assert_eq!(self.try_to_begin(), OK);
    }

    /// Leads into initialisation.
    pub fn enter(&self, start: f64) {
        unsafe {
            let setup = fmi2SetupExperiment(self.component, 0, 0.0, start, 0, 0.0);
            assert_eq!(setup, OK);
            assert_eq!(fmi2EnterInitializationMode(self.component), OK);
        }
    }

    /// Leads through initialisation; returns the status of its end.
    pub fn try_to_begin(&self) -> c_int {
        self.enter(0.0);
        self.leave()
    }

    /// Leaves initialisation.
    pub fn leave(&self) -> c_int {
        unsafe { fmi2ExitInitializationMode(self.component) }
    }

    pub fn set(&self, name: &str, value: f64) -> c_int {
        let variable = variable(name);
        let (component, of, number) = (
            self.component,
            &raw const variable.reference,
            value as c_int,
        );
        unsafe {
            match variable.kind {
                Kind::Real(_) => fmi2SetReal(component, of, 1, &raw const value),
                Kind::Boolean => fmi2SetBoolean(component, of, 1, &raw const number),
                _ => fmi2SetInteger(component, of, 1, &raw const number),
            }
        }
    }

    pub fn set_all(&self, values: &[(&str, f64)]) {
        for (name, value) in values {
            let status = self.set(name, *value);
            assert_eq!(status, OK, "{name}: {:?}", self.take_log());
        }
    }

    /// Sets a derivative of an input.
    pub fn slope(&self, name: &str, order: c_int, value: f64) -> c_int {
        let (reference, component) = (reference(name), self.component);
        let (order, value) = (&raw const order, &raw const value);
        unsafe { fmi2SetRealInputDerivatives(component, &raw const reference, 1, order, value) }
    }

    /// Asks for log lines of a category.
    pub fn listen(&self, category: &str) -> c_int {
        let category = CString::new(category).expect("no NUL");
        let name = category.as_ptr();
        unsafe { fmi2SetDebugLogging(self.component, 1, 1, &raw const name) }
    }

    pub fn last_successful_time(&self) -> f64 {
        let mut time = f64::NAN;
        let status = unsafe { fmi2GetRealStatus(self.component, 2, &raw mut time) };
        assert_eq!(status, OK);
        time
    }

    pub fn step_status(&self) -> c_int {
        let mut status = -1;
        let asked = unsafe { fmi2GetStatus(self.component, 0, &raw mut status) };
        assert_eq!(asked, OK);
        status
    }

    pub fn get(&self, name: &str) -> f64 {
        let variable = variable(name);
        let (component, of) = (self.component, &raw const variable.reference);
        let (mut real, mut number) = (f64::NAN, -1);
        let (status, value) = unsafe {
            match variable.kind {
                Kind::Real(_) => (fmi2GetReal(component, of, 1, &raw mut real), real),
                Kind::Boolean => (
                    fmi2GetBoolean(component, of, 1, &raw mut number),
                    number.into(),
                ),
                _ => (
                    fmi2GetInteger(component, of, 1, &raw mut number),
                    number.into(),
                ),
            }
        };
        assert_eq!(status, OK, "{name}: {:?}", self.take_log());
        value
    }

    /// The derivatives of real outputs along a direction.
    pub fn derivatives(
        &self,
        unknowns: &[&str],
        knowns: &[(&str, f64)],
    ) -> Result<Vec<f64>, c_int> {
        let of: Vec<_> = unknowns.iter().map(|name| reference(name)).collect();
        let by: Vec<_> = knowns.iter().map(|(name, _)| reference(name)).collect();
        let seed: Vec<_> = knowns.iter().map(|(_, seed)| *seed).collect();
        let mut values = vec![f64::NAN; of.len()];
        let status = unsafe {
            fmi2GetDirectionalDerivative(
                self.component,
                of.as_ptr(),
                of.len(),
                by.as_ptr(),
                by.len(),
                seed.as_ptr(),
                values.as_mut_ptr(),
            )
        };
        if status == OK {
            Ok(values)
        } else {
            Err(status)
        }
    }

    pub fn step(&self, point: f64, step: f64) -> c_int {
        unsafe { fmi2DoStep(self.component, point, step, 1) }
    }

    pub fn reset(&self) -> c_int {
        unsafe { fmi2Reset(self.component) }
    }

    /// Its state, to be freed.
    pub fn keep(&self) -> *mut c_void {
        let mut state = ptr::null_mut();
        let status = unsafe { fmi2GetFMUstate(self.component, &raw mut state) };
        assert_eq!(status, OK);
        state
    }

    pub fn free(&self, mut state: *mut c_void) {
        let status = unsafe { fmi2FreeFMUstate(self.component, &raw mut state) };
        assert_eq!(status, OK);
    }

    /// Its state as bytes.
    pub fn serialized(&self) -> Vec<u8> {
        let state = self.keep();
        let bytes = self.bytes_of(state);
        self.free(state);
        bytes
    }

    pub fn bytes_of(&self, state: *mut c_void) -> Vec<u8> {
        let (component, mut size) = (self.component, 0);
        unsafe {
            let status = fmi2SerializedFMUstateSize(component, state, &raw mut size);
            assert_eq!(status, OK);
            let mut bytes = vec![0xAAu8; size];
            let status = fmi2SerializeFMUstate(component, state, bytes.as_mut_ptr().cast(), size);
            assert_eq!(status, OK);
            bytes
        }
    }

    /// Goes on from a state that was written as bytes, if they are accepted.
    pub fn take_up(&self, bytes: &[u8]) -> c_int {
        let mut state = ptr::null_mut();
        let place = bytes.as_ptr().cast::<c_char>();
        unsafe {
            let status =
                fmi2DeSerializeFMUstate(self.component, place, bytes.len(), &raw mut state);
            if status == OK {
                assert_eq!(fmi2SetFMUstate(self.component, state), OK);
                self.free(state);
            } else {
                assert!(state.is_null());
            }
            status
        }
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        unsafe {
            fmi2FreeInstance(self.component);
            drop(Box::from_raw(self.log));
        }
    }
}

/// Makes a state one of another FMU, or one of this FMU again: its GUID begins there.
pub fn switch_guid(state: *mut c_void) {
    unsafe { *state.cast::<u8>().add(8) ^= 1 };
}

pub fn variable(name: &str) -> &'static Row<Machine> {
    table().by_name(name).expect("a variable")
}

pub fn reference(name: &str) -> u32 {
    variable(name).reference
}
