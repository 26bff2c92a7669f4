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
        let to = match self.scheme {
            Scheme::ExplicitEuler => self.explicit_euler(machine, h),
            Scheme::SemiImplicitEuler => self.semi_implicit_euler(machine, h),
            Scheme::RungeKutta4 => self.runge_kutta(machine, h),
            Scheme::ImplicitMidpoint => self.midpoint(machine, h)?,
            Scheme::Newmark { .. } | Scheme::GeneralisedAlpha { .. } => {
                let Some(alpha) = self.scheme.alpha() else {
                    return Ok(self.from);
                };
                self.alpha(machine, h, &alpha)?
            }
        };
        if to.is_finite() {
            Ok(to)
        } else {
            Err(MethodError::BlownUp { time: self.time })
        }
    }

    /// The same state, with the acceleration that the scheme carries on set anew.
    pub fn restarted(&self, machine: &mut Machine) -> State {
        if self.scheme.alpha().is_none() {
            return self.from;
        }
        let State {
            position, velocity, ..
        } = self.from;
        State {
            acceleration: machine.acceleration(self.laws, self.time, position, velocity),
            ..self.from
        }
    }

    fn explicit_euler(&self, machine: &mut Machine, h: f64) -> State {
        let State {
            position, velocity, ..
        } = self.from;
        let acceleration = machine.acceleration(self.laws, self.time, position, velocity);
        State {
            position: position + h * velocity,
            velocity: velocity + h * acceleration,
            acceleration,
        }
    }

    fn semi_implicit_euler(&self, machine: &mut Machine, h: f64) -> State {
        let State { position, .. } = self.from;
        let State {
            velocity,
            acceleration,
            ..
        } = self.explicit_euler(machine, h);
        State {
            position: position + h * velocity,
            velocity,
            acceleration,
        }
    }

    fn runge_kutta(&self, machine: &mut Machine, h: f64) -> State {
        let (x, v) = (self.from.position, self.from.velocity);
        let mut slope = |after: f64, (dx, dv): (f64, f64)| {
            let (position, velocity) = (x + after * dx, v + after * dv);
            let acceleration =
                machine.acceleration(self.laws, self.time + after, position, velocity);
            (velocity, acceleration)
        };
        let first = slope(0.0, (0.0, 0.0));
        let second = slope(0.5 * h, first);
        let third = slope(0.5 * h, second);
        let fourth = slope(h, third);
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * (b + c) + d) / 6.0;
        let acceleration = mean(first.1, second.1, third.1, fourth.1);
        State {
            position: x + h * mean(first.0, second.0, third.0, fourth.0),
            velocity: v + h * acceleration,
            acceleration,
        }
    }

    fn midpoint(&self, machine: &mut Machine, h: f64) -> Result<State, MethodError> {
        let (x, v) = (self.from.position, self.from.velocity);
        let balance = Balance {
            laws: self.laws,
            time: self.time + 0.5 * h,
            position: (x + 0.5 * h * v, 0.25 * h * h),
            velocity: (v, 0.5 * h),
            inertia: (0.0, 1.0),
        };
        let acceleration = balance.solve(machine, self.from.acceleration)?;
        Ok(State {
            position: x + h * (v + 0.5 * h * acceleration),
            velocity: v + h * acceleration,
            acceleration,
        })
    }

    fn alpha(&self, machine: &mut Machine, h: f64, with: &Alpha) -> Result<State, MethodError> {
        let State {
            position,
            velocity,
            acceleration: before,
        } = self.from;
        // The new position and velocity as linear functions of the new acceleration.
        let moved = h * velocity + (0.5 - with.beta) * h * h * before;
        let gained = (1.0 - with.gamma) * h * before;
        let new = 1.0 - with.forces;
        let balance = Balance {
            laws: self.laws,
            time: self.time + new * h,
            position: (position + new * moved, new * with.beta * h * h),
            velocity: (velocity + new * gained, new * with.gamma * h),
            inertia: (with.inertia * before, 1.0 - with.inertia),
        };
        let after = balance.solve(machine, before)?;
        Ok(State {
            position: position + moved + with.beta * h * h * after,
            velocity: velocity + gained + with.gamma * h * after,
            acceleration: after,
        })
    }
}
