//! What a unit is: a table of variables and a motion that can be advanced; its state space for model exchange, and its clock.

use std::error::Error;
use std::sync::OnceLock;

use serde::Serialize;
use serde::de::DeserializeOwned;
use uuid::Uuid;

use crate::block::Block;
use crate::quantity::{Enumeration, Quantity};
use crate::signal::Derivatives;
use crate::table::Table;
use crate::terminal::Terminal;
use crate::variable::{Slot, Variable};

/// What a unit can refuse, with a text for the importer's log that names the variable.
pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// A unit under way. Lifecycle, values and inputs are kept for it, and
/// [`fmi2_functions`](crate::fmi2_functions) and [`fmi3_functions`](crate::fmi3_functions) give it the functions of a
/// standard.
///
/// To make another unit, write its [`About`] with the table of variables and its [`Block`] as two
/// statics, implement the methods without a body, call a macro of functions and then `export_fmi2!`
/// or `export_fmi3!` in a `cdylib` for each standard.
/// `tests/tank/mod.rs` is one in a page.
///
/// Its clone, and what is read back from its bytes, must go on bit for bit.
pub trait Unit: Clone + Send + Serialize + DeserializeOwned + 'static {
    /// Derivatives of the outputs along a direction; `()` for a unit without them.
    type Tangent;

    /// What the unit says of itself.
    fn about() -> &'static About<Self>;

    /// The block of start values in this library.
    fn block() -> &'static Block;

    /// The unit at `time` in s with these values of parameters and discrete inputs, slot by slot.
    fn begin(values: &[f64], time: f64) -> Outcome<Self>;

    /// Where it is, in s.
    fn time(&self) -> f64;

    /// Whether values of parameters go together, wherever the unit is.
    fn check_values(_values: &[f64]) -> Outcome<()> {
        Ok(())
    }

    /// Takes over values that were set on the way.
    fn tune(&mut self, values: &[f64]) -> Outcome<()>;

    /// Goes on to `until` in s, which is not in the past, and tells of events on the way; with `halt` in s, to right before
    /// the first event that does not happen before that. One that happens at `until` but for rounding is on the way.
    fn advance(
        &mut self,
        until: f64,
        halt: Option<f64>,
        events: &mut Events,
    ) -> Outcome<Advance<Self>>;

    /// Whether there are events that [`Unit::advance`] halts at.
    const HAS_EVENTS: bool = false;

    /// Lets the event happen that it stands before.
    fn pass_event(&mut self, _events: &mut Events) -> Outcome<()> {
        Ok(())
    }

    /// When the next event happens if nothing is set, in s, as far as it can be told now.
    fn next_event(&self) -> Option<f64> {
        None
    }

    /// The unit at another time in s in other states of [`StateSpace`], under the law that holds, wherever that leads.
    ///
    /// # Errors
    /// By default always: a unit without states.
    fn at_states(&self, _time: f64, _states: &[f64]) -> Outcome<Self> {
        Err("the unit has no continuous states".into())
    }

    /// Goes on by the law of another one, whatever the inputs ask for, and stands before the event that ends it if that is
    /// passed.
    fn keep_law(&mut self, _of: &Self) {}

    /// What is much of each state.
    fn nominals(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Whether the law that holds is over before an importer could tell: its end belongs to the event that it began with.
    fn is_passing(&self) -> bool {
        false
    }

    /// Takes the derivatives that a continuous input has from now on.
    fn drive(&mut self, _signal: usize, _derivatives: &Derivatives) -> Outcome<()> {
        Ok(())
    }

    /// Whether `until` in s, which is not in the past, can be advanced to at all.
    fn check_reach(&self, _until: f64) -> Outcome<()> {
        Ok(())
    }

    /// Number of the smooth law that holds now: across another one no differences are taken.
    fn law(&self) -> i32 {
        0
    }

    /// Begins the stretch that [`Unit::tangent`] leads over; each advance begins one as well.
    fn set_checkpoint(&mut self) {}

    /// Whether there are derivatives by `known` over the stretch up to now.
    fn has_tangent(&self, _known: Known) -> bool {
        false
    }

    /// The derivatives of the outputs now by what was known at the beginning of the stretch, along the
    /// direction of these knowns.
    fn tangent(&self, direction: &[(Known, f64)]) -> Outcome<Self::Tangent>;
}

