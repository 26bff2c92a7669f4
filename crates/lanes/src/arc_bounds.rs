//! Bounds on all motions of a ball about a cycle along one of its arcs.

use nalgebra::{Matrix2, Vector2, Vector4};

use super::cycle::CycleArc;
use super::cycle_state::Derivatives;

/// Largest relative change of a derivative by damping and stiffness between the crossings of one face by two motions, and of
/// the time between these crossings by what first order leaves out.
const MAX_RELATIVE_CHANGE: f64 = 0.25;

/// Bounds on what first order leaves out of a deviation at a crossing: of the state and of the delay.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LinearError {
    pub state: Vector2<f64>,
    pub delay: f64,
}

/// Bounds on the delay of the crossing before, and on the force per mass that it makes along an arc and its rate.
pub(super) struct DelayBounds {
    delay: f64,
    force: f64,
    rate: f64,
}

/// Bounds on the motions of a ball along an arc.
pub(super) struct ArcBounds {
    pub delayed: DelayBounds,
    /// What first order leaves out of the steady motion.
    curve: Vector2<f64>,
    /// Bounds on the delay at its end, and on the derivatives of the cycle there, from the velocity to the fourth.
    pub late: f64,
    pub moved: Vector4<f64>,
    /// What first order leaves out of the state at the end.
    pub left_out: Vector2<f64>,
}

impl ArcBounds {
    /// Bounds on the deviation of the state at an instant of the arc.
    pub fn deviation(
        &self,
        at: &Derivatives,
        ball: &Matrix2<f64>,
        rest: &LinearError,
    ) -> Vector2<f64> {
        let rest = at.transition.abs() * (rest.state + self.curve) + at.response.abs() * rest.delay;
        row_norms(&(at.tangent * ball)) + rest + self.curve
    }
}

impl CycleArc {
    /// Bounds on the motions of a ball along this arc if they meet no other face; none if first order says too little.
    pub fn bounds(
        &self,
        ball: &Matrix2<f64>,
        rest: &LinearError,
        frequency: f64,
    ) -> Option<ArcBounds> {
        let delayed = self.delay_bounds((self.delay * ball).norm() + rest.delay, frequency);
        let second = self.swing * frequency * frequency * 0.5 * delayed.delay * delayed.delay;
        let mut passed = ArcBounds {
            delayed,
            curve: Vector2::new(second, second * frequency),
            late: 0.0,
            moved: Vector4::zeros(),
            left_out: Vector2::zeros(),
        };
        let at_end = passed.deviation(&self.at_end, ball, rest);
        let linear = self.gradient.abs().dot(&at_end.transpose());
        let late = (1.0 + MAX_RELATIVE_CHANGE) * linear;
        let moved = self.cycle_derivative_bounds(late, frequency)?;
        let rates = self.deviation_rates(&at_end, late, &passed.delayed)?;
        let left_out = (Vector2::new(moved[1], moved[2]) * (0.5 * late) + rates) * late;
        if self.gradient.abs().dot(&left_out.transpose()) > MAX_RELATIVE_CHANGE * linear {
            return None;
        }
        let own = self.at_end.transition.abs() * passed.curve + passed.curve;
        (passed.late, passed.moved, passed.left_out) = (late, moved, left_out + own);
        Some(passed)
    }

    /// Bounds at the crossing that ends the arc, from those at the one before and what is left out of the state there.
    pub fn linear_error_at_exit(
        &self,
        before: &LinearError,
        left_out: &Vector2<f64>,
    ) -> LinearError {
        let Derivatives {
            transition,
            response,
            ..
        } = self.at_end;
        let at_end = transition.abs() * before.state + response.abs() * before.delay + left_out;
        LinearError {
            state: self.reset.abs() * at_end,
            delay: before.delay + self.gradient.abs().dot(&at_end.transpose()),
        }
    }

    fn delay_bounds(&self, delay: f64, frequency: f64) -> DelayBounds {
        let force = self.force * frequency * delay;
        DelayBounds {
            delay,
            force,
            rate: force * frequency,
        }
    }

    /// Bounds on the derivatives of the cycle within `time` of the end of the arc, from the velocity to the fourth.
    fn cycle_derivative_bounds(&self, time: f64, frequency: f64) -> Option<Vector4<f64>> {
        let [_, v, a, j] = self.end.map(f64::abs);
        let force = self.force * frequency * frequency;
        let jerk = (j + time * (self.stiffness * a + force)) / self.unchanged_share(time)?;
        let acceleration = a + time * jerk;
        let snap = self.damping * jerk + self.stiffness * acceleration + force;
        Some([v + time * acceleration, acceleration, jerk, snap].into())
    }

    /// 1 - (damping t + stiffness t^2), by which a bound on a derivative over a time t is divided; none if that time is too
    /// long.
    fn unchanged_share(&self, time: f64) -> Option<f64> {
        let changes = self.damping * time + self.stiffness * time * time;
        (changes <= MAX_RELATIVE_CHANGE).then_some(1.0 - changes)
    }

    /// Bounds on the velocity and acceleration of a deviation within `time` of its instant.
    fn deviation_rates(
        &self,
        deviation: &Vector2<f64>,
        time: f64,
        delayed: &DelayBounds,
    ) -> Option<Vector2<f64>> {
        let change = time * (self.stiffness * deviation.x + delayed.force);
        let velocity = (deviation.y + change) / self.unchanged_share(time)?;
        let position = deviation.x + time * velocity;
        let acceleration = self.damping * velocity + self.stiffness * position + delayed.force;
        Some(Vector2::new(velocity, acceleration))
    }

    /// Bounds on a deviation and its next three derivatives over a time in which a free motion grows by at most
    /// `growth`.
    pub fn deviation_bounds(
        &self,
        deviation: &Vector2<f64>,
        time: f64,
        growth: f64,
        delayed: &DelayBounds,
    ) -> Vector4<f64> {
        let pushed = deviation.y + time * delayed.force;
        let position = growth * (deviation.x + time * pushed);
        let velocity = growth * (time * self.stiffness * deviation.x + pushed);
        let acceleration = self.damping * velocity + self.stiffness * position + delayed.force;
        let jerk = self.damping * acceleration + self.stiffness * velocity + delayed.rate;
        [position, velocity, acceleration, jerk].into()
    }
}

/// Euclidean norm of each row: the largest component of the image of a unit vector.
fn row_norms(matrix: &Matrix2<f64>) -> Vector2<f64> {
    Vector2::new(matrix.row(0).norm(), matrix.row(1).norm())
}
