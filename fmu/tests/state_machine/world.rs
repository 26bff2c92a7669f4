//! Instances and snapshots under random calls, each beside its model and its shadow.
//!
//! The shadow of an instance is another one that is given those calls only which change something and
//! were carried out. In the end both must be the same bit for bit: neither reading nor what was refused
//! nor a way over bytes leaves a trace.

use std::ffi::{CString, c_int, c_void};
use std::ptr;

use softstop_fmi2::*;
use softstop_fmu::library_guid;

use super::calls::{Birth, Call, Point, STATES, UNITS};
use super::model::{Expected, Life, Model};
use super::perform::perform;
use super::probe::{Probe, silent};
use super::slot::Slot;
use crate::common::{ERROR, Log, OK, callbacks};

pub struct Kept {
    pub state: *mut c_void,
    pub shadow: *mut c_void,
    pub model: Model,
    pub unsettled: bool,
}

pub struct World {
    pub units: [Option<Slot>; UNITS],
    pub states: [Option<Kept>; STATES],
    pub probe: Probe,
}

impl World {
    pub fn new() -> Self {
        Self {
            units: std::array::from_fn(|_| None),
            states: std::array::from_fn(|_| None),
            probe: Probe::new(),
        }
    }

    pub fn run(&mut self, index: usize, call: &Call) {
        match call {
            Call::Texts => texts(),
            Call::Instantiate(birth) if index < UNITS => self.instantiate(index, *birth),
            Call::Instantiate(_) => {}
            Call::FreeInstance => self.free(index),
            Call::DoStep(point, size) => self.step(index, *point, *size),
            Call::GetState(..)
            | Call::SetState(_)
            | Call::FreeState(..)
            | Call::SerializedSize(..)
            | Call::Serialize(..)
            | Call::DeSerialize(..) => self.run_on_state(index, call),
            _ => self.run_plain(index, call),
        }
    }

    /// The instance, or NULL.
    pub fn component(&self, index: usize) -> *mut c_void {
        let slot = self.units.get(index).and_then(Option::as_ref);
        slot.map_or(ptr::null_mut(), |slot| slot.component)
    }

    /// Makes a call and judges its status, its log and, if it was refused, what it left behind.
    pub fn judged(
        &mut self,
        index: usize,
        call: &Call,
        expected: Expected,
        action: impl FnOnce(*mut c_void) -> c_int,
    ) -> bool {
        let component = self.component(index);
        if component.is_null() {
            assert_eq!(action(component), ERROR, "{call:?} of no instance");
            return false;
        }
        let before = (expected != Expected::Ok).then(|| self.probe.everything(component));
        let status = action(component);
        let slot = self.units[index].as_ref().expect("an instance");
        slot.check_log(call, status);
        let context = || format!("{call:?}: {:?}", slot.model);
        match expected {
            Expected::Ok => assert_eq!(status, OK, "{}", context()),
            Expected::Refused => assert_eq!(status, ERROR, "{}", context()),
            Expected::Either => assert!(status == OK || status == ERROR, "{}", context()),
        }
        if status == ERROR {
            let after = self.probe.everything(component);
            assert_eq!(before, Some(after), "{} left a trace", context());
        }
        status == OK
    }

    fn run_plain(&mut self, index: usize, call: &Call) {
        let expected = match self.units.get(index).and_then(Option::as_ref) {
            Some(slot) => {
                let running = slot.model.life == Life::Running;
                let asks = running && matches!(call, Call::Set(..));
                let position = if asks {
                    self.probe.position(slot.component)
                } else {
                    0.0
                };
                slot.model.expected(call, position)
            }
            None => Expected::Refused,
        };
        let mut values = Vec::new();
        let done = self.judged(index, call, expected, |component| {
            let (status, read) = perform(component, call);
            values = read;
            status
        });
        let Some(slot) = self.units.get_mut(index).and_then(Option::as_mut) else {
            return;
        };
        slot.note_look(call, done);
        if done {
            slot.note(call, &values);
        }
        if done && matches!(call, Call::Reset) {
            let fresh = silent();
            let same = self.probe.everything(slot.component) == self.probe.everything(fresh);
            assert!(same, "a reset unit is not as a fresh one");
            // SAFETY: made above and freed once.
            unsafe { fmi2FreeInstance(fresh) };
        }
    }

