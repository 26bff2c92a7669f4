//! Model exchange: the importer solves for the states, and the unit tells their derivatives, and when an event comes.
//!
//! The unit keeps a motion of its own from the last event on, under the inputs of that time. It tells when that motion meets
//! its next event; at that event, or any other, the importer's states are replaced by those of this motion if they agree
//! with them within its integrator's errors. Otherwise, and once an input has changed, the unit goes on from the importer's states.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::solving::{Exchange, derivatives_of, space_of, states_of};
use crate::step::{StepReport, rounding_of};
use crate::unit::{Advance, Events, Unit};

/// Share of the time within which importers do not tell two times apart: FMPy and fmi-sim take 1e-9.
const SAME_TIME: f64 = 2e-9;
/// Times near 0 that importers do not tell apart, in s.
const SAME_START: f64 = 1e-12;
/// Integrator steps ahead within which an event that comes sooner than was told is worth a step event.
const STEPS_AHEAD: f64 = 10.0;
/// Events that are handled in one iteration, at most.
const MOST_TOGETHER: u32 = 10_000;

/// What an event iteration comes to.
pub(crate) struct Iteration {
    /// When the next event comes, in s.
    pub next: Option<f64>,
    /// States, or what is much of them, are others than before.
    pub has_new_states: bool,
    pub has_new_nominals: bool,
    /// More events are due.
    pub is_unfinished: bool,
}

/// The time from which on an importer that stands at `time` in s can tell another one.
fn end_of_present(time: f64) -> f64 {
    time + SAME_TIME * time.abs() + SAME_START
}

impl<U: Unit> Instance<U> {
    /// Goes on in event mode, for an importer that solves for the states.
    pub(crate) fn begin_exchange(&mut self) -> Result<(), Fault> {
        let own = self.settle()?.clone();
        self.lifecycle = Lifecycle::Event;
        self.exchange = Some(Exchange::new(own, self.signals.clone()).into());
        Ok(())
    }

    fn exchange(&mut self, lives: &[Lifecycle]) -> Result<&mut Exchange<U>, Fault> {
        self.require(
            lives,
            "model exchange goes from event mode to continuous-time mode and back",
        )?;
        let none = Fault::NotOffered("the instance is for co-simulation");
        self.exchange.as_deref_mut().ok_or(none)
    }

