//! The communication step.

use softstop::integrator::Effort;
use softstop::{MotionError, Simulation};

use crate::error::{Fault, argument};
use crate::instance::{Force, Instance, Lifecycle};

/// What happened in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Impacts in this step.
    pub impacts: u64,
    /// Strips pierced through in this step.
    pub pierced: u64,
    /// Time in s and before-impact velocity in m/s of the last impact, if there was one.
    pub last: Option<(f64, f64)>,
    /// How far the communication point lay from the end of the last step, in s, if further than by
    /// rounding.
    pub gap: Option<f64>,
}

/// How far a communication point may lie from the end of the last step.
///
/// Importers add up step sizes or multiply them, so the two differ by rounding. A step goes from
/// where the last one ended to `point + step`, so no difference is ever added up: a few units in
/// the last place would do. A billionth of the time leaves room for importers that count in
/// nanoseconds. Half a step is the limit in any case: a step that is called twice is refused.
fn drift_tolerance(present: f64, step: f64) -> f64 {
    let rounding = rounding_of(present, 0.0);
    let counting = 1e-9 * present.abs().max(1.0);
    counting.min(0.5 * step).max(rounding)
}

/// What adding up a time in such steps may bring.
fn rounding_of(time: f64, step: f64) -> f64 {
    16.0 * f64::EPSILON * time.abs().max(step)
}

/// Work that one step may cost: eight million crossings, some seconds. A step that would take longer
/// is carried out in part, so that no importer waits for ever.
const EFFORT: Effort = Effort::windows(1 << 27);

impl Instance {
    /// Carries the motion on to `point + step`, whatever happens on the way. Next to the report stands
    /// [`Fault::Discarded`] if it did not get that far: [`Instance::time`] is then where it is, and the
    /// next step may begin there, or where this one began.
    ///
    /// # Errors
    /// If it is not initialised, if a number is not usable, or if `point` is not where the last step
    /// ended; nothing has happened then.
    pub fn do_step(
        &mut self,
        point: f64,
        step: f64,
    ) -> Result<(StepReport, Result<(), Fault>), Fault> {
        self.require(
            &[Lifecycle::Running],
            "a step needs an initialised unit that has not failed or ended",
        )?;
        let end = end_of_step(point, step)?;
        let stop = self.experiment.and_then(|experiment| experiment.stop);
        if let Some(stop) = stop.filter(|stop| end > stop + 1e-9 * stop.abs().max(1.0)) {
            return Err(Fault::BeyondStop { end, stop });
        }
        if let Some(simulation) = &self.simulation {
            simulation.check_reach(end.max(simulation.time()))?;
        }
        self.retry(point, step);
        self.check_communication_point(point, step)?;
        let present = self.time();
        let simulation = self.settle()?;
        let before = (simulation.impact_count(), simulation.pierce_count());
        // A step below the last digit of the time ends where it began.
        let outcome = simulation.advance_within(end.max(present), EFFORT);
        let gap = Some(point - present).filter(|gap| gap.abs() > rounding_of(present, step));
        let report = StepReport {
            gap,
            ..StepReport::since(before, simulation)
        };
        let reached = simulation.time();
        let (reason, origin) = match outcome {
            Ok(true) => {
                self.discarded = None;
                return Ok((report, Ok(())));
            }
            Ok(false) => (
                format!("{} impacts so far", report.impacts),
                simulation.before_advance(),
            ),
            // The motion has not left the point at which the step begins.
            Err(error @ (MotionError::Unbounded { .. } | MotionError::Stalled { .. })) => {
                (error.to_string(), Some(simulation.clone()))
            }
            Err(error) => return Err(error.into()),
        };
        self.discarded = origin.map(|origin| Box::new((origin, self.force)));
        let discarded = Fault::Discarded {
            end,
            reached,
            reason,
        };
        Ok((report, Err(discarded)))
    }

    /// Takes a discarded step back if this one begins where it began. What was set since holds from
    /// there on.
    fn retry(&mut self, point: f64, step: f64) {
        let begins_at = |time: f64| (point - time).abs() <= drift_tolerance(time, step);
        let repeats = |kept: &mut Box<(Simulation, Force)>| begins_at(kept.0.time());
        if begins_at(self.time()) {
            return;
        }
        let Some((mut simulation, force)) = self.discarded.take_if(repeats).map(|kept| *kept)
        else {
            return;
        };
        simulation.feed_strip(self.material);
        self.pending.tuning = true;
        if self.force != force {
            self.force.since = simulation.time();
            self.pending.force = true;
        }
        self.simulation = Some(simulation);
    }

    fn check_communication_point(&self, point: f64, step: f64) -> Result<(), Fault> {
        let present = self.time();
        let tolerance = drift_tolerance(present, step);
        if (point - present).abs() > tolerance {
            return Err(Fault::CommunicationPoint {
                point,
                present,
                tolerance,
            });
        }
        Ok(())
    }
}

fn end_of_step(point: f64, step: f64) -> Result<f64, Fault> {
    if !point.is_finite() {
        return Err(argument("currentCommunicationPoint", point, "finite"));
    }
    if !(step.is_finite() && step > 0.0) {
        return Err(argument("communicationStepSize", step, "finite and > 0"));
    }
    let end = point + step;
    if !end.is_finite() {
        return Err(argument(
            "communicationStepSize",
            step,
            "such that its end is finite",
        ));
    }
    Ok(end)
}

impl StepReport {
    /// What has happened since impacts and strips were counted.
    fn since((impacts, pierced): (u64, u64), simulation: &Simulation) -> Self {
        let impacts = simulation.impact_count() - impacts;
        Self {
            impacts,
            pierced: simulation.pierce_count() - pierced,
            last: simulation
                .last_impact()
                .filter(|_| impacts > 0)
                .map(|impact| (impact.time, impact.velocity)),
            gap: None,
        }
    }
}
