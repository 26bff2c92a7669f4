//! Instances, and states kept of them.

use std::ffi::{c_int, c_void};
use std::ptr;

use softstop_fmi3::*;
use softstop_fmu::Options;

use super::call::{Call, Vector, Where};
use super::model::Life::{Continuous, Event, Initializing, Step, Terminated};
use super::model::Model;
use crate::common::{DISCARD, ERROR, OK, reference, variable};
use crate::v3::arrays::STIFFNESS;
use crate::v3::unit::{CLOCK, HANDLINGS, Unit};

/// How many states can be kept.
pub const STATES: usize = 3;

/// The FMU tells of all that it can.
const OPTIONS: Options = Options {
    exchange: false,
    clock: true,
    arrays: true,
};

/// The functions for what the unit does not have.
fn absent(instance: *mut c_void, number: usize) -> c_int {
    let (none, no_number, mut count, mut real) = (ptr::null(), 0, 0usize, 0.0f64);
    let (real, count) = (&raw mut real, &raw mut count);
    // SAFETY: none of them looks at its arguments.
    unsafe {
        match number {
            0 => fmi3EnterConfigurationMode(instance),
            1 => fmi3ExitConfigurationMode(instance),
            2 => fmi3EvaluateDiscreteStates(instance),
            3 => fmi3GetShiftDecimal(instance, none, 0, real),
            4 => fmi3ActivateModelPartition(instance, 0, 0.0),
            _ => fmi3GetNumberOfVariableDependencies(instance, no_number, count),
        }
    }
}

pub struct World {
    units: [(Unit, Model); 5],
    states: [Option<(*mut c_void, Model)>; STATES],
}

impl World {
    pub fn new() -> Self {
        Self {
            units: std::array::from_fn(|index| match HANDLINGS.get(index) {
                Some(handling) => (Unit::made(*handling, None, OPTIONS), Model::new(false)),
                None => (Unit::for_exchange(OPTIONS), Model::new(true)),
            }),
            states: [None; STATES],
        }
    }

    fn state(&self, number: usize) -> *mut c_void {
        self.states[number].map_or(ptr::null_mut(), |(state, _)| state)
    }

    pub fn run(&mut self, index: usize, call: Call) {
        let kept = match call {
            Call::SetState(number) | Call::Copy(number) => {
                self.states[number].map(|(_, model)| model)
            }
            _ => None,
        };
        let (unit, model) = &self.units[index];
        let (handling, model) = (unit.handling, *model);
        let expected = model.expected(call, handling, kept.as_ref());
        let before = (expected == [DISCARD]).then(|| unit.everything());
        unit.take_log();
        let (status, after) = self.perform(index, call);
        let (unit, own) = &mut self.units[index];
        let lines = unit.take_log();
        let what = format!("{call:?} of {handling:?} {model:?}: {lines:?}");
        assert!(expected.contains(&status), "status {status}, {what}");
        match status {
            OK => assert!(lines.is_empty(), "{what}"),
            _ => {
                let begins = format!("{status} errors fmi3");
                assert!(lines.len() == 1 && lines[0].starts_with(&begins), "{what}");
                assert!(!lines[0].contains("fmi2"), "{what}");
            }
        }
        match status {
            OK => *own = after,
            ERROR => own.life = Terminated,
            _ => {}
        }
        if let Some(before) = before {
            let same = before == self.units[index].0.everything();
            assert!(same, "what was discarded left a trace: {what}");
        }
    }