/// The table's rows for a unit.
pub type Row<U> = Variable<U, <U as Unit>::Tangent>;

/// What derivatives can be taken by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// A continuous input, by its number.
    Signal(usize),
    /// A parameter.
    Parameter(Slot),
    /// A continuous state, by its number, for an importer that integrates: as it is now, under the law that holds.
    State(usize),
}

/// How far an advance came.
pub enum Advance<U> {
    /// All the way.
    Arrived,
    /// To right before an event.
    Event,
    /// A part of the way: the step is discarded.
    Short {
        /// Why it ended there, in words.
        reason: String,
        /// The unit as it was before; without it the step cannot be repeated.
        before: Option<Box<U>>,
    },
}

/// Lines for the log category `events`.
#[derive(Debug, Default)]
pub struct Events {
    pub(crate) wanted: bool,
    pub(crate) lines: Vec<String>,
    pub(crate) happened: bool,
}

impl Events {
    /// Notes that an event has happened.
    pub fn note(&mut self) {
        self.happened = true;
    }

    /// Adds a line, if lines are wanted.
    pub fn tell(&mut self, line: impl FnOnce() -> String) {
        if self.wanted {
            self.lines.push(line());
        }
    }
}

/// What an importer integrates in model exchange, by value references.
#[derive(Debug)]
pub struct StateSpace {
    /// The continuous states.
    pub states: &'static [State],
    /// Variables whose sign tells of an event.
    pub indicators: &'static [u32],
}

/// A continuous state, by value references.
#[derive(Debug)]
pub struct State {
    /// The state.
    pub value: u32,
    /// Its time derivative.
    pub derivative: u32,
    /// The parameter that it begins with.
    pub start: u32,
}

/// A clock that ticks at events of one kind, in event mode of FMI 3.0, for an FMU that tells of it.
#[derive(Debug)]
pub struct Clock<U: 'static> {
    /// Value reference, which no variable has.
    pub reference: u32,
    /// Public name.
    pub name: &'static str,
    /// When it ticks, in one sentence.
    pub description: &'static str,
    /// How many of these events there were.
    pub count: fn(&U) -> i32,
}

/// What a unit says of itself, in the XML and in the documentation.
pub struct About<U: Unit> {
    /// `modelIdentifier`: the name of the binaries' files.
    pub identifier: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Its licence.
    pub license: &'static str,
    /// Who wrote it.
    pub author: &'static str,
    /// Who has the rights.
    pub copyright: &'static str,
    /// Date and time of the version (UTC), as in the XML.
    pub date: &'static str,
    /// What the log category `events` tells; empty if the unit has none.
    pub events: &'static str,
    /// What derivatives can be taken by after initialisation, to follow "there are those by".
    pub knowns: &'static str,
    /// Attributes of `DefaultExperiment`: (name, value).
    pub experiment: &'static [(&'static str, &'static str)],
    /// All quantities in use, each with a unit of its own.
    pub quantities: &'static [&'static Quantity],
    /// All enumeration types in use.
    pub enumerations: &'static [&'static Enumeration],
    /// What is connected together in FMI 3.0, one terminal at least.
    pub terminals: &'static [Terminal],
    /// Its variables.
    pub table: Table<U, U::Tangent>,
    /// What model exchange needs; nothing for a unit that is for co-simulation only.
    pub state_space: Option<&'static StateSpace>,
    /// Its clock, if it has one.
    pub clock: Option<&'static Clock<U>>,
    /// The documentation page, with marks for name, version, capabilities and variables.
    pub page: &'static str,
    /// Further files of the package: (path, content).
    pub files: &'static [(&'static str, &'static [u8])],
    /// The library's GUID, once it is known; empty at first.
    pub guid: OnceLock<Uuid>,
}

/// Files of a package: where they lie in it, and beside the source that calls this.
#[macro_export]
macro_rules! files {
    ($($place:literal = $path:literal;)*) => {
        &[$(($place, include_bytes!($path).as_slice())),*]
    };
}
