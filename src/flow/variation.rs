//! Variational equations of an arc: how its states, and the energy supplied along it, change with its start and with
//! the forcing; exact.

use nalgebra::{Matrix2, Vector2};

use super::arc_solution::{ArcSolution, Form};
use super::gauss_quadrature::gauss_nodes;
use super::polynomial::Polynomial;
use super::series::{Series, derivative, integral_of_product, product, value};
use super::taylor_step::TaylorStep;
use super::variational_equation::VariationalEquation;
use super::zero_state_responses::ZeroStateResponses;
use crate::budget;

/// Derivatives of the state at one time of an arc by its departure and by the frequency of the drive.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Transition {
    /// By the state at departure.
    pub matrix: Matrix2<f64>,
    /// Integral of the damping coefficient over time and mass.
    pub damping: f64,
    /// By the drive's frequency, the state at departure held; none where it is not asked for or has no closed form.
    pub by_frequency: Option<Vector2<f64>>,
}

/// A small change of an arc: of position and velocity at departure, and of the constant forcing per mass from there on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Variation {
    pub position: f64,
    pub velocity: f64,
    pub forcing: f64,
}

impl ArcSolution {
    /// The change of position and velocity, `elapsed` seconds after departure, by a small change of the arc. A held
    /// mass stays where it is.
    pub(crate) fn state_variation(&self, elapsed: f64, by: Variation) -> (f64, f64) {
        match &self.form {
            Form::Held | Form::Chatter(_) => (by.position, 0.0),
            Form::TaylorStep(step) if step.is_still() => (by.position, 0.0),
            Form::TaylorStep(step) => {
                let sigma = step.sigma_after(elapsed);
                let [position, velocity] = step.state_variation(by);
                (value(&position, sigma), value(&velocity, sigma))
            }
            Form::Particular { .. } | Form::Responses => {
                let modes = &self.flow.modes;
                let mut state = modes.transition(elapsed) * Vector2::new(by.position, by.velocity);
                if by.forcing != 0.0 {
                    let answers =
                        ZeroStateResponses::after_time(modes, self.flow.frequency, elapsed);
                    state += by.forcing * answers.constant;
                }
                (state.x, state.y)
            }
        }
    }

    /// The changes of the integral of the position from `from` to `elapsed`, where an arc that began before is that of a
    /// held mass, and of that of the position times the rate of a force, which is linear in time unless the forcing is not.
    pub(crate) fn displacement_variation(
        &self,
        (from, elapsed): (f64, f64),
        by: Variation,
        force: &Polynomial,
    ) -> (f64, f64) {
        match &self.form {
            Form::TaylorStep(step) if !step.is_still() => {
                let ([position, _], rate) = (step.state_variation(by), step.time_rate_series());
                let mut sums = (0.0, 0.0);
                for (sigma, weight) in gauss_nodes(step.sigma_after(elapsed)) {
                    let moved = weight * value(&rate, sigma) * value(&position, sigma);
                    let force_rate = force.shifted(step.time_at_sigma(sigma)).rate();
                    sums = (sums.0 + moved, sums.1 + force_rate * moved);
                }
                sums
            }
            Form::Particular { .. } | Form::Responses => {
                let modes = &self.flow.modes;
                let ZeroStateResponses { constant, ramp, .. } =
                    ZeroStateResponses::after_time(modes, self.flow.frequency, elapsed);
                let by_position =
                    modes.transition(elapsed)[(0, 1)] + 2.0 * modes.decay * constant.x;
                let moved =
                    by.position * by_position + by.velocity * constant.x + by.forcing * ramp.x;
                (moved, force.rate() * moved)
            }
            _ => {
                let force = force.value_at(elapsed) - force.value_at(from);
                (by.position * (elapsed - from), by.position * force)
            }
        }
    }