    /// The status, and the instance as it must be if that is good.
    fn perform(&mut self, index: usize, call: Call) -> (c_int, Model) {
        let (unit, model) = &self.units[index];
        let (instance, mut after) = (unit.instance, *model);
        let (force, position) = (reference("force"), reference("position"));
        let (one, mut value) = (1.0, f64::NAN);
        let (one, value) = (&raw const one, &raw mut value);
        // SAFETY: the instance is alive, arrays are as long as is said.
        let status = unsafe {
            match call {
                Call::EnterInitialization(start) => {
                    (after.life, after.time) = (Initializing, start);
                    (after.event, after.updated) = (start, false);
                    fmi3EnterInitializationMode(instance, 0, 0.0, start, 0, 0.0)
                }
                Call::ExitInitialization => {
                    after.life = if unit.handling.0 { Event } else { Step };
                    after.begun = true;
                    fmi3ExitInitializationMode(instance)
                }
                Call::EnterEvent => {
                    (after.life, after.event, after.updated) = (Event, model.time, false);
                    fmi3EnterEventMode(instance)
                }
                Call::EnterStep => {
                    after.life = Step;
                    fmi3EnterStepMode(instance)
                }
                Call::EnterContinuous => {
                    after.life = Continuous;
                    fmi3EnterContinuousTimeMode(instance)
                }
                Call::Complete => {
                    let (mut enter, mut terminate) = (7, 7);
                    let (enter, terminate) = (&raw mut enter, &raw mut terminate);
                    fmi3CompletedIntegratorStep(instance, 1, enter, terminate)
                }
                Call::SetTime(ahead) => {
                    after.time = model.time + ahead;
                    fmi3SetTime(instance, model.time + ahead)
                }
                Call::SetStates(states) => {
                    fmi3SetContinuousStates(instance, states.as_ptr(), states.len())
                }
                Call::GetStates(of, count) => {
                    let mut values = [f64::NAN; 4];
                    let place = values.as_mut_ptr();
                    let function = match of {
                        Vector::States => fmi3GetContinuousStates,
                        Vector::Derivatives => fmi3GetContinuousStateDerivatives,
                        Vector::Nominals => fmi3GetNominalsOfContinuousStates,
                        Vector::Indicators => fmi3GetEventIndicators,
                    };
                    let status = function(instance, place, count);
                    let is_finite = values[..count].iter().all(|value| value.is_finite());
                    assert!(status != OK || is_finite, "{values:?}");
                    status
                }
                Call::Update => {
                    let (status, next) = unit.try_update();
                    assert!(next.is_none_or(|next| next >= model.time));
                    (after.awaits, after.updated) = (false, true);
                    status
                }
                Call::Terminate => {
                    after.life = Terminated;
                    fmi3Terminate(instance)
                }
                Call::Reset => {
                    after = Model::new(model.is_for_exchange);
                    fmi3Reset(instance)
                }
                Call::Get(name) => unit.read(variable(name)).0,
                Call::Set(name, value) => unit.set(name, value),
                Call::GetClock => {
                    let (status, ticks) = unit.try_clock();
                    assert!(!ticks || model.life == Event && !model.updated);
                    status
                }
                Call::GetArray(count) => {
                    let place = [f64::NAN; 9].as_mut_ptr();
                    fmi3GetFloat64(instance, &STIFFNESS, 1, place, count)
                }
                Call::SetArray(count) => {
                    fmi3SetFloat64(instance, &STIFFNESS, 1, [7.0; 9].as_ptr(), count)
                }
                Call::Element => fmi3GetFloat64(instance, &(STIFFNESS + 1), 1, value, 1),
                Call::SetClock => fmi3SetClock(instance, &CLOCK, 1, &1),
                Call::UnknownVariable => fmi3GetFloat64(instance, &199, 1, value, 1),
                Call::OtherType => {
                    let mut real = 0.0f32;
                    fmi3GetFloat32(instance, &raw const force, 1, &raw mut real, 1)
                }
                Call::TooFewValues => fmi3GetFloat64(instance, &raw const force, 1, value, 0),
                Call::NullValues => {
                    fmi3GetFloat64(instance, &raw const force, 1, ptr::null_mut(), 1)
                }
                Call::DoStep(at, size) => {
                    let point = match at {
                        Where::Present => model.time,
                        Where::Beyond => model.time + 7.0,
                    };
                    let (status, ending) = unit.try_step(point, size);
                    if status == OK {
                        assert!(unit.handling.0 || !ending.event, "{ending:?}");
                        assert!(unit.handling.1 || !ending.early, "{ending:?}");
                        let end = point + size;
                        assert!(ending.early || (ending.time - end).abs() < 1e-12 * end.abs());
                        (after.time, after.awaits) = (ending.time, ending.event);
                        // Only an event at the end of the step is left to be handled.
                        if ending.event && !unit.handling.1 {
                            after.awaits = fmi3EnterEventMode(instance) == OK
                                && fmi3EnterStepMode(instance) == ERROR;
                            after.life = if after.awaits { Terminated } else { Step };
                            unit.take_log();
                        }
                    }
                    status
                }
                Call::Directional(known) => {
                    let known = reference(known);
                    let (of, by) = (&raw const position, &raw const known);
                    fmi3GetDirectionalDerivative(instance, of, 1, by, 1, one, 1, value, 1)
                }
                Call::Adjoint(known) => {
                    let known = reference(known);
                    let (of, by) = (&raw const position, &raw const known);
                    fmi3GetAdjointDerivative(instance, of, 1, by, 1, one, 1, value, 1)
                }
                Call::OutputDerivative(order) => {
                    let of = &raw const position;
                    fmi3GetOutputDerivatives(instance, of, 1, &raw const order, value, 1)
                }
                Call::GetState(number) => {
                    let mut state = self.state(number);
                    let status = fmi3GetFMUState(instance, &raw mut state);
                    self.states[number] = Some((state, after));
                    status
                }
                Call::SetState(number) => {
                    if let Some((_, kept)) = self.states[number] {
                        let is_for_exchange = model.is_for_exchange;
                        after = Model {
                            is_for_exchange,
                            ..kept
                        };
                    }
                    fmi3SetFMUState(instance, self.state(number))
                }
                Call::Copy(number) => self.copy(index, number, false),
                Call::DamagedBytes(number) => self.copy(index, number, true),
                Call::Logging(right) => {
                    let name = if right { c"events" } else { c"nonsense" }.as_ptr();
                    fmi3SetDebugLogging(instance, 0, 1, &raw const name)
                }
                Call::Absent(number) => absent(instance, number),
            }
        };
        (status, after)
    }

    /// Takes a state over bytes to another place.
    fn copy(&mut self, unit: usize, number: usize, damaged: bool) -> c_int {
        let (unit, mut size) = (&self.units[unit].0, 0);
        let Some((state, _)) = &mut self.states[number] else {
            // SAFETY: NULL is refused.
            return unsafe {
                fmi3SerializedFMUStateSize(unit.instance, ptr::null_mut(), &raw mut size)
            };
        };
        let mut bytes = unit.bytes_of(*state);
        if damaged {
            let middle = bytes.len() / 2;
            bytes[middle] ^= 8;
        }
        let (status, copy) = unit.try_state_of(&bytes);
        if status == OK {
            unit.free(*state);
            *state = copy;
        }
        status
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // Each is freed once, by any instance.
        for (state, _) in self.states.iter().flatten() {
            self.units[0].0.free(*state);
        }
    }
}
