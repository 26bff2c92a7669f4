//! How a motion answers to the frequency of its drive: exact, across whatever crossings lie between.

use nalgebra::Vector2;

use super::{Tangent, saltation};
use crate::integrator::{Arc, Clock, Crossing, Motion, Observer};

/// Watches a motion from time 0 and gathers d(state)/d(w), the state at time 0 held: x' of the variational
/// equation x'' + 2 a x' + b x = -A t sin(w t + phi), with the saltation matrices of the crossings.
#[derive(Debug, Clone)]
pub struct Detuning {
    /// d(state)/d(state at time 0), gathered on the same way.
    pub tangent: Tangent,
    clock: Clock,
    change: Option<Vector2<f64>>,
}

impl Detuning {
    /// Of a motion that begins now.
    pub fn new(motion: &Motion) -> Self {
        Self {
            tangent: Tangent::default(),
            clock: *motion.clock(),
            change: Some(Vector2::zeros()),
        }
    }

    /// d(state)/d(w) in m s/rad and m/rad at the present drive angle, once the arc under way is told; none
    /// where a law has no closed form.
    pub fn at_drive_angle(&self, motion: &Motion) -> Option<Vector2<f64>> {
        let arc = motion.arc();
        let flow = &arc.course.flow;
        let state = motion.state();
        let rate = if arc.course.is_held() {
            Vector2::zeros()
        } else {
            let push = arc.course.push(self.clock.elapsed(arc.start, motion.now()));
            let acceleration = flow.acceleration(state.position, state.velocity, push);
            Vector2::new(state.velocity, acceleration)
        };
        Some(self.change? - rate * (self.clock.time(motion.now()) / flow.frequency))
    }
}

impl Observer for Detuning {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let since = self.clock.time(arc.start);
        let transition = self.tangent.along(arc, elapsed);
        let by = self.change;
        self.change = by.and_then(|by| arc.course.detuned((elapsed, &transition), since, by));
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.tangent.crossing(crossing);
        self.change = self.change.map(|change| saltation(crossing) * change);
    }
}
