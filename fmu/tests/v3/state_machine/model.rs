//! The state machine of the standard: what may come of each call.

use super::call::{Call, Vector, Where};
use crate::common::{DISCARD, ERROR, OK, Statuses, if_all};
use crate::v3::arrays::ELEMENTS;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Life {
    Instantiated,
    Initializing,
    Event,
    Step,
    Continuous,
    Terminated,
}
use Life::{Continuous, Event, Initializing, Instantiated, Step, Terminated};

/// An instance as its importer must imagine it.
#[derive(Debug, Clone, Copy)]
pub struct Model {
    pub life: Life,
    pub time: f64,
    /// An event was reported that has not been handled.
    pub awaits: bool,
    /// Initialisation was left, so that there are outputs whatever comes.
    pub begun: bool,
    /// The importer integrates.
    pub is_for_exchange: bool,
    /// When event mode was entered last, and whether events were updated since.
    pub event: f64,
    pub updated: bool,
}

impl Model {
    pub fn new(is_for_exchange: bool) -> Self {
        Self {
            life: Instantiated,
            time: 0.0,
            awaits: false,
            begun: false,
            is_for_exchange,
            event: 0.0,
            updated: true,
        }
    }

    fn is(&self, lives: &[Life]) -> bool {
        lives.contains(&self.life)
    }

    fn is_settable(&self) -> bool {
        self.life != Terminated
    }

    /// What may come of what needs outputs where it is allowed in these states.
    fn of_outputs(&self, lives: &[Life], otherwise: Statuses) -> Statuses {
        match self.life {
            Terminated if !self.begun => &[OK, DISCARD, ERROR],
            life if lives.contains(&life) => &[OK],
            _ => otherwise,
        }
    }

    /// Whether a state was kept by an instance of the other interface type.
    fn is_of_other_type(&self, kept: &Self) -> bool {
        let is_of_exchange = kept.is_for_exchange && kept.begun;
        match self.is_for_exchange {
            true => !is_of_exchange && !kept.is(&[Instantiated, Initializing]),
            false => is_of_exchange,
        }
    }

    pub fn expected(&self, call: Call, handling: (bool, bool), kept: Option<&Self>) -> Statuses {
        let exchanges = self.is_for_exchange;
        match call {
            Call::EnterStep | Call::DoStep(..) | Call::OutputDerivative(_) if exchanges => &[ERROR],
            Call::EnterEvent if exchanges => if_all(&[self.life == Continuous]),
            Call::EnterContinuous => match self.life == Event && exchanges {
                // An event may be due.
                true if !self.updated => &[OK, ERROR],
                is_allowed => if_all(&[is_allowed]),
            },
            Call::Complete => if_all(&[self.life == Continuous]),
            Call::SetTime(ahead) => if_all(&[
                exchanges && self.is(&[Event, Continuous]),
                self.time + ahead >= self.event,
                self.life == Continuous || ahead == 0.0,
            ]),
            Call::SetStates(states) => match self.life == Continuous && states.len() == 2 {
                true if states.iter().any(|state| !state.is_finite()) => &[DISCARD],
                is_allowed => if_all(&[is_allowed]),
            },
            Call::GetStates(of, count) => match (of, count) {
                _ if !exchanges => &[ERROR],
                (Vector::Nominals, 2) => &[OK],
                (Vector::Indicators, 3) | (Vector::States | Vector::Derivatives, 2) => {
                    self.of_outputs(&[Initializing, Event, Continuous, Terminated], &[ERROR])
                }
                _ => &[ERROR],
            },
            Call::EnterInitialization(start) => {
                if_all(&[self.life == Instantiated, start.is_finite()])
            }
            Call::ExitInitialization => if_all(&[self.life == Initializing]),
            Call::EnterEvent => if_all(&[self.life == Step, handling.0]),
            Call::EnterStep => if_all(&[self.life == Event, !self.awaits]),
            Call::Update => if_all(&[self.life == Event]),
            Call::Terminate => if_all(&[self.is(&[Event, Step, Continuous])]),
            Call::Reset | Call::GetState(_) | Call::Logging(true) => &[OK],
            Call::Get("position" | "phase" | "impact.count") | Call::GetClock => {
                let lives = [Initializing, Event, Step, Continuous, Terminated];
                self.of_outputs(&lives, &[DISCARD])
            }
            Call::Get(_) => &[OK],
            Call::GetArray(count) => if_all(&[count == ELEMENTS]),
            Call::SetArray(count) => {
                if_all(&[count == ELEMENTS, self.is(&[Instantiated, Initializing])])
            }
            Call::Set(name, value) => match name {
                _ if !self.is_settable() => &[ERROR],
                "position" if self.life != Continuous => &[ERROR],
                "mass" if self.is(&[Event, Step, Continuous]) => &[ERROR],
                _ if !(value.is_finite() && value.abs() < 1e12) => &[DISCARD],
                // Another value waits for an event; the one that holds may be set.
                _ if self.life == Continuous && !["force", "position"].contains(&name) => {
                    &[OK, DISCARD]
                }
                _ => &[OK],
            },
            Call::DoStep(at, size) => if_all(&[
                self.life == Step,
                !self.awaits,
                size.is_finite() && size > 0.0,
                at == Where::Present,
            ]),
            Call::Directional(known) | Call::Adjoint(known) => match known {
                // In initialisation every real parameter is a known.
                "clearance" if self.life == Initializing => &[OK],
                "clearance" if exchanges && self.begun => if_all(&[self.life == Event]),
                "velocity" if exchanges && self.begun => {
                    self.of_outputs(&[Event, Continuous, Terminated], &[ERROR])
                }
                "force" => {
                    let lives = [Initializing, Event, Step, Continuous, Terminated];
                    self.of_outputs(&lives, &[ERROR])
                }
                _ => &[ERROR],
            },
            Call::OutputDerivative(order) => match order {
                1 | 2 => self.of_outputs(&[Step, Terminated], &[ERROR]),
                _ => &[ERROR],
            },
            Call::SetState(_) => if_all(&[
                kept.is_some_and(|kept| handling.0 || !(kept.awaits || kept.life == Event)),
                kept.is_none_or(|kept| !self.is_of_other_type(kept)),
            ]),
            Call::Copy(_) => if_all(&[kept.is_some()]),
            Call::SetClock
            | Call::Element
            | Call::UnknownVariable
            | Call::OtherType
            | Call::TooFewValues
            | Call::NullValues
            | Call::DamagedBytes(_)
            | Call::Logging(false)
            | Call::Absent(_) => &[ERROR],
        }
    }
}
