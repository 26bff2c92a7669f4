//! What can go wrong in a call, in words for the importer's log.

use std::error::Error;

use crate::lifecycle::Lifecycle;
use crate::standard::Standard;

/// Why a call was refused. The text names the thing; the caller puts the function's name before it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("not allowed {state}: {remedy}")]
    WrongState {
        state: Lifecycle,
        remedy: &'static str,
    },
    #[error("argument {argument} is NULL")]
    Null { argument: &'static str },
    #[error("argument {argument}: {length} elements cannot be in memory")]
    Length {
        argument: &'static str,
        length: usize,
    },
    #[error("{name} = {value:?}: must be {allowed}")]
    OutOfRange {
        name: &'static str,
        value: f64,
        allowed: String,
    },
    #[error("no variable has the value reference {reference}")]
    UnknownReference { reference: u32 },
    #[error("{name} (value reference {reference}) is of type {actual}, not {wanted}")]
    WrongType {
        name: &'static str,
        reference: u32,
        actual: &'static str,
        wanted: &'static str,
    },
    #[error("{0} is an output and cannot be set")]
    Output(&'static str),
    #[error(
        "{0} is a fixed parameter: it cannot be set after initialisation (fmi2Reset leads back before it)"
    )]
    Fixed(&'static str),
    #[error("{0} can change at events only, not in continuous-time mode: enter event mode first")]
    OnlyAtEvents(&'static str),
    #[error("{name}: derivatives of order {order} are not available, {available}")]
    DerivativeOrder {
        name: &'static str,
        order: i32,
        available: &'static str,
    },
    /// What the unit says: values that do not go together, a motion that cannot be carried on.
    #[error(transparent)]
    Unit(#[from] Box<dyn Error>),
    /// Values that were set one by one and do not go together; those before the first of them hold again.
    #[error("{0}; the values before hold again")]
    Unfit(Box<dyn Error>),
    /// The step does not start where the last one ended; `tolerance` in s passes for rounding.
    #[error(
        "currentCommunicationPoint = {point} s: the last step ended at {present} s (difference allowed: {tolerance:e} s)"
    )]
    CommunicationPoint {
        point: f64,
        present: f64,
        tolerance: f64,
    },
    #[error("the step ends at {end} s, after the stop time {stop} s of fmi2SetupExperiment")]
    BeyondStop { end: f64, stop: f64 },
    #[error(
        "the step to {end} s was carried out up to {reached} s only ({reason}){}",
        if *.is_taken_back {
            ", and taken back: repeat a shorter one"
        } else {
            ": go on from there, or repeat a shorter one"
        }
    )]
    Discarded {
        end: f64,
        reached: f64,
        reason: String,
        is_taken_back: bool,
    },
    #[error("{0} is no real output: it has no derivative")]
    NoUnknown(&'static str),
    #[error("{0} has no derivative along this direction: it jumps, bends or overflows here")]
    NoDerivative(&'static str),
    #[error(
        "no derivative by {name} is available: after initialisation there are those by {available}"
    )]
    NoKnown {
        name: &'static str,
        available: &'static str,
    },
    #[error("size = {size}: the serialized FMU state needs {needed} bytes")]
    Room { size: usize, needed: usize },
    /// Bytes that are no snapshot of this unit.
    #[error("the serialized FMU state {0}")]
    Blob(&'static str),
    #[error("the FMU state is of another FMU, or is none")]
    ForeignState,
    #[error("kind {kind} has no {wanted} value")]
    StatusKind { kind: i32, wanted: &'static str },
    #[error(
        "no log category is named {0:?}: there are events, warnings and errors, and the standard's logEvents, logStatusWarning, logStatusDiscard, logStatusError and logAll"
    )]
    LogCategory(String),
    #[error("no step is under way: fmi2DoStep never returns fmi2Pending")]
    NotPending,
    /// A value that is not taken: all is as it was before the call.
    #[error(transparent)]
    Refused(Box<Fault>),
    #[error("{argument} = {value}: must be {wanted}, one for each value reference")]
    Count {
        argument: &'static str,
        value: usize,
        wanted: usize,
    },
    #[error("{value} {what}: there are {wanted}")]
    Size {
        what: &'static str,
        value: usize,
        wanted: usize,
    },
    #[error("not offered: {0}")]
    NotOffered(&'static str),
    #[error("{0}")]
    Instantiation(String),
    /// A defect of this library, caught at its boundary.
    #[error("internal error: {0}")]
    Internal(String),
}

impl Fault {
    /// The status that the call returns.
    pub(crate) const fn status(&self, standard: Standard) -> Status {
        match self {
            Self::Discarded { .. } | Self::Refused(_) => Status::Discard,
            Self::Unfit(_) | Self::NoDerivative(_) if matches!(standard, Standard::Fmi3) => {
                Status::Discard
            }
            _ => Status::Error,
        }
    }

    /// What FMI 3.0 makes of a fault that has left the instance as it was: the importer may go on with another value.
    pub(crate) fn refused(self) -> Self {
        match self {
            Self::OutOfRange { .. } | Self::OnlyAtEvents(_) | Self::Unit(_) => {
                Self::Refused(self.into())
            }
            other => other,
        }
    }

    /// A scalar argument out of its range.
    pub(crate) fn argument(name: &'static str, value: f64, allowed: &str) -> Self {
        Self::OutOfRange {
            name,
            value,
            allowed: allowed.to_owned(),
        }
    }
}

/// `fmi2Status`: what a call returns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(i32)]
pub(crate) enum Status {
    /// All well.
    Ok = 0,
    /// Not done; it can be tried in another way.
    Discard = 2,
    /// Refused.
    Error = 3,
}
