//! Setting the values of an instance.

use std::mem;

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::reading::{Type, find};
use crate::signal::{Derivatives, Signal};
use crate::solving::number_of_state;
use crate::unit::{Events, Outcome, Row, Unit};
use crate::variable::Access;

impl<U: Unit> Instance<U> {
    /// Sets values of one type: all of them, or none if one is refused.
    pub(crate) fn set<T: Copy>(
        &mut self,
        references: &[u32],
        values: &[T],
        wanted: Type,
        number: impl Fn(T) -> f64,
    ) -> Result<(), Fault> {
        self.require_settable()?;
        let all = || {
            let values = values.iter().map(|&value| number(value));
            references.iter().zip(values)
        };
        let mut changes = false;
        for (&reference, value) in all() {
            let variable = find::<U>(reference, wanted)?;
            self.check_settable(variable)?;
            if !variable.kind.contains(value) {
                let range = variable.kind.range();
                return Err(Fault::argument(variable.name, value, &range));
            }
            let held = variable.slot().map(|slot| self.values[slot.0]);
            let is_new = held.is_some_and(|held| held != value);
            if is_new && self.lifecycle == Lifecycle::Continuous {
                return Err(Fault::OnlyAtEvents(variable.name));
            }
            changes |= is_new;
        }
        if changes {
            let mut after = self.values.clone();
            for (&reference, value) in all() {
                if let Some(slot) = find::<U>(reference, wanted)?.slot() {
                    after[slot.0] = value;
                }
            }
            self.adopt(after)?;
        }
        for (&reference, value) in all() {
            let variable = find::<U>(reference, wanted)?;
            if let Access::Signal(number) = variable.access {
                let mut derivatives = Derivatives::default();
                derivatives[0] = value;
                self.push(number, derivatives);
            }
            if let (Some(number), Some(exchange)) = (number_of_state(variable), &mut self.exchange)
            {
                (exchange.states[number], exchange.is_shown) = (value, false);
            }
        }
        Ok(())
    }

    pub(crate) fn require_settable(&self) -> Result<(), Fault> {
        use Lifecycle::{Continuous, Event, Initializing, Instantiated, Running};
        let remedy = "values can be set again after fmi2Reset";
        self.require(
            &[Instantiated, Initializing, Running, Event, Continuous],
            remedy,
        )
    }

    fn check_settable(&self, variable: &Row<U>) -> Result<(), Fault> {
        let name = variable.name;
        match variable.access {
            Access::Parameter { tunable: false, .. } if self.lifecycle.is_under_way() => {
                Err(Fault::Fixed(name))
            }
            Access::Parameter { .. } | Access::Signal(_) | Access::Input(_) => Ok(()),
            // A state is the importer's while it integrates.
            _ if self.lifecycle == Lifecycle::Continuous && number_of_state(variable).is_some() => {
                Ok(())
            }
            _ => Err(Fault::Output(name)),
        }
    }

    /// Takes over values, unless the unit under way cannot go on with them. Those that do not go together may yet with
    /// what is set next.
    fn adopt(&mut self, values: Vec<f64>) -> Result<(), Fault> {
        let before = mem::replace(&mut self.values, values);
        if self.lifecycle.is_under_way()
            && let Some(unit) = &self.unit
        {
            if U::check_values(&self.values).is_err() {
                self.sound.get_or_insert(before);
            } else if let Err(error) = self.try_to_tune(unit.clone()) {
                self.values = before;
                return Err(error.into());
            } else {
                self.sound = None;
            }
        }
        self.tuned = true;
        self.begin_anew();
        Ok(())
    }

    fn try_to_tune(&self, mut unit: U) -> Outcome<()> {
        if self.awaits {
            unit.pass_event(&mut Events::default())?;
        }
        unit.tune(&self.values)
    }

    /// What is set before the first step makes another beginning; a unit under way takes it over later.
    fn begin_anew(&mut self) {
        if !self.lifecycle.is_under_way() {
            self.unit = None;
        }
    }

    /// A continuous input from now on; setting what holds anyway changes nothing.
    pub(crate) fn push(&mut self, number: usize, derivatives: Derivatives) {
        if let Some(exchange) = self.exchange.as_mut()
            && self.lifecycle == Lifecycle::Continuous
        {
            let own = exchange.inputs[number];
            let changed = Signal {
                derivatives,
                since: exchange.time,
                pending: true,
            };
            let is_own = own.is_same_value(derivatives[0]);
            self.signals[number] = if is_own { own } else { changed };
            exchange.is_shown = false;
            return;
        }
        if let Some(unit) = self.unit.as_mut().filter(|_| !self.awaits) {
            unit.set_checkpoint();
        }
        let now = self.time();
        let signal = &mut self.signals[number];
        if signal.seen_from(now) == derivatives {
            return;
        }
        *signal = Signal {
            derivatives,
            since: now,
            pending: true,
        };
        self.begin_anew();
    }
}
