//! A proof that all motions in a ball about a cycle cross the same faces, and how far from linear their returns are.
//!
//! A motion is compared with the cycle at equal times since their last crossings, so that it deviates by a state and by the
//! delay of that crossing. Laws are linear: along an arc the linear map leaves out only tau^2 / 2 times the second
//! derivative of the steady motion, tau being the delay. At the end the motion crosses by sigma earlier or later than
//! the cycle; left out are sigma^2 / 2 times the second derivative of the cycle and sigma times the rate of the deviation.
//! The linear part of a deviation is known for the whole ball; `rest` bounds all that is left out up to here.

use nalgebra::{Matrix2, Vector2, Vector4};

use super::cycle::{Cycle, CycleArc};
use super::place::Derivatives;

/// Rounding of a state, relative to the terms that it is the sum of.
const ROUNDING: f64 = f64::EPSILON;
/// Most that damping and stiffness may change a derivative between two crossings of one face, as a share, and most that
/// what is left out may change the time between them.
const MAX_CHANGE: f64 = 0.25;

/// Bounds on the next return of any motion in a ball: velocity and drive angle.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Remainder {
    /// What the linear map leaves out.
    pub curvature: Vector2<f64>,
    /// What rounding may change.
    pub rounding: Vector2<f64>,
}

/// Bounds on parts of a deviation at a crossing: state and delay.
#[derive(Debug, Clone, Copy, Default)]
struct Rest {
    state: Vector2<f64>,
    delay: f64,
}

/// How a deviation changes within an arc: bounds on the delay, and on the force that it makes and that force's rate.
struct Turned {
    delay: f64,
    force: f64,
    rate: f64,
}

impl Cycle {
    /// Bounds for all motions whose return deviates from the cycle's by a vector of `ball`, the image of the unit disc under
    /// that matrix; none if one of them may meet another face.
    pub fn certify(&self, ball: &Matrix2<f64>) -> Option<Remainder> {
        let mut rest = Rest::default();
        let mut remainder = Remainder::default();
        for arc in &self.arcs {
            let left_out = self.pass(arc, ball, &rest)?;
            rest = arc.cross(&rest, &left_out);
            let to_return = arc.to_return.abs();
            remainder.curvature += to_return * left_out;
            remainder.rounding += to_return * arc.rounding();
        }
        Some(remainder)
    }

    /// Proves that no motion of a ball meets another face on an arc; what first order leaves out of the states at its end.
    fn pass(&self, arc: &CycleArc, ball: &Matrix2<f64>, rest: &Rest) -> Option<Vector2<f64>> {
        let turned = arc.turned((arc.delay * ball).norm() + rest.delay, self.frequency);
        let second =
            arc.swing * self.frequency * self.frequency * 0.5 * turned.delay * turned.delay;
        let curve = Vector2::new(second, second * self.frequency);
        let deviation = |at: &Derivatives| {
            let rest = at.transition.abs() * (rest.state + curve) + at.response.abs() * rest.delay;
            rows(&(at.tangent * ball)) + rest + curve
        };
        let at_end = deviation(&arc.at_end);
        let linear = arc.gradient.abs().dot(&at_end.transpose());
        let late = (1.0 + MAX_CHANGE) * linear;
        let moved = arc.moved(late, self.frequency)?;
        let rates = arc.rates(&at_end, late, &turned)?;
        let left_out = (Vector2::new(moved[1], moved[2]) * (0.5 * late) + rates) * late;
        if arc.gradient.abs().dot(&left_out.transpose()) > MAX_CHANGE * linear {
            return None;
        }
        let windows = &self.windows[arc.windows.clone()];
        for (index, window) in windows.iter().enumerate() {
            let is_last = index + 1 == windows.len();
            let later = if is_last { late } else { 0.0 };
            let deviation = deviation(&window.at_start);
            let most = arc.most(&deviation, window.step + later, window.growth, &turned);
            let most = if is_last { most + moved * late } else { most };
            if !window.tolerates(&most) {
                return None;
            }
        }
        let own = arc.at_end.transition.abs() * curve + curve;
        Some(left_out + own)
    }
}

impl CycleArc {
    /// Bounds at the next crossing, from those at the last one and what is left out of the state at the end.
    fn cross(&self, before: &Rest, left_out: &Vector2<f64>) -> Rest {
        let Derivatives {
            transition,
            response,
            ..
        } = self.at_end;
        let at_end = transition.abs() * before.state + response.abs() * before.delay + left_out;
        Rest {
            state: self.reset.abs() * at_end,
            delay: before.delay + self.gradient.abs().dot(&at_end.transpose()),
        }
    }

    fn turned(&self, delay: f64, frequency: f64) -> Turned {
        let force = self.force * frequency * delay;
        Turned {
            delay,
            force,
            rate: force * frequency,
        }
    }

    /// Bounds on the derivatives of the cycle within `time` of its end, from the velocity to the fourth.
    fn moved(&self, time: f64, frequency: f64) -> Option<Vector4<f64>> {
        let [_, v, a, j] = self.end.map(f64::abs);
        let force = self.force * frequency * frequency;
        let jerk = (j + time * (self.stiffness * a + force)) / self.keeps(time)?;
        let acceleration = a + time * jerk;
        let snap = self.damping * jerk + self.stiffness * acceleration + force;
        Some([v + time * acceleration, acceleration, jerk, snap].into())
    }

    /// The share of a derivative that damping and stiffness do not change in a time, if that is brief.
    fn keeps(&self, time: f64) -> Option<f64> {
        let changes = self.damping * time + self.stiffness * time * time;
        (changes <= MAX_CHANGE).then_some(1.0 - changes)
    }

    /// Bounds on the rates of a deviation within `time` of its instant.
    fn rates(&self, deviation: &Vector2<f64>, time: f64, turned: &Turned) -> Option<Vector2<f64>> {
        let change = time * (self.stiffness * deviation.x + turned.force);
        let velocity = (deviation.y + change) / self.keeps(time)?;
        let position = deviation.x + time * velocity;
        let acceleration = self.damping * velocity + self.stiffness * position + turned.force;
        Some(Vector2::new(velocity, acceleration))
    }

    /// Bounds on a deviation and its next three derivatives over a time in which a free motion grows by no more than `growth`.
    fn most(
        &self,
        deviation: &Vector2<f64>,
        time: f64,
        growth: f64,
        turned: &Turned,
    ) -> Vector4<f64> {
        let pushed = deviation.y + time * turned.force;
        let position = growth * (deviation.x + time * pushed);
        let velocity = growth * (time * self.stiffness * deviation.x + pushed);
        let acceleration = self.damping * velocity + self.stiffness * position + turned.force;
        let jerk = self.damping * acceleration + self.stiffness * velocity + turned.rate;
        [position, velocity, acceleration, jerk].into()
    }

    /// What rounding may change of the state at the end.
    fn rounding(&self) -> Vector2<f64> {
        let [x, v, a, _] = self.end.map(f64::abs);
        Vector2::new(x + v * self.window, v + a * self.window) * ROUNDING
    }
}

/// The length of each row: the most that it makes of a unit vector.
fn rows(matrix: &Matrix2<f64>) -> Vector2<f64> {
    Vector2::new(matrix.row(0).norm(), matrix.row(1).norm())
}
