//! Calls that an importer may make, wise or not.

use std::ffi::c_int;

use crate::common::InstantiateArguments;

/// Instances and snapshots that a sequence works with.
pub const UNITS: usize = 3;
pub const STATES: usize = 3;

/// An argument that is NULL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Null {
    Nothing,
    First,
    Second,
}

impl Null {
    /// The pointer to the first argument.
    pub fn first<T>(self, pointer: *const T) -> *const T {
        self.unless(Self::First, pointer)
    }

    /// The pointer to the second argument.
    pub fn second<T>(self, pointer: *const T) -> *const T {
        self.unless(Self::Second, pointer)
    }

    fn unless<T>(self, place: Self, pointer: *const T) -> *const T {
        match self == place {
            true => std::ptr::null(),
            false => pointer,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Type {
    Real,
    Integer,
    Boolean,
    String,
}

/// Where a step is said to begin.
#[derive(Debug, Clone, Copy)]
pub enum Point {
    Present,
    /// As far off as sums of step sizes may be.
    Rounded,
    /// As far off as for an importer that counts in nanoseconds.
    Counted,
    /// Where the last step began.
    Previous,
    Beyond,
    Number(f64),
}

/// What is done to a serialised state.
#[derive(Debug, Clone, Copy)]
pub enum Damage {
    Nothing,
    ZerosBehind,
    Behind,
    Cut(usize),
    Bit(usize),
    Empty,
    NullBytes,
    NullState,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatusOf {
    Step,
    Real,
    Integer,
    Boolean,
    String,
}

#[derive(Debug, Clone)]
pub enum Call {
    Texts,
    Instantiate(InstantiateArguments),
    FreeInstance,
    SetDebugLogging(c_int, Vec<&'static str>, Null),
    SetupExperiment(Option<f64>, f64, Option<f64>),
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    Get(Type, Vec<u32>, Null),
    Set(Type, Vec<(u32, f64)>, Null),
    GetState(usize, Null),
    SetState(usize),
    FreeState(usize, Null),
    SerializedSize(usize, Null),
    Serialize(usize, isize, Null),
    DeSerialize(usize, Damage),
    Directional(Vec<u32>, Vec<(u32, f64)>, Null),
    SetInputDerivatives(Vec<(u32, c_int, f64)>, Null),
    GetOutputDerivatives(Vec<(u32, c_int)>, Null),
    DoStep(Point, f64),
    CancelStep,
    Status(StatusOf, c_int, Null),
}
