//! How a motion answers to the frequency of its drive: exact, across whatever crossings lie between.

use nalgebra::Vector2;

use super::{Tangent, saltation};
use crate::integrator::{Arc, Crossing, Observer, Start};

/// Watches a motion from time 0 and gathers d(state)/d(w), the state at time 0 held: x' of the variational
/// equation x'' + 2 a x' + b x = -A t sin(w t + phi), linearized along a power law, with the saltation matrices of the crossings.
#[derive(Debug, Clone)]
pub struct FrequencySensitivity {
    /// d(state)/d(state at time 0), gathered on the same way.
    pub tangent: Tangent,
    change: Option<Vector2<f64>>,
}

impl Default for FrequencySensitivity {
    fn default() -> Self {
        Self {
            tangent: Tangent::default(),
            change: Some(Vector2::zeros()),
        }
    }
}

impl FrequencySensitivity {
    /// d(state)/d(w) in m s/rad and m/rad at the drive angle at a time in s, so many seconds after the start of the arc that
    /// was told last, where the mass is in a state; none where a law has no closed form.
    pub fn at_drive_angle(
        &self,
        (arc, elapsed): (&Arc<'_>, f64),
        state: Start,
        time: f64,
    ) -> Option<Vector2<f64>> {
        let flow = &arc.course.flow;
        let rate = if arc.course.is_held() {
            Vector2::zeros()
        } else {
            let (x, v) = (state.position, state.velocity);
            let hertz = arc.phase.and_then(|phase| phase.hertz);
            let press = hertz.map_or(0.0, |hertz| hertz.force(x, v) / hertz.mass);
            let forcing = arc.course.forcing_at(elapsed) - press;
            Vector2::new(v, flow.acceleration(x, v, forcing))
        };
        Some(self.change? - rate * (time / flow.frequency))
    }
}

impl Observer for FrequencySensitivity {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let transition = self.tangent.extend_along(arc, elapsed, Some(arc.begin()));
        let change = self.change.zip(transition.by_frequency);
        self.change = change.map(|(change, by)| transition.matrix * change + by);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.tangent.crossing(crossing);
        self.change = self.change.map(|change| saltation(crossing) * change);
    }
}