    /// Takes the importer's time.
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), Fault> {
        let is_event = self.lifecycle == Lifecycle::Event;
        let exchange = self.exchange(&[Lifecycle::Continuous, Lifecycle::Event])?;
        let event = exchange.event;
        let most = if is_event { event } else { f64::MAX };
        if !(time >= event - rounding_of(event, 0.0) && time <= most) {
            let allowed = "finite and not before the last event; in event mode it stands still";
            return Err(Fault::argument("time", time, allowed));
        }
        (exchange.time, exchange.is_shown) = (time, is_event);
        Ok(())
    }

    /// Takes the importer's states.
    pub(crate) fn set_states(&mut self, states: &[f64]) -> Result<(), Fault> {
        check_states::<U>(states.len())?;
        let exchange = self.exchange(&[Lifecycle::Continuous])?;
        if let Some(value) = states.iter().find(|value| !value.is_finite()) {
            return Err(Fault::argument("state", *value, "finite").refused());
        }
        exchange.states.copy_from_slice(states);
        exchange.is_shown = false;
        Ok(())
    }

    /// Reads the states.
    pub(crate) fn get_states(&mut self, states: &mut [f64]) -> Result<(), Fault> {
        check_states::<U>(states.len())?;
        self.ready_for_outputs()?;
        match (&self.exchange, self.lifecycle) {
            (Some(exchange), Lifecycle::Continuous) => states.copy_from_slice(&exchange.states),
            _ => states.copy_from_slice(&states_of(self.begun()?)),
        }
        Ok(())
    }

    /// Reads the derivatives of the states.
    pub(crate) fn get_state_derivatives(&mut self, derivatives: &mut [f64]) -> Result<(), Fault> {
        check_states::<U>(derivatives.len())?;
        self.ready_for_outputs()?;
        derivatives.copy_from_slice(&derivatives_of(self.begun()?));
        Ok(())
    }

    /// Reads the event indicators.
    pub(crate) fn get_indicators(&mut self, indicators: &mut [f64]) -> Result<(), Fault> {
        let references = space_of::<U>().indicators;
        check_size("event indicators", indicators.len(), references.len())?;
        self.ready_for_outputs()?;
        let (table, unit) = (&U::about().table, self.begun()?);
        for (value, &reference) in indicators.iter_mut().zip(references) {
            *value = table.number(unit, reference);
        }
        Ok(())
    }

    /// Reads what is much of each state.
    pub(crate) fn get_nominals(&self, nominals: &mut [f64]) -> Result<(), Fault> {
        check_states::<U>(nominals.len())?;
        match &self.exchange {
            Some(exchange) => nominals.copy_from_slice(&exchange.nominals),
            None => {
                nominals.copy_from_slice(&U::begin(&self.values, self.time())?.nominals());
            }
        }
        Ok(())
    }

    pub(crate) fn begun(&self) -> Result<&U, Fault> {
        self.unit.as_ref().ok_or_else(|| self.no_outputs())
    }

    /// Lets the unit be as the importer's time, states and inputs say, under the law that holds.
    pub(crate) fn show(&mut self) -> Result<(), Fault> {
        let Some(exchange) = self.exchange.as_deref_mut().filter(|it| !it.is_shown) else {
            return Ok(());
        };
        let at_states = |unit: &U| unit.at_states(exchange.time, &exchange.states);
        let mut unit = at_states(&exchange.own)?;
        for (number, signal) in self.signals.iter().enumerate() {
            if signal.pending {
                // Under other inputs the law may be another one, which keeps the unit within its ends.
                unit.drive(number, &signal.derivatives)?;
                unit = at_states(&unit)?;
            }
        }
        unit.keep_law(&exchange.own);
        self.unit = Some(unit);
        exchange.is_shown = true;
        Ok(())
    }

    /// Takes what the importer has set for the unit's own motion.
    fn rebase(&mut self) -> Result<(), Fault> {
        self.show()?;
        for signal in &mut self.signals {
            signal.pending = false;
        }
        if let (Some(exchange), Some(unit)) = (self.exchange.as_deref_mut(), &self.unit) {
            exchange.own.clone_from(unit);
            exchange.inputs.clone_from(&self.signals);
        }
        Ok(())
    }

    /// Takes an integrator step that is accepted; whether event mode must be entered, since an input has changed such that an
    /// event comes sooner than the importer knows.
    pub(crate) fn complete_step(&mut self) -> Result<bool, Fault> {
        let exchange = self.exchange(&[Lifecycle::Continuous])?;
        let (time, step) = (exchange.time, exchange.time - exchange.completed);
        exchange.completed = time;
        if self.signals.iter().any(|signal| signal.pending) {
            self.rebase()?;
            let next = self.begun()?.next_event();
            self.exchange(&[Lifecycle::Continuous])?.next = next;
        }
        let exchange = self.exchange(&[Lifecycle::Continuous])?;
        let told = exchange.told.unwrap_or(f64::INFINITY);
        let soon = time + STEPS_AHEAD * step;
        Ok(exchange
            .next
            .is_some_and(|next| next < told && next <= soon))
    }

    /// Enters event mode from continuous-time mode, in the unit's own states if the importer's agree with them.
    pub(crate) fn enter_event_mode_of_exchange(&mut self) -> Result<(), Fault> {
        let is_driven = self.signals.iter().any(|signal| signal.pending);
        let exchange = self.exchange(&[Lifecycle::Continuous])?;
        let time = exchange.time;
        exchange.event = time;
        if is_driven || !exchange.agrees() {
            exchange.is_shown = false;
            self.rebase()?;
        } else {
            self.unit = Some(exchange.own.clone());
        }
        self.lifecycle = Lifecycle::Event;
        self.awaits = self.reach_event(time, &mut Events::default())?;
        Ok(())
    }

    /// Goes on to right before an event that is due at `time` in s; if there is none, up to there.
    fn reach_event(&mut self, time: f64, events: &mut Events) -> Result<bool, Fault> {
        let Some(unit) = self.unit.as_mut() else {
            return Err(self.no_outputs());
        };
        let next = unit.next_event();
        let due = next.filter(|next| *next <= end_of_present(time) || unit.is_passing());
        if due.is_none() && time <= unit.time() {
            return Ok(false);
        }
        // One that is due is the first from here on.
        let (until, halt) = match due {
            Some(next) => (end_of_present(next.max(unit.time())), unit.time()),
            None => (time, time),
        };
        match unit.advance(until, Some(halt), events)? {
            Advance::Event => Ok(true),
            Advance::Arrived => Ok(due.is_some()),
            Advance::Short { reason, .. } => Err(Fault::Unit(reason.into())),
        }
    }

    /// Lets all events happen that are due, takes over what was set, and tells when the next one comes.
    pub(crate) fn iterate_events(&mut self, report: &mut StepReport) -> Result<Iteration, Fault> {
        let exchange = self.exchange(&[Lifecycle::Event])?;
        let time = exchange.time;
        let before = exchange.states.clone();
        for _ in 0..MOST_TOGETHER {
            self.pass_event(report)?;
            self.settle()?;
            self.awaits = self.reach_event(time, &mut report.events)?;
            if !self.awaits {
                break;
            }
        }
        let (is_unfinished, next) = (self.awaits, self.go_on_from_event()?);
        let exchange = self.exchange(&[Lifecycle::Event])?;
        exchange.told = next;
        let nominals = exchange.own.nominals();
        let has_new_nominals = nominals != exchange.nominals;
        exchange.nominals = nominals;
        Ok(Iteration {
            next,
            has_new_states: exchange.states != before,
            has_new_nominals,
            is_unfinished,
        })
    }

    /// Lets the unit's own motion begin where the unit is; when its next event comes.
    fn go_on_from_event(&mut self) -> Result<Option<f64>, Fault> {
        let own = self.settle()?.clone();
        let (next, states) = (own.next_event(), states_of(&own));
        if let Some(exchange) = self.exchange.as_deref_mut() {
            (exchange.own, exchange.states, exchange.next) = (own, states, next);
            exchange.inputs.clone_from(&self.signals);
            exchange.is_shown = false;
        }
        Ok(next)
    }

    /// Leaves event mode for continuous-time mode.
    pub(crate) fn enter_continuous_time_mode(&mut self) -> Result<(), Fault> {
        let exchange = self.exchange(&[Lifecycle::Event])?;
        exchange.completed = exchange.time;
        let is_changed = self.tuned || self.signals.iter().any(|signal| signal.pending);
        self.leave_event_mode()?;
        if is_changed {
            self.go_on_from_event()?;
        }
        self.lifecycle = Lifecycle::Continuous;
        Ok(())
    }
}

fn check_states<U: Unit>(value: usize) -> Result<(), Fault> {
    let wanted = space_of::<U>().states.len();
    check_size("continuous states", value, wanted)
}

fn check_size(what: &'static str, value: usize, wanted: usize) -> Result<(), Fault> {
    match value == wanted {
        true => Ok(()),
        false => Err(Fault::Size {
            what,
            value,
            wanted,
        }),
    }
}
