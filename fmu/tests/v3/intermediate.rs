//! Intermediate update: the state right after each event of a step that goes to its end.

use std::cell::{Cell, RefCell};
use std::ffi::c_void;
use std::ptr;

use softstop_fmi3::*;
use softstop_fmu::Options;

use super::events::MACHINES;
use super::unit::Unit;
use crate::common::{ERROR, OK, reference};

const END: f64 = 40.0;

thread_local! {
    static INSTANCE: Cell<*mut c_void> = const { Cell::new(ptr::null_mut()) };
    static SEEN: RefCell<Vec<[u64; 3]>> = const { RefCell::new(Vec::new()) };
}

/// Keeps time, position and velocity.
unsafe extern "C" fn see(
    _: *mut c_void,
    time: f64,
    set: u8,
    get: u8,
    finished: u8,
    early: u8,
    _: *mut u8,
    _: *mut f64,
) {
    assert_eq!((set, get, finished, early), (0, 1, 1, 0));
    let (instance, of) = (INSTANCE.get(), ["position", "velocity"].map(reference));
    let mut values = [f64::NAN; 2];
    // SAFETY: the instance is alive, arrays are as long as is said.
    let status = unsafe { fmi3GetFloat64(instance, of.as_ptr(), 2, values.as_mut_ptr(), 2) };
    assert_eq!(status, OK);
    let bits = [time, values[0], values[1]].map(f64::to_bits);
    SEEN.with_borrow_mut(|seen| seen.push(bits));
}

/// Sets an input where none may be set.
unsafe extern "C" fn set(
    _: *mut c_void,
    _: f64,
    _: u8,
    _: u8,
    _: u8,
    _: u8,
    _: *mut u8,
    _: *mut f64,
) {
    // SAFETY: the instance is alive.
    let status = unsafe { fmi3SetFloat64(INSTANCE.get(), &reference("force"), 1, &1.0, 1) };
    assert_eq!(status, ERROR);
}

fn begun(
    values: &[(&str, f64)],
    handling: (bool, bool),
    update: IntermediateUpdateCallback,
) -> Unit {
    let unit = Unit::made(handling, update, Options::default());
    INSTANCE.set(unit.instance);
    unit.begin(values)
}

#[test]
fn events_of_a_step_are_those_of_steps_that_end_early() {
    for values in MACHINES {
        let mut expected = Vec::new();
        let early = Unit::begun((false, true), values);
        early.run(END, END, |unit, ending| {
            let states = ["position", "velocity"].map(|name| unit.get(name));
            expected.push([ending.time, states[0], states[1]].map(f64::to_bits));
        });
        for handling in [(false, false), (true, false)] {
            let (plain, told) = (
                Unit::begun(handling, values),
                begun(values, handling, Some(see)),
            );
            for unit in [&plain, &told] {
                unit.step(0.0, END);
            }
            assert_eq!(SEEN.take(), expected);
            assert_eq!(plain.everything(), told.everything());
        }
        let ends_early = begun(values, (true, true), Some(see));
        ends_early.step(0.0, END);
        assert!(SEEN.take().is_empty());
    }
}

#[test]
fn nothing_can_be_set_there() {
    let unit = begun(&[], (false, false), Some(set));
    let (status, _) = unit.try_step(0.0, END);
    assert_eq!((status, unit.take_log().len()), (ERROR, 2));
}
