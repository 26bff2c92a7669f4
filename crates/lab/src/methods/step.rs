//! One step of each scheme.

use super::MethodError;
use super::balance::Balance;
use super::machine::{Laws, Machine, State};
use super::scheme::{Alpha, Scheme};

/// Where a step begins, and its law.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub scheme: Scheme,
    pub laws: Laws,
    pub time: f64,
    pub from: State,
}

impl Step {
    /// The state a step `h` seconds long leads to.
    ///
    /// # Errors
    /// [`MethodError::Stuck`] if no more steps are allowed, or if an implicit equation has no solution that
    /// Newton's method finds; [`MethodError::BlownUp`] if the numbers leave all bounds.
    pub fn taken(&self, machine: &mut Machine, h: f64) -> Result<State, MethodError> {
        machine.count_step(self.time)?;
        let (x, v, _) = self.from.parts();
        let to = match (self.scheme, self.scheme.alpha()) {
            (_, Some(alpha)) => self.alpha(machine, h, &alpha)?,
            (Scheme::ExplicitEuler, _) => {
                let a = self.acceleration(machine);
                State::new(x + h * v, v + h * a, a)
            }
            (Scheme::SemiImplicitEuler, _) => {
                let a = self.acceleration(machine);
                let after = v + h * a;
                State::new(x + h * after, after, a)
            }
            (Scheme::RungeKutta4, _) => self.runge_kutta(machine, h),
            _ => self.midpoint(machine, h)?,
        };
        to.bounded(self.time)
    }

    /// The same state, with the acceleration that the scheme carries on set anew.
    pub fn restarted(&self, machine: &mut Machine) -> State {
        let (x, v, a) = self.from.parts();
        let carries = self.scheme.alpha().is_some();
        State::new(
            x,
            v,
            if carries {
                self.acceleration(machine)
            } else {
                a
            },
        )
    }

    fn acceleration(&self, machine: &mut Machine) -> f64 {
        let (x, v, _) = self.from.parts();
        machine.acceleration(self.laws, self.time, x, v)
    }

    fn runge_kutta(&self, machine: &mut Machine, h: f64) -> State {
        let (x, v, _) = self.from.parts();
        let mut slope = |after: f64, (dx, dv): (f64, f64)| {
            let (position, velocity) = (x + after * dx, v + after * dv);
            let time = self.time + after;
            let acceleration = machine.acceleration(self.laws, time, position, velocity);
            (velocity, acceleration)
        };
        let first = slope(0.0, (0.0, 0.0));
        let second = slope(0.5 * h, first);
        let third = slope(0.5 * h, second);
        let fourth = slope(h, third);
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * (b + c) + d) / 6.0;
        let velocity = mean(first.0, second.0, third.0, fourth.0);
        let acceleration = mean(first.1, second.1, third.1, fourth.1);
        State::new(x + h * velocity, v + h * acceleration, acceleration)
    }

    fn midpoint(&self, machine: &mut Machine, h: f64) -> Result<State, MethodError> {
        let (x, v, before) = self.from.parts();
        let balance = Balance {
            laws: self.laws,
            time: self.time + 0.5 * h,
            position: (x + 0.5 * h * v, 0.25 * h * h),
            velocity: (v, 0.5 * h),
            inertia: (0.0, 1.0),
        };
        let a = balance.solve(machine, before)?;
        Ok(State::new(x + h * (v + 0.5 * h * a), v + h * a, a))
    }

    fn alpha(&self, machine: &mut Machine, h: f64, with: &Alpha) -> Result<State, MethodError> {
        let (x, v, before) = self.from.parts();
        // The new position and velocity as linear functions of the new acceleration.
        let moved = h * v + (0.5 - with.beta) * h * h * before;
        let gained = (1.0 - with.gamma) * h * before;
        let new = 1.0 - with.forces;
        let balance = Balance {
            laws: self.laws,
            time: self.time + new * h,
            position: (x + new * moved, new * with.beta * h * h),
            velocity: (v + new * gained, new * with.gamma * h),
            inertia: (with.inertia * before, 1.0 - with.inertia),
        };
        let after = balance.solve(machine, before)?;
        let x = x + moved + with.beta * h * h * after;
        Ok(State::new(x, v + gained + with.gamma * h * after, after))
    }
}
