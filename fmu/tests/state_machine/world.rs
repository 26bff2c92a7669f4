//! Instances and snapshots under random calls, each beside its model and its shadow.
//!
//! The shadow of an instance is another one that is given those calls only which change something and
//! were carried out. In the end both must be the same bit for bit: neither reading nor what was refused
//! nor a way over bytes leaves a trace.

use std::ffi::{CStr, c_int, c_void};
use std::ptr;

use softstop_fmi2::*;

use super::calls::{Call, Point, STATES, UNITS};
use super::model::{Life, Model, refusal};
use super::perform::perform;
use super::probe::{Probe, silent};
use super::slot::Slot;
use crate::common::{ERROR, InstantiateArguments, OK, Statuses, Unit, call};

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
        let slot = || Slot::new(Unit::new(), &InstantiateArguments::plain());
        Self {
            units: std::array::from_fn(|_| Some(slot())),
            states: [const { None }; STATES],
            probe: Probe::new(),
        }
    }

    pub fn run(&mut self, index: usize, call: &Call) {
        match call {
            Call::Texts => texts(),
            Call::Instantiate(arguments) if index < UNITS => self.instantiate(index, arguments),
            Call::Instantiate(_) => {}
            Call::FreeInstance if index < UNITS => self.units[index] = None,
            // SAFETY: NULL is allowed.
            Call::FreeInstance => unsafe { fmi2FreeInstance(ptr::null_mut()) },
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

    /// The instance, unless there is none of this number.
    pub fn slot(&mut self, index: usize) -> Option<&mut Slot> {
        self.units.get_mut(index)?.as_mut()
    }

    /// Makes a call and judges its status, its log and, if it was refused, what it left behind.
    pub fn judged(
        &mut self,
        index: usize,
        call: &Call,
        expected: Statuses,
        action: impl FnOnce(*mut c_void) -> (&'static str, c_int),
    ) -> bool {
        let Some(Some(slot)) = self.units.get(index) else {
            assert_eq!(action(ptr::null_mut()).1, ERROR, "{call:?} of no instance");
            return false;
        };
        let before = (expected != [OK]).then(|| self.probe.everything(&slot.unit));
        let (name, status) = action(slot.unit.component);
        slot.check_log(call, (name, status));
        let model = &slot.model;
        assert!(expected.contains(&status), "{status} {call:?}: {model:?}");
        if status == ERROR {
            let after = self.probe.everything(&slot.unit);
            assert!(before == Some(after), "{call:?} left a trace: {model:?}");
        }
        status == OK
    }

    fn run_plain(&mut self, index: usize, call: &Call) {
        let expected = match self.units.get(index) {
            Some(Some(slot)) => {
                let asks = slot.model.life == Life::Running && matches!(call, Call::Set(..));
                let position = if asks {
                    self.probe.position(&slot.unit)
                } else {
                    0.0
                };
                slot.model.expected(call, position)
            }
            _ => &[ERROR],
        };
        let mut values = Vec::new();
        let done = self.judged(index, call, expected, |component| {
            let (done, read) = perform(component, call);
            values = read;
            done
        });
        let Some(slot) = self.slot(index) else {
            return;
        };
        slot.note_look(call, done);
        if done {
            slot.note(call, &values);
        }
        if done && matches!(call, Call::Reset) {
            let own = &self.units[index].as_ref().expect("an instance").unit;
            let same = self.probe.everything(own) == self.probe.everything(&silent());
            assert!(same, "a reset unit is not as a fresh one");
        }
    }

    fn instantiate(&mut self, index: usize, arguments: &InstantiateArguments) {
        self.units[index] = None;
        let made = Unit::instantiate(arguments);
        match (made, refusal(arguments)) {
            (Ok(unit), None) => {
                assert!(unit.take_log().is_empty());
                self.units[index] = Some(Slot::new(unit, arguments));
            }
            (Err(lines), Some(word)) => {
                let is_told = |line: &String| {
                    line.starts_with("3 errors fmi2Instantiate: ") && line.contains(&word)
                };
                let count = usize::from(arguments.has_callbacks && arguments.has_logger);
                let is_right = lines.len() == count && lines.iter().all(is_told);
                assert!(is_right, "{arguments:?}: {lines:?}");
            }
            (made, refusal) => panic!("{arguments:?}: {:?}, {refusal:?}", made.err()),
        }
    }

    fn step(&mut self, index: usize, point: Point, size: f64) {
        let model = self.slot(index).map(|slot| &slot.model);
        let (time, previous) = model.map_or((0.0, 0.0), |model| (model.time, model.previous));
        let point = match point {
            Point::Present => time,
            Point::Rounded => time * (1.0 + 2.0 * f64::EPSILON),
            Point::Counted => time + 4e-10,
            Point::Previous => previous,
            Point::Beyond => time + 77.0,
            Point::Number(number) => number,
        };
        let expected = model.map_or(&[ERROR][..], |model| model.expected_step(point, size));
        let call = Call::DoStep(Point::Number(point), size);
        // SAFETY: the component is NULL or alive.
        let action = |component| unsafe { call!(fmi2DoStep(component, point, size, 0)) };
        if !self.judged(index, &call, expected, action) {
            return;
        }
        let slot = self.slot(index).expect("an instance");
        assert_eq!(slot.shadow.step(point, size), OK);
        slot.unsettled = false;
        slot.model.previous = time;
        slot.model.time = time.max(point + size);
        assert_eq!(slot.unit.last_successful_time(), slot.model.time);
    }
}

fn texts() {
    // SAFETY: both return constant strings.
    unsafe {
        assert_eq!(CStr::from_ptr(fmi2GetVersion()), c"2.0");
        assert_eq!(CStr::from_ptr(fmi2GetTypesPlatform()), c"default");
    }
}
