//! Errors of Rust as exceptions of Python, in the same words.

use pyo3::exceptions::{PyException, PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::{PyErr, create_exception};
use softstop::{MotionError, SceneError};
use softstop_console::failure::Failure;

create_exception!(
    softstop,
    SoftstopError,
    PyException,
    "The values are good, but there is no such motion, zone or design; or it would cost too much."
);
create_exception!(
    softstop,
    MachineError,
    PyValueError,
    "A machine, task or option that cannot be; `key` names the parameter of a machine, None if it is none."
);

/// What a failed command raises.
pub fn of_failure(failure: Failure) -> PyErr {
    match failure {
        Failure::Usage(words) => of_words(words, None),
        Failure::Run(error) => SoftstopError::new_err(format!("{error:#}")),
        Failure::Interrupted => PyKeyboardInterrupt::new_err(()),
        Failure::Unread => SoftstopError::new_err(failure.to_string()),
    }
}

/// What a machine that cannot be raises.
pub fn of_machine(error: &softstop::MachineError) -> PyErr {
    use softstop::MachineError as Error;
    let key = match error {
        Error::UnknownKey { key, .. }
        | Error::Lacks { key, .. }
        | Error::NotANumber { key, .. } => Some(key.as_str()),
        Error::Value { source, .. } => key_of(source),
        _ => None,
    };
    of_words(error.to_string(), key)
}

/// What a value out of range raises.
pub fn of_scene(error: &SceneError) -> PyErr {
    of_words(error.to_string(), key_of(error))
}

/// What a motion that cannot be followed raises.
pub fn of_motion(error: &MotionError) -> PyErr {
    match error {
        MotionError::Scene(error) => of_scene(error),
        MotionError::NotFinite { .. }
        | MotionError::BeyondStop { .. }
        | MotionError::ForceNotFinite { .. }
        | MotionError::ForceOrder { .. } => of_words(error.to_string(), None),
        error => SoftstopError::new_err(error.to_string()),
    }
}

/// An exception with the key of the parameter that is wrong.
fn of_words(words: String, key: Option<&str>) -> PyErr {
    let error = MachineError::new_err(words);
    Python::attach(|py| error.value(py).setattr("key", key)).map_or_else(|error| error, |()| error)
}

fn key_of(error: &SceneError) -> Option<&str> {
    match error {
        SceneError::OutOfRange { name, .. }
        | SceneError::TimeScales { name, .. }
        | SceneError::Lacks(name) => Some(name),
        SceneError::Slope { list, .. } => Some(list),
        SceneError::NoSlope => Some("stop.loading"),
        SceneError::GivesEnergy { .. } => Some("stop.unloading"),
        SceneError::EmptyPiercing { .. } => Some("piercing.thickness"),
        _ => None,
    }
}
