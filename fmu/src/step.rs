//! The communication step.

use crate::error::{Fault, argument};
use crate::instance::{Instance, Lifecycle};

/// What happened in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Impacts in this step.
    pub impacts: u64,
    /// Strips pierced through in this step.
    pub pierced: u64,
    /// Time in s and before-impact velocity in m/s of the last impact, if there was one.
    pub last: Option<(f64, f64)>,
}

/// How far a communication point may lie from the end of the last step.
///
/// Importers add up step sizes or multiply them, so the two differ by rounding. A step goes from
/// where the last one ended to `point + step`, so no difference is ever added up: a few units in
/// the last place would do. A billionth of the time leaves room for importers that count in
/// nanoseconds. Half a step is the limit in any case: a step that is called twice is refused.
fn drift_tolerance(present: f64, step: f64) -> f64 {
    let rounding = 16.0 * f64::EPSILON * present.abs();
    let counting = 1e-9 * present.abs().max(1.0);
    counting.min(0.5 * step).max(rounding)
}

impl Instance {
    /// Carries the motion on to `point + step`, whatever happens on the way.
    ///
    /// # Errors
    /// If it is not initialised, if a number is not usable, if `point` is not where the last step
    /// ended, or if the motion grows beyond all bounds; after the last the unit must be reset.
    pub fn do_step(&mut self, point: f64, step: f64) -> Result<StepReport, Fault> {
        self.require(
            &[Lifecycle::Running],
            "a step needs an initialised unit that has not failed or ended",
        )?;
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
        let present = self.time();
        let tolerance = drift_tolerance(present, step);
        if (point - present).abs() > tolerance {
            return Err(Fault::CommunicationPoint {
                point,
                present,
                tolerance,
            });
        }
        let stop = self.experiment.and_then(|experiment| experiment.stop);
        if let Some(stop) = stop.filter(|stop| end > stop + 1e-9 * stop.abs().max(1.0)) {
            return Err(Fault::BeyondStop { end, stop });
        }
        let simulation = self.settle()?;
        let (impacts, pierced) = (simulation.impact_count(), simulation.pierce_count());
        // A step below the last digit of the time ends where it began.
        if end > present
            && let Err(error) = simulation.advance(end)
        {
            self.fail();
            return Err(error.into());
        }
        let impacts = simulation.impact_count() - impacts;
        Ok(StepReport {
            impacts,
            pierced: simulation.pierce_count() - pierced,
            last: simulation
                .last_impact()
                .filter(|_| impacts > 0)
                .map(|impact| (impact.time, impact.velocity)),
        })
    }
}
