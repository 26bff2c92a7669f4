//! An importer of FMI 3.0 in a few lines: it calls the C functions and keeps the log.

mod derivatives;
mod stepping;

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;
use std::sync::OnceLock;

use softstop_fmi::Row;
use softstop_fmi::variable::Kind;
use softstop_fmi3::*;
use softstop_fmu::{Imprint, Machine, Options, Standard, guid_of, table};

use crate::common::{OK, variable};

unsafe extern "C" fn log_message(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    text: *const c_char,
) {
    // SAFETY: the strings of the library, and the environment that was handed to it.
    unsafe {
        let [category, text] = [category, text].map(|text| CStr::from_ptr(text).to_string_lossy());
        (*environment.cast::<Vec<String>>()).push(format!("{status} {category} {text}"));
    }
}

/// What an importer can do with events: whether it handles them, and whether a step may end early.
pub type Handling = (bool, bool);

pub const HANDLINGS: [Handling; 4] = [(false, false), (false, true), (true, false), (true, true)];

/// The value reference of the clock of impacts.
pub const CLOCK: u32 = 250;

/// How a step ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ending {
    pub event: bool,
    pub early: bool,
    pub time: f64,
}

/// An instance of the unit.
pub struct Unit {
    pub instance: *mut c_void,
    pub handling: Handling,
    /// The importer integrates.
    pub is_for_exchange: bool,
    log: *mut Vec<String>,
}

impl Unit {
    pub fn new(handling: Handling) -> Self {
        Self::made(handling, None, Options::default())
    }

    /// An instance with a callback for intermediate update, of an FMU that tells of more.
    pub fn made(handling: Handling, update: IntermediateUpdateCallback, options: Options) -> Self {
        let (log, token) = (Box::into_raw(Box::<Vec<String>>::default()), token(options));
        let (name, token, nothing) = (c"unit".as_ptr(), token.as_ptr(), ptr::null());
        let (event_mode, early) = (handling.0.into(), handling.1.into());
        let (environment, none) = (log.cast(), ptr::null());
        // SAFETY: strings outlive the call, the log the instance.
        let instance = unsafe {
            fmi3InstantiateCoSimulation(
                name,
                token,
                nothing,
                0,
                0,
                event_mode,
                early,
                none,
                0,
                environment,
                Some(log_message),
                update,
            )
        };
        Self::of(instance, handling, false, log)
    }

    /// An instance for model exchange, of an FMU that tells of more.
    pub fn for_exchange(options: Options) -> Self {
        let (log, token) = (Box::into_raw(Box::<Vec<String>>::default()), token(options));
        let (name, token, nothing) = (c"unit".as_ptr(), token.as_ptr(), ptr::null());
        // SAFETY: strings outlive the call, the log the instance.
        let instance = unsafe {
            fmi3InstantiateModelExchange(name, token, nothing, 0, 0, log.cast(), Some(log_message))
        };
        Self::of(instance, (true, false), true, log)
    }

    fn of(
        instance: *mut c_void,
        handling: Handling,
        is_for_exchange: bool,
        log: *mut Vec<String>,
    ) -> Self {
        assert!(!instance.is_null());
        Self {
            instance,
            handling,
            is_for_exchange,
            log,
        }
    }

    /// Asserts that a call was carried out.
    pub fn check(&self, status: c_int) {
        assert_eq!(status, OK, "{:?}", self.take_log());
    }

    /// Sets these values and leaves initialisation at time 0.
    pub fn initialize(&self, values: &[(&str, f64)]) {
        for (name, value) in values {
            self.check(self.set(name, *value));
        }
        self.enter();
        self.exit();
    }

    /// Enters initialisation at time 0.
    pub fn enter(&self) {
        // SAFETY: the instance is alive.
        self.check(unsafe { fmi3EnterInitializationMode(self.instance, 0, 0.0, 0.0, 0, 0.0) });
    }

    /// Leaves initialisation.
    pub fn exit(&self) {
        // SAFETY: the instance is alive.
        self.check(unsafe { fmi3ExitInitializationMode(self.instance) });
    }

    /// An instance in step mode at time 0 under these values.
    pub fn begun(handling: Handling, values: &[(&str, f64)]) -> Self {
        Self::new(handling).begin(values)
    }

    /// Goes to step mode at time 0 under these values.
    pub fn begin(self, values: &[(&str, f64)]) -> Self {
        self.initialize(values);
        if self.handling.0 {
            self.update();
            self.leave_event_mode();
        }
        self
    }

    /// The log since it was last taken.
    pub fn take_log(&self) -> Vec<String> {
        // SAFETY: nothing else holds the log now.
        std::mem::take(unsafe { &mut *self.log })
    }

