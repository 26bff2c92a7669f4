//! What the importer's handle points to: an instance and the way to the importer's log.

use std::borrow::Cow;
use std::ffi::{CStr, CString};

use libc::{c_char, c_void};

use super::pointers::string;
use crate::event::Handling;
use crate::fault::{Fault, Status};
use crate::guid::options_of;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::log::{Category, Wanted};
use crate::options::Options;
use crate::standard::Standard;
use crate::step::StepReport;
use crate::unit::Unit;

/// The importer's end of the log: takes status, category and text.
pub(crate) type Sink = Box<dyn Fn(Status, &CStr, &CStr)>;

/// `fmi3IntermediateUpdateCallback`.
pub type IntermediateUpdate =
    unsafe extern "C" fn(*mut c_void, f64, u8, u8, u8, u8, *mut u8, *mut f64);

/// What an importer has agreed on with an instance.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Importer {
    pub standard: Standard,
    /// It integrates by itself: the instance is for model exchange.
    pub integrates: bool,
    /// What a step of co-simulation may come to.
    pub handling: Handling,
    /// What is called at events within a step, and with what.
    pub update: Option<(IntermediateUpdate, *mut c_void)>,
    /// What the FMU tells of.
    pub options: Options,
}

impl Importer {
    /// Whether the instance may be in event mode.
    pub(crate) fn has_event_mode(self) -> bool {
        self.handling.in_event_mode || self.integrates
    }
}

/// An instance with its log.
pub(crate) struct Component<U: Unit> {
    pub(crate) instance: Instance<U>,
    pub(crate) wanted: Wanted,
    pub(crate) importer: Importer,
    logging_on: bool,
    sink: Sink,
}

/// Sends one line.
fn send(sink: &Sink, status: Status, category: Category, text: &str) {
    let c_string = |text: &str| CString::new(text.replace('\0', " ")).unwrap_or_default();
    sink(
        status,
        &c_string(category.declaration().name),
        &c_string(text),
    );
}

/// Tells why no instance is made.
pub(crate) fn refuse(sink: &Sink, call: &str, fault: &Fault) {
    let text = format!("{call}: {fault}");
    send(sink, Status::Error, Category::Errors, &text);
}

impl<U: Unit> Component<U> {
    /// Makes an instance of an FMU with the options of this GUID, unless a check refuses what was asked for; then one line
    /// says why.
    ///
    /// # Safety
    /// Name and GUID are NULL or strings that end with NUL.
    pub(crate) unsafe fn instantiate(
        call: &str,
        name: *const c_char,
        (argument, guid): (&'static str, *const c_char),
        logging_on: bool,
        importer: Importer,
        sink: Sink,
        check: impl FnOnce(Result<Options, Fault>) -> Result<Options, Fault>,
    ) -> Option<Box<Self>> {
        // SAFETY: by this function's contract.
        let (name, guid) = unsafe { (string("instanceName", name), string(argument, guid)) };
        let checked = check_name(name).and_then(|()| {
            let guid = guid?;
            check(options_of::<U>(importer.standard, argument, &guid))
        });
        match checked {
            Ok(options) => Some(Box::new(Self {
                instance: Instance::new(),
                wanted: Wanted::all(logging_on),
                importer: Importer {
                    options,
                    ..importer
                },
                logging_on,
                sink,
            })),
            Err(fault) => {
                refuse(&sink, call, &fault);
                None
            }
        }
    }

    /// Sends one line, if lines of its category are wanted.
    pub(crate) fn log(&self, status: Status, category: Category, text: &str) {
        if self.wanted.has(category) {
            // Faults name functions as FMI 2.0 does.
            let text = text.replace("fmi2", self.importer.standard.prefix());
            send(&self.sink, status, category, &text);
        }
    }

    /// The instance, for functions of model exchange.
    pub(crate) fn exchange(&mut self) -> Result<&mut Instance<U>, Fault> {
        match self.importer.integrates {
            true => Ok(&mut self.instance),
            false => Err(Fault::NotOffered("the instance is for co-simulation")),
        }
    }

    /// The instance, for functions of co-simulation.
    pub(crate) fn co_simulation(&mut self) -> Result<&mut Instance<U>, Fault> {
        match self.importer.integrates {
            true => Err(Fault::NotOffered("the instance is for model exchange")),
            false => Ok(&mut self.instance),
        }
    }

    /// Leaves initialisation, for event mode if there is one.
    pub(crate) fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.instance.exit_initialization()?;
        match self.importer.integrates {
            true => self.instance.begin_exchange(),
            false if self.importer.has_event_mode() => self.instance.enter_event_mode(),
            false => Ok(()),
        }
    }

    /// Lets the instance go on, and tells of the events on the way and of a gap before it.
    pub(crate) fn reported<T>(
        &mut self,
        go_on: impl FnOnce(&mut Instance<U>, &mut StepReport) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let mut report = StepReport::new(self.wanted.has(Category::Events));
        let outcome = go_on(&mut self.instance, &mut report);
        if let Some(gap) = report.gap {
            let text = format!(
                "currentCommunicationPoint lies {gap:e} s from the end of the last step: the motion goes on \
                 without a gap"
            );
            self.log(Status::Ok, Category::Warnings, &text);
        }
        for event in &report.events.lines {
            self.log(Status::Ok, Category::Events, event);
        }
        outcome
    }

    /// Sets tolerance, start time and stop time; tells that the first is of no use to an exact solution.
    pub(crate) fn setup(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Result<(), Fault> {
        self.instance.setup(tolerance, start, stop)?;
        if let Some(tolerance) = tolerance {
            let text = format!("tolerance = {tolerance:e} has no effect: the motion is exact");
            self.log(Status::Ok, Category::Warnings, &text);
        }
        Ok(())
    }

    /// By FMI 3.0 an error ends the simulation: only a state that was kept, or a reset, leads back.
    pub(crate) fn note_error(&mut self) {
        let lifecycle = &mut self.instance.lifecycle;
        if self.importer.standard == Standard::Fmi3 && *lifecycle != Lifecycle::Failed {
            *lifecycle = Lifecycle::Erred;
        }
    }

    /// Everything as after instantiation, the log included.
    pub(crate) fn reset(&mut self) {
        self.instance = Instance::new();
        self.wanted = Wanted::all(self.logging_on);
    }
}

/// Refuses an instance without a name.
fn check_name(name: Result<Cow<str>, Fault>) -> Result<(), Fault> {
    match name?.is_empty() {
        true => Err(Fault::Instantiation("instanceName is empty".to_owned())),
        false => Ok(()),
    }
}
