//! How a course and the energy supplied along it change with its start and with the push: variational equations, exact.

use nalgebra::{Matrix2, Vector2};

use crate::budget;

use super::course::{Course, Form};
use super::response::Responses;
use super::segment::Segment;
use super::series::{
    Series, ZERO, convolve, derivative, integral_of_product, power, product, value,
};
use super::taylor::DEGREE;

/// A small change of a motion: of position and velocity at departure, and of the constant push per
/// mass from there on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub position: f64,
    pub velocity: f64,
    pub push: f64,
}

impl Course {
    /// The change of position and velocity, `elapsed` seconds after departure, that a change there
    /// brings. A held mass stays where it is.
    pub(crate) fn changed(&self, elapsed: f64, by: Change) -> (f64, f64) {
        match &self.form {
            Form::Held | Form::Chatter(_) => (by.position, 0.0),
            Form::Segment(segment) if segment.is_still() => (by.position, 0.0),
            Form::Segment(segment) => {
                let sigma = segment.parameter_at(elapsed);
                let (position, velocity) = segment.changed(by);
                (value(&position, sigma), value(&velocity, sigma))
            }
            Form::Particular { .. } | Form::Responses => {
                let modes = &self.flow.modes;
                let mut state = modes.at(elapsed) * Vector2::new(by.position, by.velocity);
                if by.push != 0.0 {
                    let answers = Responses::at(modes, self.flow.frequency, elapsed);
                    state += by.push * answers.constant;
                }
                (state.x, state.y)
            }
        }
    }

    /// The change of the state that a change `by` at departure and one of the drive's frequency bring, per rad/s of
    /// the latter; the departure is `since` seconds after the instant at which the drive's angle is held. None but in
    /// closed form. `transition` is d(state)/d(state at departure) after `elapsed`.
    pub(crate) fn detuned(
        &self,
        (elapsed, transition): (f64, &Matrix2<f64>),
        since: f64,
        by: Vector2<f64>,
    ) -> Option<Vector2<f64>> {
        match self.form {
            Form::Held => Some(Vector2::new(by.x, 0.0)),
            Form::Particular { particular, .. } => {
                let answer =
                    |elapsed: f64, drive| particular.detuned(&self.flow, since + elapsed, drive);
                Some(
                    answer(elapsed, self.drive_at(elapsed))
                        + transition * (by - answer(0.0, self.departure.drive)),
                )
            }
            _ => None,
        }
    }

    /// The change of the work of the push per mass up to `elapsed`; `law` is the part of the constant
    /// push that is the phase's own force.
    pub(crate) fn changed_supply(&self, elapsed: f64, by: Change, law: f64) -> f64 {
        match &self.form {
            Form::Held | Form::Chatter(_) => 0.0,
            Form::Segment(segment) if segment.is_still() => 0.0,
            Form::Segment(segment) => segment.changed_supply(elapsed, by, law),
            Form::Particular { .. } | Form::Responses => {
                self.changed_supply_of_linear(elapsed, by, law)
            }
        }
    }

    /// The push per mass in m/s^2, `elapsed` seconds after departure.
    pub(crate) fn push(&self, elapsed: f64) -> f64 {
        if let Form::Segment(segment) = &self.form {
            return value(&segment.push, segment.parameter_at(elapsed));
        }
        self.push_at(elapsed).0 + self.flow.amplitude * self.drive_at(elapsed).cos
    }

    /// The work of a linear course is a quadratic form of its departure: a central difference of any
    /// width is its derivative.
    fn changed_supply_of_linear(&self, elapsed: f64, by: Change, law: f64) -> f64 {
        let (from, w) = (self.departure, self.flow.frequency);
        let norm = |x: f64, v: f64, c: f64| x.abs() + v.abs() / w + c.abs() / (w * w);
        let size = norm(by.position, by.velocity, by.push);
        if size == 0.0 {
            return 0.0;
        }
        let motion = norm(from.position, from.velocity, self.flow.amplitude);
        let width = if motion > 0.0 { motion / size } else { 1.0 };
        let work = |width: f64| {
            let mut moved = from;
            moved.position += width * by.position;
            moved.velocity += width * by.velocity;
            moved.push = from.push.with(0, from.push.value() + width * by.push);
            moved.acceleration = None;
            let course = Self::new(&self.flow, moved);
            course.power(&course.node(elapsed), law).supplied
        };
        (work(width) - work(-width)) / (2.0 * width)
    }
}