    fn instantiate(&mut self, index: usize, birth: Birth) {
        self.free(index);
        let log = Box::into_raw(Box::<Log>::default());
        let guid = CString::new(library_guid().expect("a GUID")).expect("no NUL");
        let mut functions = callbacks(log);
        let name = match birth {
            Birth::NullName => ptr::null(),
            Birth::EmptyName => c"".as_ptr(),
            _ => c"unit".as_ptr(),
        };
        let given = match birth {
            Birth::NullGuid => ptr::null(),
            Birth::OtherGuid => c"{other}".as_ptr(),
            _ => guid.as_ptr(),
        };
        let kind = if let Birth::Kind(kind) = birth {
            kind
        } else {
            1
        };
        if birth == Birth::NoLogger {
            functions.logger = None;
        }
        let functions = if birth == Birth::NoCallbacks {
            ptr::null()
        } else {
            &raw const functions
        };
        let logging_on = c_int::from(birth == Birth::LoggingOn);
        // SAFETY: NULL, or what the standard says.
        let component =
            unsafe { fmi2Instantiate(name, kind, given, ptr::null(), functions, 0, logging_on) };
        // SAFETY: nothing else holds the log now.
        let lines = unsafe { std::mem::take(&mut (*log).lines) };
        let good = matches!(
            birth,
            Birth::Plain | Birth::LoggingOn | Birth::NoCallbacks | Birth::NoLogger
        );
        assert_eq!(!component.is_null(), good, "{birth:?}");
        assert_eq!(lines.len(), usize::from(!good), "{birth:?}: {lines:?}");
        if good {
            self.units[index] = Some(Slot {
                component,
                shadow: silent(),
                log,
                has_log: !matches!(birth, Birth::NoCallbacks | Birth::NoLogger),
                model: Model::new(),
                unsettled: false,
            });
        } else {
            assert!(
                lines[0].starts_with("3 errors fmi2Instantiate: "),
                "{lines:?}"
            );
            // SAFETY: made above, and no instance holds it.
            drop(unsafe { Box::from_raw(log) });
        }
    }

    pub fn free(&mut self, index: usize) {
        // SAFETY: instances are freed once; NULL is allowed.
        unsafe { fmi2FreeInstance(self.component(index)) };
        if let Some(slot) = self.units.get_mut(index).and_then(Option::take) {
            // SAFETY: as above; the log's instance is gone.
            unsafe {
                fmi2FreeInstance(slot.shadow);
                drop(Box::from_raw(slot.log));
            }
        }
    }

    fn step(&mut self, index: usize, point: Point, size: f64) {
        let model = self
            .units
            .get(index)
            .and_then(Option::as_ref)
            .map(|slot| &slot.model);
        let (time, previous) = model.map_or((0.0, 0.0), |model| (model.time, model.previous));
        let point = match point {
            Point::Present => time,
            Point::Rounded => time * (1.0 + 2.0 * f64::EPSILON),
            Point::Previous => previous,
            Point::Beyond => time + 77.0,
            Point::Number(number) => number,
        };
        let expected = model.map_or(Expected::Refused, |model| model.expected_step(point, size));
        let call = Call::DoStep(Point::Number(point), size);
        // SAFETY: the component is NULL or alive.
        let action = |component| unsafe { fmi2DoStep(component, point, size, 0) };
        let done = self.judged(index, &call, expected, action);
        if !done {
            return;
        }
        let slot = self.units[index].as_mut().expect("an instance");
        assert_eq!(action(slot.shadow), OK);
        slot.unsettled = false;
        slot.model.previous = time;
        slot.model.time = time.max(point + size);
        assert_eq!(self.probe.time_of(slot.component), slot.model.time);
    }
}

fn texts() {
    // SAFETY: both return constant strings.
    unsafe {
        assert_eq!(std::ffi::CStr::from_ptr(fmi2GetVersion()), c"2.0");
        assert_eq!(std::ffi::CStr::from_ptr(fmi2GetTypesPlatform()), c"default");
    }
}
