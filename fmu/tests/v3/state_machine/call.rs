//! Calls, right and wrong, and how they are drawn.

use std::ffi::c_int;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use super::world::STATES;
use crate::v3::arrays::ELEMENTS;

#[derive(Debug, Clone, Copy)]
pub enum Call {
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
pub enum Where {
    Present,
    Beyond,
}

/// What has as many elements as there are states, or event indicators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vector {
    States,
    Derivatives,
    Nominals,
    Indicators,
}

pub fn call() -> impl Strategy<Value = Call> {
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
pub fn life() -> impl Strategy<Value = Vec<Call>> {
    vec(call(), 0..60).prop_map(|calls| {
        let begin = [
            Call::Reset,
            Call::EnterInitialization(0.0),
            Call::ExitInitialization,
        ];
        begin.into_iter().chain(calls).collect()
    })
}
