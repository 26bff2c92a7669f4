//! How a course and the energy supplied along it change with its start and with the push: variational equations, exact.

use nalgebra::{Matrix2, Vector2};

use crate::budget;

use super::arc_solution::{ArcSolution, Form};
use super::linearized::Linearized;
use super::response::Responses;
use super::series::{Series, derivative, integral_of_product, product, value};
use super::taylor_step::TaylorStep;

/// Derivatives of the state along a course.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Transition {
    /// By the state at departure.
    pub matrix: Matrix2<f64>,
    /// Integral of the damping coefficient over time and mass.
    pub damping: f64,
    /// By the drive's frequency, the state at departure held; none where it is not asked for or has no closed form.
    pub by_frequency: Option<Vector2<f64>>,
}

impl Transition {
    /// Along a course that is held.
    pub fn held(course: &ArcSolution) -> Self {
        Self {
            matrix: Matrix2::new(1.0, 0.0, 0.0, 0.0),
            damping: 0.0,
            by_frequency: (!course.is_chattering()).then(Vector2::zeros),
        }
    }
}

/// A small change of a motion: of position and velocity at departure, and of the constant push per
/// mass from there on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Change {
    pub position: f64,
    pub velocity: f64,
    pub push: f64,
}

impl ArcSolution {
    /// The change of position and velocity, `elapsed` seconds after departure, that a change there
    /// brings. A held mass stays where it is.
    pub(crate) fn changed(&self, elapsed: f64, by: Change) -> (f64, f64) {
        match &self.form {
            Form::Held | Form::Chatter(_) => (by.position, 0.0),
            Form::TaylorStep(segment) if segment.is_still() => (by.position, 0.0),
            Form::TaylorStep(segment) => {
                let sigma = segment.parameter_at(elapsed);
                let [position, velocity] = segment.changed(by);
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

    /// How the state after `elapsed` changes with that at departure and, if that is `since` seconds after the instant at
    /// which the drive's angle is held, with the drive's frequency.
    pub(crate) fn transition(&self, elapsed: f64, since: Option<f64>) -> Transition {
        if let Form::TaylorStep(step) = &self.form {
            let force = since.and_then(|since| self.detuning_force(step, since));
            return step.transition(elapsed, force.as_ref());
        }
        let matrix = self.flow.transition(elapsed);
        let by_frequency = match (&self.form, since) {
            (Form::Particular { particular, .. }, Some(since)) => {
                let answer =
                    |elapsed: f64, drive| particular.detuned(&self.flow, since + elapsed, drive);
                let start = answer(0.0, self.departure.drive);
                Some(answer(elapsed, self.drive_at(elapsed)) - matrix * start)
            }
            _ => None,
        };
        Transition {
            matrix,
            damping: self.flow.damping() * elapsed,
            by_frequency,
        }
    }

    /// The force -A t sin(angle) per mass and d(time)/d(sigma) along a step under its drive and a constant push: by sigma,
    /// that push changes by -A sin(angle) w d(time)/d(sigma). None in slow motion, whose changes are those by a constant
    /// push.
    fn detuning_force(&self, step: &TaylorStep, since: f64) -> Option<Series> {
        let push = &self.departure.push;
        if step.creep.is_some() || !push.is_linear() || push.rate() != 0.0 {
            return None;
        }
        let mut time = step.times();
        time[0] += since;
        let force = product(&time, &derivative(&step.push));
        Some(force.map(|coefficient| coefficient / self.flow.frequency))
    }

    /// The change of the work of the push per mass up to `elapsed`; `law` is the part of the constant
    /// push that is the phase's own force.
    pub(crate) fn changed_supply(&self, elapsed: f64, by: Change, law: f64) -> f64 {
        match &self.form {
            Form::Held | Form::Chatter(_) => 0.0,
            Form::TaylorStep(segment) if segment.is_still() => 0.0,
            Form::TaylorStep(segment) => segment.changed_supply(elapsed, by, law),
            Form::Particular { .. } | Form::Responses => {
                self.changed_supply_of_linear(elapsed, by, law)
            }
        }
    }

    /// The push per mass in m/s^2, `elapsed` seconds after departure.
    pub(crate) fn push(&self, elapsed: f64) -> f64 {
        if let Form::TaylorStep(segment) = &self.form {
            return segment.push_at(segment.parameter_at(elapsed));
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

impl TaylorStep {
    /// How the state changes with that at the start and under a force per mass and d(time)/d(sigma).
    fn transition(&self, elapsed: f64, force: Option<&Series>) -> Transition {
        budget::charge(budget::TANGENT);
        let sigma = self.parameter_at(elapsed);
        let law = Linearized::of(self);
        let columns = self.changes(&law, force);
        let [first, second, forced] =
            columns.map(|[y, u]| Vector2::new(value(&y, sigma), value(&u, sigma)));
        Transition {
            matrix: Matrix2::from_columns(&[first, second]),
            damping: law.damping_integral(self.time_at(sigma), sigma),
            by_frequency: force.map(|_| self.side() * forced),
        }
    }

    /// Changes of position and velocity as series in sigma.
    fn changed(&self, by: Change) -> [Series; 2] {
        let law = Linearized::of(self);
        let [first, second, pushed] = self.changes(&law, Some(&law.rate));
        [0, 1].map(|of| {
            std::array::from_fn(|k| {
                by.position * first[of][k] + by.velocity * second[of][k] + by.push * pushed[of][k]
            })
        })
    }

    /// Position and velocity, as series in sigma, from (1, 0), from (0, 1), and from (0, 0) under a force, if there is one,
    /// per mass and d(time)/d(sigma): in slow motion a constant push.
    pub(super) fn changes(&self, law: &Linearized, force: Option<&Series>) -> [[Series; 2]; 3] {
        match &self.creep {
            Some(creep) => {
                let echo = creep.memory.map(|memory| creep.echo * memory);
                [creep.memory, echo, creep.answer].map(|y| [y, derivative(&y)])
            }
            None => law.solve(force),
        }
    }

    fn changed_supply(&self, elapsed: f64, by: Change, law: f64) -> f64 {
        let [_, changed] = self.changed(by);
        let rate = self.rate();
        let mut push = self.push;
        push[0] -= self.side() * law;
        let to = self.parameter_at(elapsed);
        let travel = integral_of_product(&rate, &self.velocity(), to);
        let work = integral_of_product(&product(&rate, &push), &changed, to) + by.push * travel;
        self.side() * work
    }
}