    /// How the state after `elapsed` changes with that at departure and, if that is `since` seconds after the instant at
    /// which the drive's angle is held, with the drive's frequency.
    pub(crate) fn state_transition(&self, elapsed: f64, since: Option<f64>) -> Transition {
        if let Form::TaylorStep(step) = &self.form {
            let force = since.and_then(|since| self.frequency_variation_force(step, since));
            return step.state_transition(elapsed, force.as_ref());
        }
        let matrix = self.flow.modes.transition(elapsed);
        let by_frequency = match (&self.form, since) {
            (Form::Particular { particular, .. }, Some(since)) => {
                let answer = |elapsed: f64, drive| {
                    particular.frequency_derivative(&self.flow, since + elapsed, drive)
                };
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

    /// The force of the variational equation for the frequency of the drive, -A t sin(angle), per mass and
    /// d(time)/d(sigma), as a series in sigma along a Taylor step under a constant forcing. None on the slow manifold,
    /// whose variations are those by a constant forcing, and under a forcing that is not constant.
    fn frequency_variation_force(&self, step: &TaylorStep, since: f64) -> Option<Series> {
        let forcing = &self.departure.forcing;
        if step.slow_manifold.is_some() || !forcing.is_constant() {
            return None;
        }
        let mut time = step.time_in_sigma();
        time[0] += since;
        let force = product(&time, &derivative(&step.forcing));
        Some(force.map(|coefficient| coefficient / self.flow.frequency))
    }

    /// The change of the work of the forcing per mass, up to `elapsed`, by a small change of the arc; `law` is the part
    /// of the constant forcing that is the phase's own force.
    pub(crate) fn supply_variation(&self, elapsed: f64, by: Variation, law: f64) -> f64 {
        match &self.form {
            Form::Held | Form::Chatter(_) => 0.0,
            Form::TaylorStep(step) if step.is_still() => 0.0,
            Form::TaylorStep(step) => step.supply_variation(elapsed, by, law),
            Form::Particular { .. } | Form::Responses => {
                self.supply_variation_of_linear(elapsed, by, law)
            }
        }
    }

    /// The variation of the work of the forcing under a linear law: that work is a quadratic form of the departure, so
    /// that a central difference of any width is its derivative.
    fn supply_variation_of_linear(&self, elapsed: f64, by: Variation, law: f64) -> f64 {
        let (from, w) = (self.departure, self.flow.frequency);
        let norm = |x: f64, v: f64, c: f64| x.abs() + v.abs() / w + c.abs() / (w * w);
        let size = norm(by.position, by.velocity, by.forcing);
        if size == 0.0 {
            return 0.0;
        }
        let motion = norm(from.position, from.velocity, self.flow.amplitude);
        let width = if motion > 0.0 { motion / size } else { 1.0 };
        let work = |width: f64| {
            let mut moved = from;
            moved.position += width * by.position;
            moved.velocity += width * by.velocity;
            moved.forcing = from
                .forcing
                .with_derivative(0, from.forcing.value() + width * by.forcing);
            moved.acceleration = None;
            let course = Self::new(&self.flow, moved);
            course
                .work_integrals(&course.node_at(elapsed), law)
                .supplied
        };
        (work(width) - work(-width)) / (2.0 * width)
    }
}

impl TaylorStep {
    /// The derivatives of the state `elapsed` seconds after the start of this step by the state there, and by a
    /// parameter that adds `force` per mass and d(time)/d(sigma) to the variational equation.
    fn state_transition(&self, elapsed: f64, force: Option<&Series>) -> Transition {
        budget::charge(budget::STATE_VARIATIONS);
        let sigma = self.sigma_after(elapsed);
        let law = VariationalEquation::along_step(self);
        let columns = self.variations(&law, force);
        let [first, second, forced] =
            columns.map(|[y, u]| Vector2::new(value(&y, sigma), value(&u, sigma)));
        Transition {
            matrix: Matrix2::from_columns(&[first, second]),
            damping: law.damping_integral(self.time_at_sigma(sigma), sigma),
            by_frequency: force.map(|_| self.side() * forced),
        }
    }

    /// The changes of position and velocity, as series in sigma, by a small change of the arc.
    fn state_variation(&self, by: Variation) -> [Series; 2] {
        let law = VariationalEquation::along_step(self);
        let [first, second, forced] = self.variations(&law, Some(&law.rate));
        [0, 1].map(|of| {
            std::array::from_fn(|k| {
                by.position * first[of][k]
                    + by.velocity * second[of][k]
                    + by.forcing * forced[of][k]
            })
        })
    }

    /// Solutions (position, velocity) of the variational equation along this step, as series in sigma: from (1, 0),
    /// from (0, 1), and from (0, 0) under a `force` per mass and d(time)/d(sigma), if there is one; on the slow
    /// manifold under a constant forcing.
    pub(super) fn variations(
        &self,
        law: &VariationalEquation,
        force: Option<&Series>,
    ) -> [[Series; 2]; 3] {
        match &self.slow_manifold {
            Some(slow_manifold) => {
                let echo = slow_manifold
                    .memory
                    .map(|memory| slow_manifold.echo * memory);
                [slow_manifold.memory, echo, slow_manifold.answer].map(|y| [y, derivative(&y)])
            }
            None => law.solve_variations(force),
        }
    }

    /// The change of the work of the forcing per mass along this step, up to `elapsed`, by a small change of the arc;
    /// `law` is the part of the constant forcing that is the phase's own force.
    fn supply_variation(&self, elapsed: f64, by: Variation, law: f64) -> f64 {
        let [_, changed] = self.state_variation(by);
        let rate = self.time_rate_series();
        let mut forcing = self.forcing;
        forcing[0] -= self.side() * law;
        let to = self.sigma_after(elapsed);
        let travel = integral_of_product(&rate, &self.velocity_series(), to);
        let work =
            integral_of_product(&product(&rate, &forcing), &changed, to) + by.forcing * travel;
        self.side() * work
    }
}
