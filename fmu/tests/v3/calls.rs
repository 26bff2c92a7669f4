//! Random sequences of calls, right and wrong, against the state machine of the standard (FMI 3.0, 2.3 and 4.2.1): which
//! status each must have.

use std::ffi::{c_int, c_void};
use std::ptr;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use softstop_fmi3::*;
use softstop_fmu::Options;

use super::arrays::{ELEMENTS, STIFFNESS};
use super::unit::{CLOCK, HANDLINGS, Unit, reference};
use crate::common::{DISCARD, ERROR, OK};

const STATES: usize = 3;

/// The FMU tells of all that it can.
const OPTIONS: Options = Options {
    exchange: false,
    clock: true,
    arrays: true,
};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Life {
    Instantiated,
    Initializing,
    Event,
    Step,
    Continuous,
    Terminated,
}
use Life::{Continuous, Event, Initializing, Instantiated, Step, Terminated};

#[derive(Debug, Clone, Copy)]
enum Call {
    EnterInitialization(f64),
    ExitInitialization,
    EnterEvent,
    EnterStep,
    Update,
    EnterContinuous,
    Complete,
    SetTime(f64),
    SetStates(&'static [f64]),
    GetStates(Vector, usize),
    Terminate,
    Reset,
    Get(&'static str),
    Set(&'static str, f64),
    GetClock,
    SetClock,
    GetArray(usize),
    SetArray(usize),
    Element,
    UnknownVariable,
    OtherType,
    TooFewValues,
    NullValues,
    DoStep(Where, f64),
    Directional(&'static str),
    Adjoint(&'static str),
    OutputDerivative(c_int),
    GetState(usize),
    SetState(usize),
    Copy(usize),
    DamagedBytes(usize),
    Logging(bool),
    Absent(usize),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Where {
    Present,
    Beyond,
}

/// What has as many elements as there are states, or event indicators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Vector {
    States,
    Derivatives,
    Nominals,
    Indicators,
}

/// An instance as its importer must imagine it.
#[derive(Debug, Clone, Copy)]
struct Model {
    life: Life,
    time: f64,
    /// An event was reported that has not been handled.
    awaits: bool,
    /// Initialisation was left, so that there are outputs whatever comes.
    begun: bool,
    /// The importer integrates.
    is_for_exchange: bool,
    /// When event mode was entered last, and whether events were updated since.
    event: f64,
    updated: bool,
}

const FRESH: Model = Model {
    life: Instantiated,
    time: 0.0,
    awaits: false,
    begun: false,
    is_for_exchange: false,
    event: 0.0,
    updated: true,
};

const FRESH_FOR_EXCHANGE: Model = Model {
    is_for_exchange: true,
    ..FRESH
};

/// What may come of a call.
type Statuses = &'static [c_int];

fn if_all(conditions: &[bool]) -> Statuses {
    if conditions.iter().all(|holds| *holds) {
        &[OK]
    } else {
        &[ERROR]
    }
}

impl Model {
    fn is(&self, lives: &[Life]) -> bool {
        lives.contains(&self.life)
    }

    fn is_settable(&self) -> bool {
        self.life != Terminated
    }

    /// What may come of what needs outputs where it is allowed in these states.
    fn of_outputs(&self, lives: &[Life], otherwise: Statuses) -> Statuses {
        match self.life {
            Terminated if !self.begun => &[OK, DISCARD, ERROR],
            life if lives.contains(&life) => &[OK],
            _ => otherwise,
        }
    }

    /// Whether a state was kept by an instance of the other interface type.
    fn is_of_other_type(&self, kept: &Self) -> bool {
        let is_of_exchange = kept.is_for_exchange && kept.begun;
        match self.is_for_exchange {
            true => !is_of_exchange && !kept.is(&[Instantiated, Initializing]),
            false => is_of_exchange,
        }
    }

    fn expected(&self, call: Call, handling: (bool, bool), kept: Option<&Self>) -> Statuses {
        let exchanges = self.is_for_exchange;
        match call {
            Call::EnterStep | Call::DoStep(..) | Call::OutputDerivative(_) if exchanges => &[ERROR],
            Call::EnterEvent if exchanges => if_all(&[self.life == Continuous]),
            Call::EnterContinuous => match self.life == Event && exchanges {
                // An event may be due.
                true if !self.updated => &[OK, ERROR],
                is_allowed => if_all(&[is_allowed]),
            },
            Call::Complete => if_all(&[self.life == Continuous]),
            Call::SetTime(ahead) => if_all(&[
                exchanges && self.is(&[Event, Continuous]),
                self.time + ahead >= self.event,
                self.life == Continuous || ahead == 0.0,
            ]),
            Call::SetStates(states) => match self.life == Continuous && states.len() == 2 {
                true if states.iter().any(|state| !state.is_finite()) => &[DISCARD],
                is_allowed => if_all(&[is_allowed]),
            },
            Call::GetStates(of, count) => match (of, count) {
                _ if !exchanges => &[ERROR],
                (Vector::Nominals, 2) => &[OK],
                (Vector::Indicators, 3) | (Vector::States | Vector::Derivatives, 2) => {
                    self.of_outputs(&[Initializing, Event, Continuous, Terminated], &[ERROR])
                }
                _ => &[ERROR],
            },
            Call::EnterInitialization(start) => {
                if_all(&[self.life == Instantiated, start.is_finite()])
            }
            Call::ExitInitialization => if_all(&[self.life == Initializing]),
            Call::EnterEvent => if_all(&[self.life == Step, handling.0]),
            Call::EnterStep => if_all(&[self.life == Event, !self.awaits]),
            Call::Update => if_all(&[self.life == Event]),
            Call::Terminate => if_all(&[self.is(&[Event, Step, Continuous])]),
            Call::Reset | Call::GetState(_) | Call::Logging(true) => &[OK],
            Call::Get("position" | "phase" | "impact.count") | Call::GetClock => {
                let lives = [Initializing, Event, Step, Continuous, Terminated];
                self.of_outputs(&lives, &[DISCARD])
            }
            Call::Get(_) => &[OK],
            Call::GetArray(count) => if_all(&[count == ELEMENTS]),
            Call::SetArray(count) => {
                if_all(&[count == ELEMENTS, self.is(&[Instantiated, Initializing])])
            }
            Call::Set(name, value) => match name {
                _ if !self.is_settable() => &[ERROR],
                "position" if self.life != Continuous => &[ERROR],
                "mass" if self.is(&[Event, Step, Continuous]) => &[ERROR],
                _ if value.is_finite() && value.abs() < 1e12 => &[OK],
                _ => &[DISCARD],
            },
            Call::DoStep(at, size) => if_all(&[
                self.life == Step,
                !self.awaits,
                size.is_finite() && size > 0.0,
                at == Where::Present,
            ]),
            Call::Directional(known) | Call::Adjoint(known) => match known {
                // In initialisation every real parameter is a known.
                "clearance" if self.life == Initializing => &[OK],
                "clearance" if exchanges && self.begun => if_all(&[self.life == Event]),
                "velocity" if exchanges && self.begun => {
                    self.of_outputs(&[Event, Continuous, Terminated], &[ERROR])
                }
                "force" => {
                    let lives = [Initializing, Event, Step, Continuous, Terminated];
                    self.of_outputs(&lives, &[ERROR])
                }
                _ => &[ERROR],
            },
            Call::OutputDerivative(order) => match order {
                1 | 2 => self.of_outputs(&[Step, Terminated], &[ERROR]),
                _ => &[ERROR],
            },
            Call::SetState(_) => if_all(&[
                kept.is_some_and(|kept| handling.0 || !(kept.awaits || kept.life == Event)),
                kept.is_none_or(|kept| !self.is_of_other_type(kept)),
            ]),
            Call::Copy(_) => if_all(&[kept.is_some()]),
            Call::SetClock
            | Call::Element
            | Call::UnknownVariable
            | Call::OtherType
            | Call::TooFewValues
            | Call::NullValues
            | Call::DamagedBytes(_)
            | Call::Logging(false)
            | Call::Absent(_) => &[ERROR],
        }
    }
}

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

struct World {
    units: [(Unit, Model); 5],
    states: [Option<(*mut c_void, Model)>; STATES],
}

impl World {
    fn new() -> Self {
        Self {
            units: std::array::from_fn(|index| match HANDLINGS.get(index) {
                Some(handling) => (Unit::made(*handling, None, OPTIONS), FRESH),
                None => (Unit::for_exchange(OPTIONS), FRESH_FOR_EXCHANGE),
            }),
            states: [None; STATES],
        }
    }

    fn state(&self, number: usize) -> *mut c_void {
        self.states[number].map_or(ptr::null_mut(), |(state, _)| state)
    }

    fn run(&mut self, index: usize, call: Call) {
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
                    let status = match of {
                        Vector::States => fmi3GetContinuousStates(instance, place, count),
                        Vector::Derivatives => {
                            fmi3GetContinuousStateDerivatives(instance, place, count)
                        }
                        Vector::Nominals => {
                            fmi3GetNominalsOfContinuousStates(instance, place, count)
                        }
                        Vector::Indicators => fmi3GetEventIndicators(instance, place, count),
                    };
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
                    after = match model.is_for_exchange {
                        true => FRESH_FOR_EXCHANGE,
                        false => FRESH,
                    };
                    fmi3Reset(instance)
                }
                Call::Get(name) => {
                    let variable = softstop_fmu::table().by_name(name).expect("a variable");
                    unit.read(&variable.kind, variable.reference).0
                }
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
                Call::Copy(number) => self.copy(instance, number, false),
                Call::DamagedBytes(number) => self.copy(instance, number, true),
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
    fn copy(&mut self, instance: *mut c_void, number: usize, damaged: bool) -> c_int {
        let (state, mut size, mut copy) = (self.state(number), 0, ptr::null_mut());
        // SAFETY: the state is NULL or alive; the old one is freed once.
        unsafe {
            let status = fmi3SerializedFMUStateSize(instance, state, &raw mut size);
            if status != OK {
                return status;
            }
            let mut bytes = vec![0u8; size];
            assert_eq!(
                fmi3SerializeFMUState(instance, state, bytes.as_mut_ptr(), size),
                OK
            );
            if damaged {
                bytes[size / 2] ^= 8;
            }
            let place = &raw mut copy;
            let status = fmi3DeserializeFMUState(instance, bytes.as_ptr(), size, place);
            if let Some((state, _)) = self.states[number].as_mut().filter(|_| status == OK) {
                assert_eq!(fmi3FreeFMUState(instance, &raw mut *state), OK);
                *state = copy;
            }
            status
        }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        for mut state in self.states.iter().flatten().map(|(state, _)| *state) {
            // SAFETY: each is freed once, by any instance.
            unsafe { fmi3FreeFMUState(self.units[0].0.instance, &raw mut state) };
        }
    }
}

fn call() -> impl Strategy<Value = Call> {
    let start = prop_oneof![9 => select(vec![0.0, 10.0, -5.0]), 1 => Just(f64::NAN)];
    let size = prop_oneof![
        12 => select(vec![1e-3, 0.1, 0.7, 5.463639, 30.0]),
        1 => select(vec![0.0, -1.0, f64::NAN, f64::INFINITY]),
    ];
    let at = prop_oneof![30 => Just(Where::Present), 1 => Just(Where::Beyond)];
    let variable = select(vec![
        "position",
        "phase",
        "impact.count",
        "force",
        "mass",
        "material",
    ]);
    let settable = select(vec![
        ("force", 0.5),
        ("force", f64::NAN),
        ("clearance", 9.5),
        ("clearance", 1e300),
        ("mass", 2.0),
        ("material", 0.0),
        ("stop.stiffness", 9.0),
    ]);
    let ahead = prop_oneof![
        20 => select(vec![0.0, 1e-3, 0.1, 0.7, 30.0]),
        1 => select(vec![-0.05, -100.0, f64::NAN]),
    ];
    let states = prop_oneof![
        9 => select(vec![&[6.0, 2.0][..], &[10.5, 9.0], &[10.0, -1.0], &[0.0, 0.0], &[-1e6, 1e9]]),
        1 => select(vec![&[f64::NAN, 0.0][..], &[0.0, f64::INFINITY], &[1.0], &[]]),
    ];
    let vectors = select(vec![
        Vector::States,
        Vector::Derivatives,
        Vector::Nominals,
        Vector::Indicators,
    ]);
    let counts = prop_oneof![20 => 2..4usize, 1 => 0..5usize];
    let state = || 0..STATES;
    let known = || prop_oneof![9 => Just("force"), 1 => Just("clearance"), 1 => Just("velocity")];
    let orders = prop_oneof![9 => 1..3, 1 => select(vec![0, 3, -1])];
    prop_oneof![
        14 => start.prop_map(Call::EnterInitialization),
        14 => Just(Call::ExitInitialization),
        10 => select(vec![Call::EnterEvent, Call::EnterStep, Call::Update]),
        20 => Just(Call::Update),
        20 => Just(Call::EnterStep),
        20 => Just(Call::EnterContinuous),
        10 => Just(Call::Complete),
        20 => ahead.prop_map(Call::SetTime),
        14 => states.prop_map(Call::SetStates),
        12 => (vectors, counts).prop_map(|(of, count)| Call::GetStates(of, count)),
        3 => Just(Call::Reset),
        1 => Just(Call::Terminate),
        14 => variable.prop_map(Call::Get),
        10 => Just(Call::GetClock),
        3 => prop_oneof![9 => Just(ELEMENTS), 1 => 0..10usize].prop_map(Call::GetArray),
        3 => prop_oneof![9 => Just(ELEMENTS), 1 => 0..10usize].prop_map(Call::SetArray),
        12 => settable.prop_map(|(name, value)| Call::Set(name, value)),
        3 => select(vec![1.0, 10.5, f64::NAN]).prop_map(|value| Call::Set("position", value)),
        1 => select(vec![
            Call::SetClock,
            Call::Element,
            Call::UnknownVariable,
            Call::OtherType,
            Call::TooFewValues,
            Call::NullValues,
            Call::Logging(false),
        ]),
        40 => (at, size).prop_map(|(at, size)| Call::DoStep(at, size)),
        3 => known().prop_map(Call::Directional),
        3 => known().prop_map(Call::Adjoint),
        3 => orders.prop_map(Call::OutputDerivative),
        8 => state().prop_map(Call::GetState),
        10 => state().prop_map(Call::SetState),
        3 => state().prop_map(Call::Copy),
        1 => state().prop_map(Call::DamagedBytes),
        2 => Just(Call::Logging(true)),
        1 => (0..6usize).prop_map(Call::Absent),
    ]
}

/// Calls in the order in which they can be carried out, which random ones seldom have.
fn life() -> impl Strategy<Value = Vec<Call>> {
    vec(call(), 0..60).prop_map(|calls| {
        let begin = [
            Call::Reset,
            Call::EnterInitialization(0.0),
            Call::ExitInitialization,
        ];
        begin.into_iter().chain(calls).collect()
    })
}

proptest! {
    #![proptest_config(softstop_testing::cases(1000))]

    #[test]
    fn all_calls_have_the_status_of_the_standard(
        lives in vec((0..5usize, life()), 1..4),
        rest in vec((0..5usize, call()), 0..60),
    ) {
        let mut world = World::new();
        for (index, calls) in lives {
            for call in calls {
                world.run(index, call);
            }
        }
        for (index, call) in rest {
            world.run(index, call);
        }
    }
}
