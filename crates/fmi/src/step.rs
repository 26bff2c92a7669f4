//! The communication step.

use crate::fault::Fault;
use crate::instance::Instance;
use crate::lifecycle::Lifecycle;
use crate::signal::Signal;
use crate::unit::{Advance, Events, Unit};

/// What there is to tell of a step.
#[derive(Debug)]
pub(crate) struct StepReport {
    /// What happened.
    pub events: Events,
    /// How far the communication point lay from the end of the last step, in s, if further than by
    /// rounding.
    pub gap: Option<f64>,
}

impl StepReport {
    /// Nothing so far; with events or without.
    pub(crate) fn new(wants_events: bool) -> Self {
        Self {
            events: Events {
                wanted: wants_events,
                ..Events::default()
            },
            gap: None,
        }
    }
}

/// How far a communication point may lie from the end of the last step.
///
/// Importers add up step sizes or multiply them, so the two differ by rounding. A step goes from
/// where the last one ended to `point + step`, so no difference is ever added up: a few units in
/// the last place would do. A billionth of the time leaves room for importers that count in
/// nanoseconds. Half a step is the limit in any case: a step that is called twice is refused.
fn drift_tolerance(present: f64, step: f64) -> f64 {
    let counting = 1e-9 * present.abs().max(1.0);
    counting.min(0.5 * step).max(rounding_of(present, 0.0))
}

/// What adding up a time in such steps may bring.
pub(crate) fn rounding_of(time: f64, step: f64) -> f64 {
    16.0 * f64::EPSILON * time.abs().max(step)
}

impl<U: Unit> Instance<U> {
    /// Carries the unit on to `point + step`, whatever happens on the way, and adds to the report; or to such a time and
    /// halt as [`Unit::advance`] takes.
    /// [`Fault::Discarded`] if it did not get that far: [`Instance::time`] is then where it is, and the
    /// next step may begin there, or where this one began.
    pub(crate) fn do_step(
        &mut self,
        point: f64,
        step: f64,
        goal: Option<(f64, f64)>,
        report: &mut StepReport,
    ) -> Result<(), Fault> {
        self.require(
            &[Lifecycle::Running],
            "a step needs an initialised unit that has not failed or ended",
        )?;
        let end = end_of_step(point, step)?;
        let stop = self.experiment.and_then(|experiment| experiment.stop);
        if let Some(stop) = stop.filter(|stop| end > stop + 1e-9 * stop.abs().max(1.0)) {
            return Err(Fault::BeyondStop { end, stop });
        }
        if let Some(unit) = &self.unit {
            unit.check_reach(end.max(unit.time()))?;
        }
        self.retry(point, step);
        let present = self.time();
        let tolerance = drift_tolerance(present, step);
        if (point - present).abs() > tolerance {
            return Err(Fault::CommunicationPoint {
                point,
                present,
                tolerance,
            });
        }
        let unit = self.settle()?;
        // A step below the last digit of the time ends where it began.
        let (until, halt) = goal.map_or((end.max(present), None), |(until, halt)| {
            (until, Some(halt))
        });
        let advance = unit.advance(until, halt, &mut report.events)?;
        let reached = unit.time();
        report.gap = Some(point - present).filter(|gap| gap.abs() > rounding_of(present, step));
        self.fell_short = matches!(advance, Advance::Short { .. });
        self.awaits = matches!(advance, Advance::Event);
        let Advance::Short { reason, before } = advance else {
            self.retreat = None;
            return Ok(());
        };
        self.retreat = before.map(|before| Box::new((*before, self.signals.clone())));
        Err(Fault::Discarded {
            end,
            reached,
            reason,
            is_taken_back: false,
        })
    }

    /// Takes a discarded step back if this one begins where it began. What was set since holds from
    /// there on.
    fn retry(&mut self, point: f64, step: f64) {
        let begins_at = |time: f64| (point - time).abs() <= drift_tolerance(time, step);
        let repeats = |kept: &mut Box<(U, Vec<Signal>)>| begins_at(kept.0.time());
        if begins_at(self.time()) {
            return;
        }
        let Some((unit, signals)) = self.retreat.take_if(repeats).map(|kept| *kept) else {
            return;
        };
        self.fell_short = false;
        self.tuned = true;
        for (signal, before) in self.signals.iter_mut().zip(&signals) {
            if signal != before {
                signal.since = unit.time();
                signal.pending = true;
            }
        }
        self.unit = Some(unit);
    }
}

fn end_of_step(point: f64, step: f64) -> Result<f64, Fault> {
    let end = point + step;
    let wrong_step = |allowed| Err(Fault::argument("communicationStepSize", step, allowed));
    if !point.is_finite() {
        let name = "currentCommunicationPoint";
        return Err(Fault::argument(name, point, "finite"));
    }
    if !(step.is_finite() && step > 0.0) {
        return wrong_step("finite and > 0");
    }
    if !end.is_finite() {
        return wrong_step("such that its end is finite");
    }
    Ok(end)
}
