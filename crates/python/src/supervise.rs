//! Long work while Python waits: other Python threads go on, and Ctrl-C ends the work.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, PoisonError, TryLockError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use softstop_console::{interrupt, progress};

/// Who is told of progress: what is counted, how much is done, and of how much, None if nobody knows.
pub type Teller<'py> = Option<Bound<'py, PyAny>>;

/// How often Python looks for Ctrl-C and progress.
const LOOK: Duration = Duration::from_millis(50);

/// Only one piece of work is under way: what asks it to end is one flag of the process.
static UNDER_WAY: Mutex<()> = Mutex::new(());

/// Does work on a thread of its own.
///
/// # Errors
/// What Ctrl-C or the teller raise, and `RuntimeError` if the work panics.
pub fn supervise<'py, T: Send>(
    py: Python<'py>,
    teller: &Teller<'py>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    alone(py, |send, receive| {
        thread::scope(|scope| {
            scope.spawn(move || run(work, &send));
            wait(py, teller, receive)
        })
    })
}

/// Does work that knows of no budgets on the threads of rayon's pool, which begins at once where another thread would have
/// to hand it over to them.
///
/// # Errors
/// As [`supervise`].
pub fn supervise_in_pool<'py, T: Send>(
    py: Python<'py>,
    teller: &Teller<'py>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    alone(py, |send, receive| {
        rayon::in_place_scope(|scope| {
            scope.spawn(move |_| run(work, &send));
            wait(py, teller, receive)
        })
    })
}

/// Begins work and waits for it, while no other is under way.
fn alone<T>(
    py: Python<'_>,
    work: impl FnOnce(Sender<T>, &Mutex<Receiver<T>>) -> PyResult<T>,
) -> PyResult<T> {
    let _alone = loop {
        match UNDER_WAY.try_lock() {
            Ok(lock) => break lock,
            Err(TryLockError::Poisoned(lock)) => break lock.into_inner(),
            Err(TryLockError::WouldBlock) => py.detach(|| thread::sleep(LOOK)),
        }
        py.check_signals()?;
    };
    let (send, receive) = channel();
    // A receiver is for one thread: it is handed to a closure and back.
    let done = work(send, &Mutex::new(receive));
    interrupt::clear();
    done
}

/// Does work and sends what comes of it, nothing if it panics.
fn run<T>(work: impl FnOnce() -> T, send: &Sender<T>) {
    let work = AssertUnwindSafe(|| progress::shown_elsewhere(work));
    if let Ok(done) = catch_unwind(work) {
        let _ = send.send(done);
    }
}

/// Waits for what comes of work, and asks it to end after Ctrl-C.
fn wait<T: Send>(py: Python<'_>, teller: &Teller<'_>, receive: &Mutex<Receiver<T>>) -> PyResult<T> {
    let mut raised = None;
    let next = || {
        receive
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .recv_timeout(LOOK)
    };
    loop {
        match py.detach(next) {
            Ok(done) => return raised.map_or(Ok(done), Err),
            Err(RecvTimeoutError::Disconnected) => {
                let defect = "a defect of softstop: please report it";
                return Err(raised.unwrap_or_else(|| PyRuntimeError::new_err(defect)));
            }
            Err(RecvTimeoutError::Timeout) => {
                let told = py.check_signals().and_then(|()| tell(teller));
                if let (None, Err(error)) = (&raised, told) {
                    raised = Some(error);
                    interrupt::request();
                }
            }
        }
    }
}

fn tell(teller: &Teller<'_>) -> PyResult<()> {
    if let Some((teller, it)) = teller.as_ref().zip(progress::done()) {
        teller.call1((it.what, it.done, it.total))?;
    }
    Ok(())
}
