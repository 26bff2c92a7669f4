//! Long work while Python waits: other Python threads go on, and Ctrl-C ends the work.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use softstop_console::interrupt;

/// How often Python looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// Only one piece of work is under way: what asks it to end is one flag of the process.
static UNDER_WAY: Mutex<()> = Mutex::new(());

/// Does work on a thread of its own.
///
/// # Errors
/// What Ctrl-C raises, and `RuntimeError` if the work panics.
pub fn supervise<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let _alone = UNDER_WAY
        .lock_py_attached(py)
        .unwrap_or_else(PoisonError::into_inner);
    let mut raised = None;
    let done = thread::scope(|scope| {
        let (send, receive) = channel();
        let worker = scope.spawn(move || {
            let _ = send.send(work());
        });
        // A receiver is for one thread: it is handed to the closure and back.
        let receive = Mutex::new(receive);
        loop {
            let wait = || {
                receive
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner)
                    .recv_timeout(LOOK)
            };
            match py.detach(wait) {
                Ok(done) => return Some(done),
                Err(RecvTimeoutError::Disconnected) => {
                    // Whoever joins a thread that has panicked keeps the scope from panicking.
                    let _ = worker.join();
                    return None;
                }
                Err(RecvTimeoutError::Timeout) => {
                    if let Err(error) = py.check_signals() {
                        raised = Some(error);
                        interrupt::request();
                    }
                }
            }
        }
    });
    interrupt::clear();
    match (raised, done) {
        (Some(error), _) => Err(error),
        (None, Some(done)) => Ok(done),
        (None, None) => Err(PyRuntimeError::new_err(
            "a defect of softstop: please report it",
        )),
    }
}
