//! Taylor steps of a linear law in time itself, under a force that is not linear in time.

use super::convergence::{convergence_reach, first_span};
use super::hertz::Hertz;
use super::taylor::{Taylor, push_series};
use super::taylor_step::TaylorStep;
use super::{Departure, LinearLaw};

impl TaylorStep {
    /// The step of a linear law; `low` is what rounding took from the position before.
    pub fn of_linear_law(flow: &LinearLaw, from: &Departure, low: f64) -> Self {
        let mut segment = Self::linear_in_time(
            flow,
            &Hertz::default(),
            from,
            (from.position, from.velocity),
        );
        segment.low = low;
        segment.end_at(segment.reach_in_time(flow, from));
        segment
    }

    /// The step of a mass that is held while the push changes.
    pub fn of_held_mass(flow: &LinearLaw, from: &Departure) -> Self {
        let mut segment = Self::without_motion(flow, &Hertz::default());
        segment.depth[0] = from.position;
        segment.push = push_series(flow, from);
        segment.end_at(flow.reach.min(first_span(&segment.push)));
        segment
    }

    /// The linear law's motion from `start`, in time itself.
    pub(super) fn linear_in_time(
        flow: &LinearLaw,
        hertz: &Hertz,
        from: &Departure,
        start: (f64, f64),
    ) -> Self {
        let taylor = Taylor::expand(flow, start, push_series(flow, from));
        let taylor = match from.acceleration {
            Some(acceleration) => taylor.with_acceleration(flow, acceleration),
            None => taylor,
        };
        let mut segment = Self::without_motion(flow, hertz);
        segment.depth = taylor.position;
        segment.push = taylor.push;
        segment
    }

    /// Time in s over which series in time hold to rounding, and over which no power of the force outgrows what the
    /// motion begins with: a crossing early in a step would drown in the rounding of its end.
    pub(super) fn reach_in_time(&self, flow: &LinearLaw, from: &Departure) -> f64 {
        let reach = flow.reach;
        if from.push.is_linear() {
            return reach;
        }
        let holds = convergence_reach(&self.depth).min(convergence_reach(&self.velocity_series()));
        let spans = first_span(&self.depth).min(first_span(&self.velocity_series()));
        reach.min(holds).min(spans)
    }
}
