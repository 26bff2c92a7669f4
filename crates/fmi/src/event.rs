//! Events that an importer sees (FMI 3.0): steps that end at them, and event mode.

use crate::exchange::Iteration;
use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::step::{StepReport, rounding_of};
use crate::unit::{Clock, Unit};

/// What an importer can do with events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Handling {
    /// It handles them, in event mode.
    pub in_event_mode: bool,
    /// A step may end at one.
    pub early: bool,
}

/// How a step ended that was carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Ending {
    /// There is something to handle in event mode.
    pub event: bool,
    /// It has not come to its end.
    pub early: bool,
}

impl<U: Unit> Instance<U> {
    /// Carries the unit on to `point + step`. Where a step may end early it ends at the first event: right before it if the
    /// importer handles it, else right after it. Where it may not, only an event at its very end is left to the importer.
    pub(crate) fn do_step_to_event(
        &mut self,
        point: f64,
        step: f64,
        handling: Handling,
        report: &mut StepReport,
    ) -> Result<Ending, Fault> {
        if self.awaits && handling.in_event_mode {
            return Err(self.not_allowed(
                "an event is due: fmi3EnterEventMode and fmi3UpdateDiscreteStates must come first",
            ));
        }
        self.pass_event(report)?;
        let (begin, end) = (self.time(), self.intended_end(point + step, step));
        let halt = match handling {
            Handling { early: true, .. } => Some(begin),
            Handling { in_event_mode, .. } => in_event_mode.then_some(end),
        };
        let goal = halt.map(|halt| (end, halt));
        let mut outcome = self.do_step(point, step, goal, report);
        let reaches_on = handling.early && self.time() > begin;
        match &mut outcome {
            Err(Fault::Discarded { .. }) if reaches_on => outcome = Ok(()),
            Err(Fault::Discarded { is_taken_back, .. }) => {
                self.take_back()?;
                *is_taken_back = true;
            }
            _ => {}
        }
        outcome?;
        self.fell_short = false;
        if self.awaits && !handling.in_event_mode {
            self.pass_event(report)?;
        }
        let early = handling.early && end - self.time() > rounding_of(end, step);
        self.aim = early.then_some(end);
        Ok(Ending {
            event: handling.in_event_mode && (self.awaits || report.events.happened),
            early,
        })
    }

    /// Goes on to right after the next event before `end` in s; whether there is one.
    pub(crate) fn go_to_event(&mut self, point: f64, end: f64) -> Result<bool, Fault> {
        let handling = Handling {
            in_event_mode: false,
            early: true,
        };
        let mut report = StepReport::new(false);
        let ending = self.do_step_to_event(point, end - point, handling, &mut report)?;
        Ok(ending.early && report.events.happened)
    }

    /// The end of a step: where one was to end that an event has ended before, but for the rounding of who adds up what is
    /// left of it.
    fn intended_end(&self, end: f64, step: f64) -> f64 {
        let is_meant = |aim: &f64| (end - aim).abs() <= rounding_of(end, step);
        self.aim.filter(is_meant).unwrap_or(end).max(self.time())
    }

    /// Goes back to where a discarded step began.
    fn take_back(&mut self) -> Result<(), Fault> {
        self.fell_short = false;
        let (unit, signals) = *self.retreat.take().ok_or_else(|| {
            Fault::Internal("the step ended on its way and cannot be taken back".to_owned())
        })?;
        (self.unit, self.signals) = (Some(unit), signals);
        Ok(())
    }

    /// Lets an event happen that is due.
    pub(crate) fn pass_event(&mut self, report: &mut StepReport) -> Result<(), Fault> {
        if let Some(unit) = self.unit.as_mut().filter(|_| self.awaits) {
            unit.pass_event(&mut report.events)?;
        }
        self.awaits = false;
        Ok(())
    }

    /// Enters event mode.
    pub(crate) fn enter_event_mode(&mut self) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Running],
            "event mode is entered from step mode",
        )?;
        self.lifecycle = Lifecycle::Event;
        Ok(())
    }

    /// Leaves event mode.
    pub(crate) fn enter_step_mode(&mut self) -> Result<(), Fault> {
        self.leave_event_mode()?;
        self.lifecycle = Lifecycle::Running;
        Ok(())
    }

    /// Takes over what was set in event mode.
    pub(crate) fn leave_event_mode(&mut self) -> Result<(), Fault> {
        self.require(&[Lifecycle::Event], "it is left from event mode")?;
        if self.awaits {
            return Err(self.not_allowed("an event is due: its handling must come first"));
        }
        self.settle().map(drop)
    }

    /// Lets an event happen that is due, takes over what was set, and tells when the next event comes.
    pub(crate) fn update_discrete_states(
        &mut self,
        report: &mut StepReport,
    ) -> Result<Iteration, Fault> {
        self.require(&[Lifecycle::Event], "it belongs to event mode")?;
        let iteration = match self.exchange {
            Some(_) => self.iterate_events(report)?,
            None => {
                self.pass_event(report)?;
                Iteration {
                    next: self.settle()?.next_event(),
                    has_new_states: false,
                    has_new_nominals: false,
                    is_unfinished: false,
                }
            }
        };
        if let Some(clock) = U::about().clock {
            self.ticks = (clock.count)(self.begun()?);
        }
        Ok(iteration)
    }

    /// Whether a clock ticks: in event mode, before the update of discrete states that tells of an event of its kind.
    pub(crate) fn is_ticking(&mut self, clock: &Clock<U>) -> Result<bool, Fault> {
        self.ready_for_outputs()?;
        if self.lifecycle != Lifecycle::Event {
            return Ok(false);
        }
        let mut updated = self.clone();
        updated.update_discrete_states(&mut StepReport::new(false))?;
        Ok((clock.count)(updated.begun()?) != self.ticks)
    }
}