    pub fn set(&self, name: &str, value: f64) -> c_int {
        let row = variable(name);
        let (reference, instance) = (&raw const row.reference, self.instance);
        // SAFETY: one reference and one value.
        unsafe {
            match row.kind {
                Kind::Real(_) => fmi3SetFloat64(instance, reference, 1, &raw const value, 1),
                Kind::Count { .. } => fmi3SetInt32(instance, reference, 1, &(value as i32), 1),
                Kind::Enumeration(_) => fmi3SetInt64(instance, reference, 1, &(value as i64), 1),
                Kind::Boolean => fmi3SetBoolean(instance, reference, 1, &(value != 0.0).into(), 1),
            }
        }
    }

    pub fn get(&self, name: &str) -> f64 {
        let (status, value) = self.read(variable(name));
        self.check(status);
        value
    }

    /// Status and value of a variable.
    pub fn read(&self, row: &Row<Machine>) -> (c_int, f64) {
        let (of, instance) = (&raw const row.reference, self.instance);
        let (mut real, mut count, mut item, mut truth) = (f64::NAN, 0, 0, 0);
        // SAFETY: one reference and one value.
        let status = unsafe {
            match row.kind {
                Kind::Real(_) => return (fmi3GetFloat64(instance, of, 1, &raw mut real, 1), real),
                Kind::Count { .. } => fmi3GetInt32(instance, of, 1, &raw mut count, 1),
                Kind::Enumeration(_) => fmi3GetInt64(instance, of, 1, &raw mut item, 1),
                Kind::Boolean => fmi3GetBoolean(instance, of, 1, &raw mut truth, 1),
            }
        };
        // Only one of them was read.
        (status, f64::from(count) + item as f64 + f64::from(truth))
    }

    /// Values of real variables.
    pub fn reals(&self, references: &[u32]) -> Vec<f64> {
        let (of, count) = (references.as_ptr(), references.len());
        let mut values = vec![f64::NAN; count];
        // SAFETY: arrays as long as is said.
        self.check(unsafe { fmi3GetFloat64(self.instance, of, count, values.as_mut_ptr(), count) });
        values
    }

    /// Its state, to be freed.
    pub fn keep(&self) -> *mut c_void {
        let mut state = ptr::null_mut();
        // SAFETY: a place for a state.
        self.check(unsafe { fmi3GetFMUState(self.instance, &raw mut state) });
        state
    }

    pub fn go_back(&self, state: *mut c_void) {
        // SAFETY: the state is alive.
        self.check(unsafe { fmi3SetFMUState(self.instance, state) });
    }

    pub fn free(&self, mut state: *mut c_void) {
        // SAFETY: the state is alive.
        self.check(unsafe { fmi3FreeFMUState(self.instance, &raw mut state) });
        assert!(state.is_null());
    }

    /// A state as bytes.
    pub fn bytes_of(&self, state: *mut c_void) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: the state is alive, a place as long as is said.
        unsafe {
            self.check(fmi3SerializedFMUStateSize(
                self.instance,
                state,
                &raw mut size,
            ));
            let mut bytes = vec![0; size];
            self.check(fmi3SerializeFMUState(
                self.instance,
                state,
                bytes.as_mut_ptr(),
                size,
            ));
            bytes
        }
    }

    /// Status and state of bytes.
    pub fn try_state_of(&self, bytes: &[u8]) -> (c_int, *mut c_void) {
        let (of, count, mut state) = (bytes.as_ptr(), bytes.len(), ptr::null_mut());
        // SAFETY: a place for a state.
        let status = unsafe { fmi3DeserializeFMUState(self.instance, of, count, &raw mut state) };
        (status, state)
    }

    /// Goes on from the state of another instance, by way of bytes.
    pub fn take_up(&self, other: &Self) {
        let kept = other.keep();
        let (status, state) = self.try_state_of(&other.bytes_of(kept));
        self.check(status);
        self.go_back(state);
        self.free(state);
        other.free(kept);
    }

    /// The bits of everything that can be read, but for arrays.
    pub fn everything(&self) -> Vec<(c_int, u64)> {
        let scalars = table().rows().filter(|row| row.element().is_none());
        let read = scalars.map(|row| {
            let (status, value) = self.read(row);
            (status, value.to_bits())
        });
        read.collect()
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: made above and freed once.
        unsafe {
            fmi3FreeInstance(self.instance);
            drop(Box::from_raw(self.log));
        }
    }
}

/// The token of an FMU with this library, which takes a while to compute.
fn token(options: Options) -> &'static CStr {
    static TOKENS: [OnceLock<CString>; 4] = [const { OnceLock::new() }; 4];
    let number = usize::from(options.clock) + 2 * usize::from(options.arrays);
    TOKENS[number].get_or_init(|| {
        let imprint = Imprint::library().with_standard(Standard::Fmi3);
        let token = guid_of(&imprint.with_options(options));
        CString::new(token).expect("no NUL")
    })
}
