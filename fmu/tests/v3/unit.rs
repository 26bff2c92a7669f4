//! An importer of FMI 3.0 in a few lines: it calls the C functions and keeps the log.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

use softstop_fmi::variable::Kind;
use softstop_fmi3::*;
use softstop_fmu::{Imprint, Options, Standard, guid_of, table};

use crate::common::OK;

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
        let log = Box::into_raw(Box::<Vec<String>>::default());
        let token = token(options);
        let (name, nothing) = (c"unit".as_ptr(), ptr::null());
        let (event_mode, early) = (u8::from(handling.0), u8::from(handling.1));
        // SAFETY: strings outlive the call, the log the instance.
        let instance = unsafe {
            fmi3InstantiateCoSimulation(
                name,
                token.as_ptr(),
                nothing,
                0,
                0,
                event_mode,
                early,
                ptr::null(),
                0,
                log.cast(),
                Some(log_message),
                update,
            )
        };
        assert!(!instance.is_null());
        Self {
            instance,
            handling,
            is_for_exchange: false,
            log,
        }
    }

    /// An instance for model exchange, of an FMU that tells of more.
    pub fn for_exchange(options: Options) -> Self {
        let log = Box::into_raw(Box::<Vec<String>>::default());
        let token = token(options);
        let (name, token, nothing) = (c"unit".as_ptr(), token.as_ptr(), ptr::null());
        // SAFETY: strings outlive the call, the log the instance.
        let instance = unsafe {
            fmi3InstantiateModelExchange(name, token, nothing, 0, 0, log.cast(), Some(log_message))
        };
        assert!(!instance.is_null());
        Self {
            instance,
            handling: (true, false),
            is_for_exchange: true,
            log,
        }
    }

    /// Sets these values and leaves initialisation at time 0.
    pub fn initialize(&self, values: &[(&str, f64)]) {
        for (name, value) in values {
            assert_eq!(self.set(name, *value), OK, "{name}: {:?}", self.take_log());
        }
        // SAFETY: the instance is alive.
        unsafe {
            let entered = fmi3EnterInitializationMode(self.instance, 0, 0.0, 0.0, 0, 0.0);
            assert_eq!(entered, OK);
            assert_eq!(fmi3ExitInitializationMode(self.instance), OK);
        }
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
        let variable = table().by_name(name).expect("a variable");
        let (reference, instance) = (&raw const variable.reference, self.instance);
        // SAFETY: one reference and one value.
        unsafe {
            match variable.kind {
                Kind::Real(_) => fmi3SetFloat64(instance, reference, 1, &raw const value, 1),
                Kind::Count { .. } => fmi3SetInt32(instance, reference, 1, &(value as i32), 1),
                Kind::Enumeration(_) => fmi3SetInt64(instance, reference, 1, &(value as i64), 1),
                Kind::Boolean => fmi3SetBoolean(instance, reference, 1, &u8::from(value != 0.0), 1),
            }
        }
    }

    pub fn get(&self, name: &str) -> f64 {
        let variable = table().by_name(name).expect("a variable");
        let (status, value) = self.read(&variable.kind, variable.reference);
        assert_eq!(status, OK, "{name}: {:?}", self.take_log());
        value
    }

    /// Status and value of a variable of this kind.
    pub fn read(&self, kind: &Kind, reference: u32) -> (c_int, f64) {
        let (reference, instance) = (&raw const reference, self.instance);
        let (mut real, mut count, mut item, mut truth) = (f64::NAN, 0, 0, 0);
        // SAFETY: one reference and one value.
        unsafe {
            match kind {
                Kind::Real(_) => {
                    let status = fmi3GetFloat64(instance, reference, 1, &raw mut real, 1);
                    (status, real)
                }
                Kind::Count { .. } => {
                    let status = fmi3GetInt32(instance, reference, 1, &raw mut count, 1);
                    (status, count.into())
                }
                Kind::Enumeration(_) => {
                    let status = fmi3GetInt64(instance, reference, 1, &raw mut item, 1);
                    (status, item as f64)
                }
                Kind::Boolean => {
                    let status = fmi3GetBoolean(instance, reference, 1, &raw mut truth, 1);
                    (status, truth.into())
                }
            }
        }
    }

    /// The bits of everything that can be read, but for arrays.
    pub fn everything(&self) -> Vec<(c_int, u64)> {
        let scalars = table().rows().filter(|row| row.element().is_none());
        let read = scalars.map(|variable| {
            let (status, value) = self.read(&variable.kind, variable.reference);
            (status, value.to_bits())
        });
        read.collect()
    }

    /// Status and value of the clock of impacts.
    pub fn try_clock(&self) -> (c_int, bool) {
        let mut ticks = 7;
        // SAFETY: one reference and one value.
        let status = unsafe { fmi3GetClock(self.instance, &CLOCK, 1, &raw mut ticks) };
        assert!(status != OK || ticks <= 1);
        (status, ticks == 1)
    }

    pub fn ticks(&self) -> bool {
        let (status, ticks) = self.try_clock();
        assert_eq!(status, OK, "{:?}", self.take_log());
        ticks
    }

    /// Status and ending of a step.
    pub fn try_step(&self, point: f64, size: f64) -> (c_int, Ending) {
        let (mut event, mut end, mut early, mut time) = (7, 7, 7, f64::NAN);
        // SAFETY: places for the answers.
        let status = unsafe {
            let places = (&raw mut event, &raw mut end, &raw mut early);
            let time = &raw mut time;
            fmi3DoStep(
                self.instance,
                point,
                size,
                1,
                places.0,
                places.1,
                places.2,
                time,
            )
        };
        let ending = Ending {
            event: event == 1,
            early: early == 1,
            time,
        };
        (status, ending)
    }

    pub fn step(&self, point: f64, size: f64) -> Ending {
        let (status, ending) = self.try_step(point, size);
        assert_eq!(status, OK, "{:?}", self.take_log());
        ending
    }

    pub fn enter_event_mode(&self) {
        // SAFETY: the instance is alive.
        assert_eq!(
            unsafe { fmi3EnterEventMode(self.instance) },
            OK,
            "{:?}",
            self.take_log()
        );
    }

    pub fn leave_event_mode(&self) {
        // SAFETY: the instance is alive.
        assert_eq!(
            unsafe { fmi3EnterStepMode(self.instance) },
            OK,
            "{:?}",
            self.take_log()
        );
    }

    /// Lets the event happen; when the next one comes.
    pub fn update(&self) -> Option<f64> {
        let (status, next) = self.try_update();
        assert_eq!(status, OK, "{:?}", self.take_log());
        next
    }

    pub fn try_update(&self) -> (c_int, Option<f64>) {
        let (status, next, _) = self.try_update_states();
        (status, next)
    }

    /// Status, time of the next event, and whether states have changed.
    pub fn try_update_states(&self) -> (c_int, Option<f64>, bool) {
        let (mut flags, mut time) = ([7u8; 5], f64::NAN);
        let [a, b, c, d, defined] = flags.each_mut().map(|flag| &raw mut *flag);
        // SAFETY: places for the answers.
        let status =
            unsafe { fmi3UpdateDiscreteStates(self.instance, a, b, c, d, defined, &raw mut time) };
        assert!(status != OK || flags[..2] == [0; 2]);
        assert!(status != OK || self.is_for_exchange || flags[2..4] == [0; 2]);
        (status, (flags[4] == 1).then_some(time), flags[3] == 1)
    }

    /// Goes to a time in steps of one size, and handles events if there is event mode; what `see` says of each.
    pub fn run(&self, end: f64, size: f64, mut see: impl FnMut(&Self, Ending)) {
        let (mut point, mut number) = (0.0, 1.0);
        while point < end {
            let aim = (number * size).min(end);
            let ending = self.step(point, aim - point);
            if ending.early {
                point = ending.time;
            } else {
                (point, number) = (aim, number + 1.0);
            }
            if ending.event {
                self.enter_event_mode();
                see(self, ending);
                self.update();
                self.leave_event_mode();
            }
            if ending.event || ending.early {
                see(self, ending);
            }
        }
    }

    /// Derivatives of outputs along a direction.
    pub fn directional(&self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Vec<f64> {
        let mut values = vec![f64::NAN; unknowns.len()];
        // SAFETY: arrays as long as is said.
        let status = unsafe {
            fmi3GetDirectionalDerivative(
                self.instance,
                unknowns.as_ptr(),
                unknowns.len(),
                knowns.as_ptr(),
                knowns.len(),
                seed.as_ptr(),
                seed.len(),
                values.as_mut_ptr(),
                values.len(),
            )
        };
        assert_eq!(status, OK, "{:?}", self.take_log());
        values
    }

    /// Derivatives of a weighted sum of outputs.
    pub fn adjoint(&self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Vec<f64> {
        self.adjoint_of(unknowns, knowns, seed, knowns.len())
    }

    /// Derivatives of a weighted sum of outputs by knowns that have so many elements.
    pub fn adjoint_of(
        &self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        count: usize,
    ) -> Vec<f64> {
        let mut values = vec![f64::NAN; count];
        // SAFETY: arrays as long as is said.
        let status = unsafe {
            fmi3GetAdjointDerivative(
                self.instance,
                unknowns.as_ptr(),
                unknowns.len(),
                knowns.as_ptr(),
                knowns.len(),
                seed.as_ptr(),
                seed.len(),
                values.as_mut_ptr(),
                values.len(),
            )
        };
        assert_eq!(status, OK, "{:?}", self.take_log());
        values
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

/// The token of an FMU with this library.
fn token(options: Options) -> CString {
    let imprint = Imprint::library().with_standard(Standard::Fmi3);
    let token = guid_of(&imprint.with_options(options)).expect("a token");
    CString::new(token).expect("no NUL")
}

/// The value reference of a variable.
pub fn reference(name: &str) -> u32 {
    table().by_name(name).expect("a variable").reference
}
