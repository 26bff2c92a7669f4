//! One step of each scheme, and the equation of motion where an implicit one asks for it.

use super::MethodError;
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

/// Newton's method stops where the equation holds to this share of its largest term.
const TOLERANCE: f64 = 1e-14;
/// Iterations after which it gives up.
const ITERATIONS: u32 = 200;

/// `inertia` = acceleration at (`time`, `position`, `velocity`), each pair (c, d) short for c + d a with
/// the unknown a.
pub(super) struct Balance {
    pub laws: Laws,
    pub time: f64,
    pub position: (f64, f64),
    pub velocity: (f64, f64),
    pub inertia: (f64, f64),
}

/// What is left of the equation at some a.
struct Rest {
    value: f64,
    slope: f64,
    /// Sum of the sizes of its terms.
    size: f64,
}

impl Balance {
    /// Newton's method inside a bracket: a step that leaves the bracket is replaced by its middle. Where the force
    /// jumps past the balance the bracket shrinks to that place, and the force is one between both sides
    /// (Filippov 1988).
    ///
    /// # Errors
    /// [`MethodError::Stuck`] if the equation has no slope upwards, or after too many iterations.
    pub fn solve(&self, machine: &mut Machine, guess: f64) -> Result<f64, MethodError> {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut at = guess;
        for _ in 0..ITERATIONS {
            let Rest { value, slope, size } = self.rest(machine, at);
            if !value.is_finite() {
                return Err(MethodError::BlownUp { time: self.time });
            }
            if slope <= 0.0 {
                let reason = "the implicit equation does not determine the step";
                return Err(machine.stuck(self.time, reason));
            }
            let next = at - value / slope;
            if value.abs() <= TOLERANCE * size || next == at {
                return Ok(next);
            }
            match value > 0.0 {
                true => high = at,
                false => low = at,
            }
            let middle = 0.5 * (low + high);
            let is_inside = low < next && next < high;
            at = if is_inside { next } else { middle };
            if at <= low || at >= high || slope * (high - low) <= TOLERANCE * size {
                return Ok(middle);
            }
        }
        Err(machine.stuck(self.time, "Newton's method does not converge"))
    }

    fn rest(&self, machine: &mut Machine, a: f64) -> Rest {
        let at = |(constant, factor): (f64, f64)| factor.mul_add(a, constant);
        let (position, velocity) = (at(self.position), at(self.velocity));
        let acceleration = machine.acceleration(self.laws, self.time, position, velocity);
        let (stiffness, damping) = machine.force_derivatives(self.laws, position, velocity);
        Rest {
            value: at(self.inertia) - acceleration,
            slope: self.inertia.1 + stiffness * self.position.1 + damping * self.velocity.1,
            size: acceleration.abs() + (stiffness * position).abs() + (damping * velocity).abs(),
        }
    }
}
