//! Bounds on all motions of a ball about a cycle along one of its arcs.

use nalgebra::{Matrix2, Vector2, Vector4};

use super::cycle::{Cycle, CycleArc};
use super::cycle_state::Derivatives;

/// Largest relative error that the bounds on an arc of a cycle allow first order: of a derivative over the time between the
/// crossings of one guard by two motions, and of that time itself. Beyond it there is no bound.
const MAX_RELATIVE_CHANGE: f64 = 0.25;

/// Bounds on the second-order remainder of a deviation from the cycle at a crossing: of state and delay.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CrossingRemainder {
    pub state: Vector2<f64>,
    pub delay: f64,
}

/// Bounds on all motions of a ball about a cycle along one arc of the cycle, as [`CycleArc::bounds`] computes them.
pub(super) struct ArcBounds {
    /// The drive's force per mass that the delay of the crossing before adds along the arc, and the rate of that force.
    pub delayed: (f64, f64),
    /// What first order leaves out of the steady motion.
    curve: Vector2<f64>,
    /// Bounds on the delay at its end, and on the derivatives of the cycle there, from the velocity to the fourth.
    pub late: f64,
    pub moved: Vector4<f64>,
    /// What first order leaves out of the state at the end.
    pub left_out: Vector2<f64>,
}

impl ArcBounds {
    /// Bounds on the deviation of position and velocity from the cycle at an instant of the arc, for all motions of a ball: the
    /// linear part by the derivatives `at` that instant, and the remainder `rest` of the crossing before.
    pub fn deviation(
        &self,
        at: &Derivatives,
        ball: &Matrix2<f64>,
        rest: &CrossingRemainder,
    ) -> Vector2<f64> {
        let rest = at.transition.abs() * (rest.state + self.curve) + at.response.abs() * rest.delay;
        let tangent = at.tangent * ball;
        Vector2::new(tangent.row(0).norm(), tangent.row(1).norm()) + rest + self.curve
    }
}

impl CycleArc {
    /// Bounds on the motions of a ball along this arc if they meet no other guard than the cycle; none if the remainder exceeds
    /// [`MAX_RELATIVE_CHANGE`] of first order.
    pub fn bounds(
        &self,
        ball: &Matrix2<f64>,
        rest: &CrossingRemainder,
        frequency: f64,
    ) -> Option<ArcBounds> {
        let delay = (self.delay * ball).norm() + rest.delay;
        let force = self.force * frequency * delay;
        let second = self.swing * frequency * frequency * 0.5 * delay * delay;
        let mut passed = ArcBounds {
            delayed: (force, force * frequency),
            curve: Vector2::new(second, second * frequency),
            late: 0.0,
            moved: Vector4::zeros(),
            left_out: Vector2::zeros(),
        };
        let at_end = passed.deviation(&self.at_end, ball, rest);
        let linear = self.gradient.abs().dot(&at_end.transpose());
        let late = (1.0 + MAX_RELATIVE_CHANGE) * linear;
        let moved = self.cycle_derivative_bounds(late, frequency)?;
        let rates = self.deviation_rates(&at_end, late, force)?;
        let left_out = (Vector2::new(moved[1], moved[2]) * (0.5 * late) + rates) * late;
        if self.gradient.abs().dot(&left_out.transpose()) > MAX_RELATIVE_CHANGE * linear {
            return None;
        }
        let own = self.at_end.transition.abs() * passed.curve + passed.curve;
        (passed.late, passed.moved, passed.left_out) = (late, moved, left_out + own);
        Some(passed)
    }

    /// Bound on the second-order remainder at the crossing that ends the arc, from that at the crossing `before` the arc and from
    /// what the linear map along the arc leaves out of the state.
    pub fn remainder_at_exit(
        &self,
        before: &CrossingRemainder,
        left_out: &Vector2<f64>,
    ) -> CrossingRemainder {
        let Derivatives {
            transition,
            response,
            ..
        } = self.at_end;
        let at_end = transition.abs() * before.state + response.abs() * before.delay + left_out;
        CrossingRemainder {
            state: self.reset.abs() * at_end,
            delay: before.delay + self.gradient.abs().dot(&at_end.transpose()),
        }
    }

    /// Bounds on velocity, acceleration, jerk and snap of the cycle within `time` of the arc's end; none if that is too long.
    fn cycle_derivative_bounds(&self, time: f64, frequency: f64) -> Option<Vector4<f64>> {
        let [_, v, a, j] = self.end.map(f64::abs);
        let force = self.force * frequency * frequency;
        let jerk = (j + time * (self.stiffness * a + force)) / self.unchanged_share(time)?;
        let acceleration = a + time * jerk;
        let snap = self.damping * jerk + self.stiffness * acceleration + force;
        Some([v + time * acceleration, acceleration, jerk, snap].into())
    }

    /// 1 - (damping t + stiffness t^2), by which a bound on a derivative is divided to hold over a time t; none if t is too long.
    fn unchanged_share(&self, time: f64) -> Option<f64> {
        let changes = self.damping * time + self.stiffness * time * time;
        (changes <= MAX_RELATIVE_CHANGE).then_some(1.0 - changes)
    }

    /// Bounds on velocity and acceleration of a deviation from the cycle within `time` of the instant at which it is `deviation`;
    /// none if that time is too long.
    fn deviation_rates(
        &self,
        deviation: &Vector2<f64>,
        time: f64,
        force: f64,
    ) -> Option<Vector2<f64>> {
        let change = time * (self.stiffness * deviation.x + force);
        let velocity = (deviation.y + change) / self.unchanged_share(time)?;
        let position = deviation.x + time * velocity;
        let acceleration = self.damping * velocity + self.stiffness * position + force;
        Some(Vector2::new(velocity, acceleration))
    }

    /// Bounds on a deviation from the cycle and its first three derivatives over a `time` after it was `deviation`; `growth`:
    /// factor by which a free motion may grow meanwhile; `force` and its rate: [`ArcBounds::delayed`].
    pub fn deviation_bounds(
        &self,
        deviation: &Vector2<f64>,
        time: f64,
        growth: f64,
        (force, force_rate): (f64, f64),
    ) -> Vector4<f64> {
        let pushed = deviation.y + time * force;
        let position = growth * (deviation.x + time * pushed);
        let velocity = growth * (time * self.stiffness * deviation.x + pushed);
        let acceleration = self.damping * velocity + self.stiffness * position + force;
        let jerk = self.damping * acceleration + self.stiffness * velocity + force_rate;
        [position, velocity, acceleration, jerk].into()
    }
}

impl Cycle {
    /// True if no motion of the ball meets another guard than the cycle on an arc; `rest`: remainder at the crossing before.
    pub fn arc_is_clear(
        &self,
        arc: &CycleArc,
        ball: &Matrix2<f64>,
        rest: &CrossingRemainder,
        passed: &ArcBounds,
    ) -> bool {
        let windows = &self.windows.all[arc.windows.clone()];
        windows.iter().enumerate().all(|(index, window)| {
            let is_last = index + 1 == windows.len();
            let late = if is_last { passed.late } else { 0.0 };
            let deviation = passed.deviation(&window.at_start, ball, rest);
            let time = window.step + late;
            let most = arc.deviation_bounds(&deviation, time, window.growth, passed.delayed);
            self.windows.is_clear(window, &(most + passed.moved * late))
        })
    }
}
