//! The equation of motion where an implicit scheme asks for it, solved for the acceleration.

use super::MethodError;
use super::machine::{Laws, Machine};

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
        let (stiffness, damping) = machine.slopes(self.laws, position, velocity);
        Rest {
            value: at(self.inertia) - acceleration,
            slope: self.inertia.1 + stiffness * self.position.1 + damping * self.velocity.1,
            size: acceleration.abs() + (stiffness * position).abs() + (damping * velocity).abs(),
        }
    }
}
