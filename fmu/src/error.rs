//! What can go wrong in a call, in words for the importer's log.

use softstop::{MotionError, SceneError};
use thiserror::Error;

use crate::instance::Lifecycle;
use crate::status::Status;

/// Why a call was refused. The text names the thing; the caller puts the function's name before it.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Fault {
    /// The call does not belong in the present state.
    #[error("not allowed {state}: {remedy}")]
    WrongState {
        /// The present state.
        state: Lifecycle,
        /// What to do instead.
        remedy: &'static str,
    },
    /// An argument is NULL that must not be.
    #[error("argument {argument} is NULL")]
    Null {
        /// Name of the argument.
        argument: &'static str,
    },
    /// An array is longer than memory can hold.
    #[error("argument {argument}: {length} elements cannot be in memory")]
    Length {
        /// Name of the argument.
        argument: &'static str,
        /// The length that was given.
        length: usize,
    },
    /// A scalar argument is out of its range.
    #[error("{argument} = {value:?}: must be {allowed}")]
    Argument {
        /// Name of the argument.
        argument: &'static str,
        /// The value that was given.
        value: f64,
        /// The allowed range in words.
        allowed: &'static str,
    },
    /// No variable has this value reference.
    #[error("no variable has the value reference {reference}")]
    UnknownReference {
        /// The value reference that was given.
        reference: u32,
    },
    /// The variable is of another type.
    #[error("{name} (value reference {reference}) is of type {actual}, not {wanted}")]
    WrongType {
        /// Name of the variable.
        name: &'static str,
        /// Its value reference.
        reference: u32,
        /// Its type.
        actual: &'static str,
        /// The type that the called function serves.
        wanted: &'static str,
    },
    /// The variable is an output.
    #[error("{name} is an output and cannot be set")]
    Output {
        /// Name of the variable.
        name: &'static str,
    },
    /// The parameter is fixed and initialisation is over.
    #[error(
        "{name} is a fixed parameter: it cannot be set after initialisation (fmi2Reset leads back before it)"
    )]
    Fixed {
        /// Name of the variable.
        name: &'static str,
    },
    /// A value lies outside the variable's range.
    #[error("{name} = {value:?}: must be {allowed}")]
    OutOfRange {
        /// Name of the variable.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// The allowed range in words.
        allowed: String,
    },
    /// An input derivative that this variable cannot take.
    #[error("{name}: derivatives of order {order} are not available, {available}")]
    DerivativeOrder {
        /// Name of the variable.
        name: &'static str,
        /// The order that was asked for.
        order: i32,
        /// What is available.
        available: &'static str,
    },
    /// The parameters together do not describe a machine.
    #[error(transparent)]
    Scene(SceneError),
    /// A slope of a piecewise linear stop that does not follow the one before it.
    #[error(
        "{list}.from[{number}] = {from}, {list}.stiffness[{number}] = {stiffness}: the first slope \
         must begin at 0, each further one up to {list}.count beyond the one before it"
    )]
    Slope {
        /// Name of the list.
        list: &'static str,
        /// Which slope, counted from 1 as in the variables' names.
        number: usize,
        /// Deflection in m at which it begins.
        from: f64,
        /// Its stiffness in N/m.
        stiffness: f64,
    },
    /// The motion would start beyond a rigid stop.
    #[error(
        "initial.position = {position} m: must be <= {wall} m, where clearance, strip and rigid.travel put \
         the rigid stop"
    )]
    StartBeyondStop {
        /// The position in m.
        position: f64,
        /// Where the rigid stop stands, in m.
        wall: f64,
    },
    /// The motion cannot be carried on.
    #[error(transparent)]
    Motion(MotionError),
    /// The step does not start where the last one ended.
    #[error(
        "currentCommunicationPoint = {point} s: the last step ended at {present} s (difference allowed: {tolerance:e} s)"
    )]
    CommunicationPoint {
        /// The communication point that was given, in s.
        point: f64,
        /// Where the instance is, in s.
        present: f64,
        /// The largest difference that passes for rounding, in s.
        tolerance: f64,
    },
    /// The step ends after the stop time of the experiment.
    #[error("the step ends at {end} s, after the stop time {stop} s of fmi2SetupExperiment")]
    BeyondStop {
        /// End of the step in s.
        end: f64,
        /// The stop time in s.
        stop: f64,
    },
    /// The step could be carried out in part only.
    #[error(
        "the step to {end} s was carried out up to {reached} s only ({reason}): go on from there, or \
         repeat a shorter one"
    )]
    Discarded {
        /// End of the step in s.
        end: f64,
        /// The last successful time in s: where the instance is now.
        reached: f64,
        /// Why it was not carried on.
        reason: String,
    },
    /// The variable is none that derivatives are taken of.
    #[error("{name} is no real output: it has no derivative")]
    NoUnknown {
        /// Name of the variable.
        name: &'static str,
    },
    /// The variable is none that derivatives are taken by, at this time.
    #[error(
        "no derivative by {name} is available: after initialisation there are those by force, over the \
         first step also those by initial.position and initial.velocity"
    )]
    NoKnown {
        /// Name of the variable.
        name: &'static str,
    },
    /// There is less room than the bytes of a snapshot need.
    #[error("size = {size}: the serialized FMU state needs {needed} bytes")]
    Room {
        /// The size that was given.
        size: usize,
        /// The size that is needed.
        needed: usize,
    },
    /// Bytes that are no snapshot of this unit.
    #[error("the serialized FMU state {what}")]
    Blob {
        /// What is wrong with them.
        what: &'static str,
    },
    /// The value asked for exists in no call of this kind.
    #[error("kind {kind} has no {wanted} value")]
    StatusKind {
        /// The status kind that was given.
        kind: i32,
        /// The type that the called function serves.
        wanted: &'static str,
    },
    /// No log category of that name exists.
    #[error("no log category is named {name:?}: there are events, warnings and errors")]
    LogCategory {
        /// The name that was given.
        name: String,
    },
    /// No step is under way: `fmi2DoStep` always completes.
    #[error("no step is under way: fmi2DoStep never returns fmi2Pending")]
    NotPending,
    /// The instance cannot be made as asked.
    #[error("{0}")]
    Instantiation(String),
    /// A defect of this library, caught at its boundary.
    #[error("internal error: {0}")]
    Internal(String),
}

impl Fault {
    /// The status that the call returns.
    pub const fn status(&self) -> Status {
        match self {
            Self::Discarded { .. } => Status::Discard,
            _ => Status::Error,
        }
    }
}

impl From<SceneError> for Fault {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Slope {
                list,
                index,
                from,
                stiffness,
            } => Self::Slope {
                list,
                number: index + 1,
                from,
                stiffness,
            },
            other => Self::Scene(other),
        }
    }
}

impl From<MotionError> for Fault {
    fn from(error: MotionError) -> Self {
        match error {
            MotionError::Scene(error) => error.into(),
            other => Self::Motion(other),
        }
    }
}

/// A scalar argument out of its range.
pub(crate) fn argument(argument: &'static str, value: f64, allowed: &'static str) -> Fault {
    Fault::Argument {
        argument,
        value,
        allowed,
    }
}
