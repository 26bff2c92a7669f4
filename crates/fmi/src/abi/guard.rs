//! No panic leaves the library.
//!
//! The code behind the boundary does not panic by design; `catch_unwind` is the last resort. The
//! default panic hook would gather a backtrace when `RUST_BACKTRACE` is set, and the symbol tables
//! it reads for that (tens of megabytes) are never freed, not even when the library is unloaded.
//! So a hook of its own stays silent while a guarded call is under way. Inside the library it
//! touches nobody else: a `cdylib` has its own copy of the standard library.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::sync::Once;

use libc::{c_int, c_void};

use super::component::Component;
use crate::fault::{Fault, Status};
use crate::lifecycle::Lifecycle;
use crate::log::Category;
use crate::unit::Unit;

thread_local! {
    // A constant without a destructor: nothing keeps the library from being unloaded.
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

fn install_hook() {
    static INSTALLED: Once = Once::new();
    // The closure captures nothing, so its box takes no memory that could be left behind.
    INSTALLED.call_once(|| {
        set_hook(Box::new(|info| {
            if !GUARDED.get() {
                eprintln!("{info}");
            }
        }));
    });
}

/// Runs `action`; a panic ends it in silence.
pub(crate) fn silent<T>(action: impl FnOnce() -> T) -> Result<T, String> {
    install_hook();
    let outcome = GUARDED.with(|guarded| {
        let before = guarded.replace(true);
        let outcome = catch_unwind(AssertUnwindSafe(action));
        guarded.set(before);
        outcome
    });
    outcome.map_err(|panic| message(panic.as_ref()).to_owned())
}

/// The handle of what is made; NULL if nothing is.
pub(crate) fn handle<T>(make: impl FnOnce() -> Option<Box<T>>) -> *mut c_void {
    let made = silent(make).ok().flatten();
    made.map_or(std::ptr::null_mut(), |made| Box::into_raw(made).cast())
}

fn message(panic: &(dyn Any + Send)) -> &str {
    panic
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("unknown")
}

/// What a C function does with an instance. Behind a `dyn`, what guards it is compiled once, not once for each function.
type Action<'a, U> = &'a mut dyn FnMut(&mut Component<U>) -> Result<(), Fault>;

/// Runs a call on an instance: a fault becomes an error and one log line, a panic as well, after
/// which the instance must be reset.
pub(crate) fn guarded<U: Unit>(
    component: Option<&mut Component<U>>,
    call: &'static str,
    action: Action<'_, U>,
) -> c_int {
    let Some(component) = component else {
        return Status::Error as c_int;
    };
    let outcome = silent(|| action(component)).unwrap_or_else(|panic| {
        component.instance.lifecycle = Lifecycle::Failed;
        Err(Fault::Internal(panic))
    });
    match outcome {
        Ok(()) => Status::Ok as c_int,
        Err(fault) => {
            let status = fault.status(component.importer.standard);
            component.log(status, Category::Errors, &format!("{call}: {fault}"));
            if status == Status::Error {
                component.note_error();
            }
            status as c_int
        }
    }
}
