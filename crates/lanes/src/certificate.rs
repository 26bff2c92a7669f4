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

/// What becomes of the motions of a ball on an arc.
struct Passed {
    turned: Turned,
    /// What first order leaves out of the steady motion.
    curve: Vector2<f64>,
    /// How late they may be at its end, and the derivatives of the cycle there, from the velocity to the fourth.
    late: f64,
    moved: Vector4<f64>,
    /// What first order leaves out of the state at the end.
    left_out: Vector2<f64>,
}

impl Cycle {
    /// Bounds for all motions whose return deviates from the cycle's by a vector of `ball`, the image of the unit disc under
    /// that matrix, if they are clear; none if first order says too little of them.
    pub fn remainder(&self, ball: &Matrix2<f64>) -> Option<Remainder> {
        let mut rest = Rest::default();
        let mut remainder = Remainder::default();
        for arc in &self.arcs {
            let passed = arc.pass(ball, &rest, self.frequency)?;
            rest = arc.cross(&rest, &passed.left_out);
            let to_return = arc.to_return.abs();
            remainder.curvature += to_return * passed.left_out;
            remainder.rounding += to_return * arc.rounding;
        }
        Some(remainder)
    }

    /// True if none of these motions meets another face than the cycle.
    pub fn is_clear(&self, ball: &Matrix2<f64>) -> bool {
        let mut rest = Rest::default();
        self.arcs.iter().all(|arc| {
            let passed = arc.pass(ball, &rest, self.frequency);
            passed.is_some_and(|passed| {
                let is_clear = self.is_clear_on(arc, ball, &rest, &passed);
                rest = arc.cross(&rest, &passed.left_out);
                is_clear
            })
        })
    }

    fn is_clear_on(
        &self,
        arc: &CycleArc,
        ball: &Matrix2<f64>,
        rest: &Rest,
        passed: &Passed,
    ) -> bool {
        let windows = &self.windows.all[arc.windows.clone()];
        windows.iter().enumerate().all(|(index, window)| {
            let is_last = index + 1 == windows.len();
            let late = if is_last { passed.late } else { 0.0 };
            let deviation = passed.deviation(&window.at_start, ball, rest);
            let time = window.step + late;
            let most = arc.most(&deviation, time, window.growth, &passed.turned);
            self.windows.is_clear(window, &(most + passed.moved * late))
        })
    }
}

impl Passed {
    /// Bounds on the deviation at an instant of the arc.
    fn deviation(&self, at: &Derivatives, ball: &Matrix2<f64>, rest: &Rest) -> Vector2<f64> {
        let rest = at.transition.abs() * (rest.state + self.curve) + at.response.abs() * rest.delay;
        rows(&(at.tangent * ball)) + rest + self.curve
    }
}

impl CycleArc {
    /// What becomes of a ball that meets no other face on this arc; none if first order says too little.
    fn pass(&self, ball: &Matrix2<f64>, rest: &Rest, frequency: f64) -> Option<Passed> {
        let turned = self.turned((self.delay * ball).norm() + rest.delay, frequency);
        let second = self.swing * frequency * frequency * 0.5 * turned.delay * turned.delay;
        let mut passed = Passed {
            turned,
            curve: Vector2::new(second, second * frequency),
            late: 0.0,
            moved: Vector4::zeros(),
            left_out: Vector2::zeros(),
        };
        let at_end = passed.deviation(&self.at_end, ball, rest);
        let linear = self.gradient.abs().dot(&at_end.transpose());
        let late = (1.0 + MAX_CHANGE) * linear;
        let moved = self.moved(late, frequency)?;
        let rates = self.rates(&at_end, late, &passed.turned)?;
        let left_out = (Vector2::new(moved[1], moved[2]) * (0.5 * late) + rates) * late;
        if self.gradient.abs().dot(&left_out.transpose()) > MAX_CHANGE * linear {
            return None;
        }
        let own = self.at_end.transition.abs() * passed.curve + passed.curve;
        (passed.late, passed.moved, passed.left_out) = (late, moved, left_out + own);
        Some(passed)
    }

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
}

/// The length of each row: the most that it makes of a unit vector.
fn rows(matrix: &Matrix2<f64>) -> Vector2<f64> {
    Vector2::new(matrix.row(0).norm(), matrix.row(1).norm())
}
