//! What the importer's handle points to: an instance and the way to the importer's log.

use std::borrow::Cow;
use std::ffi::{CStr, CString};

use crate::fault::{Fault, Status};
use crate::instance::Instance;
use crate::log::{Category, Wanted};
use crate::step::StepReport;
use crate::unit::Unit;

/// The importer's end of the log: takes status, category and text.
pub(crate) type Sink = Box<dyn Fn(Status, &CStr, &CStr)>;

/// What an importer has agreed on with an instance, by one of the standards.
pub(crate) trait Host {
    /// What the names of the standard's functions begin with.
    const PREFIX: &'static str;

    /// Whether the instance may be in event mode.
    fn has_event_mode(&self) -> bool {
        false
    }

    /// Whether the importer integrates by itself.
    fn is_for_exchange(&self) -> bool;

    /// What a call that failed does to the instance.
    fn note_error<U: Unit>(&self, _instance: &mut Instance<U>) {}
}

/// An instance with its log.
pub(crate) struct Component<U: Unit, H> {
    pub(crate) instance: Instance<U>,
    pub(crate) wanted: Wanted,
    pub(crate) host: H,
    logging_on: bool,
    sink: Sink,
}

/// Sends one line.
fn send(sink: &Sink, status: Status, category: Category, text: &str) {
    let c_string = |text: &str| CString::new(text.replace('\0', " ")).unwrap_or_default();
    sink(status, &c_string(category.about().0), &c_string(text));
}

impl<U: Unit, H: Host> Component<U, H> {
    /// Makes an instance, unless something of what was asked for does not fit; then one line says why.
    pub(crate) fn new(
        call: &str,
        checked: Result<(), Fault>,
        logging_on: bool,
        host: H,
        sink: Sink,
    ) -> Option<Box<Self>> {
        if let Err(fault) = checked {
            let text = format!("{call}: {fault}");
            send(&sink, Status::Error, Category::Errors, &text);
            return None;
        }
        Some(Box::new(Self {
            instance: Instance::new(),
            wanted: Wanted::all(logging_on),
            host,
            logging_on,
            sink,
        }))
    }

    /// Sends one line, if lines of its category are wanted.
    pub(crate) fn log(&self, status: Status, category: Category, text: &str) {
        if self.wanted.has(category) {
            // Faults name functions as FMI 2.0 does.
            let text = text.replace("fmi2", H::PREFIX);
            send(&self.sink, status, category, &text);
        }
    }

    /// The instance, for functions of model exchange.
    pub(crate) fn exchange(&mut self) -> Result<&mut Instance<U>, Fault> {
        match self.host.is_for_exchange() {
            true => Ok(&mut self.instance),
            false => Err(Fault::NotOffered("the instance is for co-simulation")),
        }
    }

    /// The instance, for functions of co-simulation.
    pub(crate) fn co_simulation(&mut self) -> Result<&mut Instance<U>, Fault> {
        match self.host.is_for_exchange() {
            true => Err(Fault::NotOffered("the instance is for model exchange")),
            false => Ok(&mut self.instance),
        }
    }

    /// Leaves initialisation, for event mode if there is one.
    pub(crate) fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.instance.exit_initialization()?;
        match self.host.is_for_exchange() {
            true => self.instance.begin_exchange(),
            false if self.host.has_event_mode() => self.instance.enter_event_mode(),
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

    /// Tells that a tolerance is of no use to an exact solution.
    pub(crate) fn tell_tolerance(&self, tolerance: f64) {
        let text = format!("tolerance = {tolerance:e} has no effect: the motion is exact");
        self.log(Status::Ok, Category::Warnings, &text);
    }

    /// Everything as after instantiation, the log included.
    pub(crate) fn reset(&mut self) {
        self.instance = Instance::new();
        self.wanted = Wanted::all(self.logging_on);
    }
}

/// Refuses an instance without a name.
pub(crate) fn check_name(name: Result<Cow<str>, Fault>) -> Result<(), Fault> {
    match name?.is_empty() {
        true => Err(Fault::Instantiation("instanceName is empty".to_owned())),
        false => Ok(()),
    }
}