impl Segment {
    /// d(state)/d(state at the start) after `elapsed`, and the integral of damping over mass: the
    /// equation y'' + damping y' + stiffness y = 0 along the motion, in sigma.
    pub fn transition(&self, elapsed: f64) -> (Matrix2<f64>, f64) {
        budget::charge(budget::TANGENT);
        let sigma = self.parameter_at(elapsed);
        let column = |position: f64, velocity: f64| {
            let by = Change {
                position,
                velocity,
                push: 0.0,
            };
            let (y, u) = self.changed(by);
            (value(&y, sigma), value(&u, sigma))
        };
        let (first, second) = (column(1.0, 0.0), column(0.0, 1.0));
        let matrix = Matrix2::new(first.0, second.0, first.1, second.1);
        (matrix, self.damping_integral(sigma))
    }

    /// Changes of position and velocity as series in sigma: y'' + damping y' + stiffness y = push along
    /// the motion.
    pub(super) fn changed(&self, by: Change) -> (Series, Series) {
        if let Some(creep) = &self.creep {
            let start = by.position + creep.echo * by.velocity;
            let position: Series =
                std::array::from_fn(|k| start * creep.memory[k] + by.push * creep.answer[k]);
            return (position, derivative(&position));
        }
        let rate = self.rate();
        let damping = product(&rate, &self.damping());
        let stiffness = product(&rate, &self.stiffness());
        let (mut y, mut u) = (ZERO, ZERO);
        (y[0], u[0]) = (by.position, by.velocity);
        for k in 0..DEGREE {
            let next = (k + 1) as f64;
            y[k + 1] = convolve(&rate, &u, k) / next;
            let resisting = convolve(&damping, &u, k) + convolve(&stiffness, &y, k);
            u[k + 1] = (by.push * rate[k] - resisting) / next;
        }
        (y, u)
    }

    fn changed_supply(&self, elapsed: f64, by: Change, law: f64) -> f64 {
        let (_, changed) = self.changed(by);
        let rate = self.rate();
        let mut push = self.push;
        push[0] -= law;
        let to = self.parameter_at(elapsed);
        let travel = integral_of_product(&rate, &self.velocity(), to);
        integral_of_product(&product(&rate, &push), &changed, to) + by.push * travel
    }

    /// 2 a + kappa lambda d^n.
    pub fn damping(&self) -> Series {
        let factor = self.hertz.rate() * self.hertz.dissipation;
        let mut damping = self.power().map(|w| factor * w);
        damping[0] += self.damping;
        damping
    }

    /// Its integral over time.
    pub(super) fn damping_integral(&self, sigma: f64) -> f64 {
        product(&self.rate(), &self.damping())
            .iter()
            .enumerate()
            .rev()
            .fold(0.0, |sum, (k, c)| sigma * (c / (k + 1) as f64 + sum))
    }

    /// b + kappa n d^(n-1) (1 + lambda v).
    pub(super) fn stiffness(&self) -> Series {
        let mut sum = ZERO;
        if self.is_pressed {
            let n = self.hertz.exponent;
            let factor = self.hertz.rate() * n;
            let steepness = match &self.stretch {
                Some(stretch) => power(&stretch.root, stretch.index * (n - 1.0)),
                None => power(&self.depth, n - 1.0),
            };
            let damped = product(&steepness, &self.velocity());
            sum = std::array::from_fn(|k| {
                factor * (steepness[k] + self.hertz.dissipation * damped[k])
            });
        }
        sum[0] += self.stiffness;
        sum
    }
}
