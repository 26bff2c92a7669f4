//! What an importer agrees on with an instance by FMI 3.0.

use std::ffi::CString;

use libc::{c_char, c_int, c_void};

use crate::abi::component::{Component, Host, Sink, check_name};
use crate::abi::pointers::string;
use crate::event::Handling;
use crate::fault::Fault;
use crate::guid::options_of;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::options::Options;
use crate::standard::Standard;
use crate::unit::Unit;

/// `fmi3LogMessageCallback`: environment, status, category, message.
pub type LogMessageCallback =
    Option<unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char)>;
/// `fmi3IntermediateUpdateCallback`.
pub type IntermediateUpdateCallback =
    Option<unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64)>;
/// It, with what it is called with.
type IntermediateUpdate = (
    unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64),
    *mut c_void,
);
/// `fmi3ClockUpdateCallback`, of scheduled execution.
pub type ClockUpdateCallback = Option<unsafe extern "C" fn(*mut c_void)>;
/// `fmi3LockPreemptionCallback` and `fmi3UnlockPreemptionCallback`, of scheduled execution.
pub type PreemptionCallback = Option<unsafe extern "C" fn()>;

/// An importer by FMI 3.0.
pub(crate) struct Importer {
    pub(super) interface: Interface,
    /// What the FMU tells of.
    pub(super) options: Options,
}

/// `fmi3InterfaceType`, and what goes with it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Interface {
    CoSimulation(Handling, Option<IntermediateUpdate>),
    ModelExchange,
}

impl Importer {
    /// What a step may come to.
    pub(super) fn handling(&self) -> Handling {
        match self.interface {
            Interface::CoSimulation(handling, _) => handling,
            Interface::ModelExchange => Handling::default(),
        }
    }

    /// What to call at events within a step that may not end early.
    pub(super) fn intermediate_update(&self) -> Option<IntermediateUpdate> {
        match self.interface {
            Interface::CoSimulation(Handling { early: false, .. }, update) => update,
            _ => None,
        }
    }
}

impl Host for Importer {
    const PREFIX: &'static str = "fmi3";

    fn has_event_mode(&self) -> bool {
        self.handling().in_event_mode || self.is_for_exchange()
    }

    fn is_for_exchange(&self) -> bool {
        matches!(self.interface, Interface::ModelExchange)
    }

    /// By the standard an error ends the simulation: only a state that was kept, or a reset, leads back.
    fn note_error<U: Unit>(&self, instance: &mut Instance<U>) {
        if instance.lifecycle != Lifecycle::Failed {
            instance.lifecycle = Lifecycle::Erred;
        }
    }
}

/// The importer's logger, which may be missing.
pub(super) fn sink(environment: *mut c_void, log: LogMessageCallback) -> Sink {
    let Some(log) = log else {
        return Box::new(|_, _, _| {});
    };
    Box::new(move |status, category, text| {
        // By the standard a single # begins a value reference.
        let text = text.to_string_lossy().replace('#', "##");
        let text = CString::new(text).unwrap_or_default();
        // SAFETY: the importer's function, called as the standard says; both strings outlive it.
        unsafe {
            log(
                environment,
                status as c_int,
                category.as_ptr(),
                text.as_ptr(),
            )
        };
    })
}

/// Makes an instance, or sends one line that says why not.
///
/// # Safety
/// Pointers other than NULL must point to what the standard says.
pub(super) unsafe fn instantiate<U: Unit>(
    name: *const c_char,
    token: *const c_char,
    logging_on: bool,
    interface: Interface,
    sink: Sink,
) -> Option<Box<Component<U, Importer>>> {
    // SAFETY: by this function's contract.
    let (name, token) = unsafe {
        (
            string("instanceName", name),
            string("instantiationToken", token),
        )
    };
    let checked = check_name(name)
        .and_then(|()| options_of::<U>(Standard::Fmi3, "instantiationToken", &token?))
        .and_then(|options| check_interface::<U>(interface).map(|()| options));
    let options = checked.as_ref().copied().unwrap_or_default();
    let host = Importer { interface, options };
    let call = match interface {
        Interface::CoSimulation(..) => "fmi3InstantiateCoSimulation",
        Interface::ModelExchange => "fmi3InstantiateModelExchange",
    };
    Component::new(call, checked.map(drop), logging_on, host, sink)
}

fn check_interface<U: Unit>(interface: Interface) -> Result<(), Fault> {
    match interface {
        Interface::CoSimulation(handling, _) if handling.in_event_mode && !U::HAS_EVENTS => Err(
            Fault::Instantiation("eventModeUsed is true, hasEventMode is false".to_owned()),
        ),
        Interface::ModelExchange if U::about().state_space.is_none() => {
            Err(Fault::NotOffered("the unit is for co-simulation only"))
        }
        _ => Ok(()),
    }
}

/// Refuses to make an instance of an interface type that no unit has.
pub(super) fn refuse<U: Unit>(call: &str, environment: *mut c_void, log: LogMessageCallback) {
    let other = Fault::NotOffered("the unit is not for scheduled execution");
    let sink = sink(environment, log);
    let host = Importer {
        interface: Interface::CoSimulation(Handling::default(), None),
        options: Options::default(),
    };
    let made = Component::<U, _>::new(call, Err(other), false, host, sink);
    debug_assert!(made.is_none());
}
