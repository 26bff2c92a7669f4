//! Moreau's time stepping for rigid stops (Jean and Moreau 1987; Moreau 1988).

use super::ignored::{Places, TakenStep};
use super::machine::{Laws, Machine, State, in_range};
use super::step::Balance;
use super::{Integrator, MethodError, Solution, Task};
use softstop::{Impact, Wall};

/// Steps on the level of velocities: impacts are not located but taken up by the step in which they lie.
///
/// With the forces taken at both ends by theta and 1 - theta,
///
/// ```text
/// v+ - v = h (theta a+ + (1 - theta) a) - p / m,     x+ = x + h (theta v+ + (1 - theta) v),
/// 0 <= p  and  v+ <= -R v,  one of them with equality, if x + h v / 2 lies beyond the stop; else p = 0.
/// ```
///
/// One contact has the solution v+ = min(v of the step without it, -R v). Softer stops in front of the rigid
/// one are forces as those of the suspension. An impact is a step with an impulse on a mass that comes on, after one
/// without; of shorter flights nothing is seen, and a mass that is pressed on rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moreau {
    /// Longest step in s, > 0.
    pub step: f64,
    /// Weight of the step's end, in [0, 1]; 1/2 is of second order between impacts.
    pub theta: f64,
}

impl Integrator for Moreau {
    fn name(&self) -> String {
        format!("Moreau, h = {} s, theta = {}", self.step, self.theta)
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        let allowed = (0.0..=1.0).contains(&self.theta);
        in_range("theta", self.theta, allowed, "in [0, 1]")?;
        let mut machine = Machine::new(task, self.step)?;
        let places = Places::of(task, &machine);
        let Some(wall) = places.wall else {
            let reason =
                "the scene has no rigid stop, and without one there is no impulse to step over";
            return Err(MethodError::Unsuited {
                method: self.name(),
                reason: reason.to_owned(),
            });
        };
        let (mut from, mut was_pushed) = (State::of(task.start), false);
        let steps = machine.steps;
        for index in 0..steps.count {
            let time = steps.time(index);
            let length = steps.time(index + 1) - time;
            machine.count_step(time)?;
            let (to, is_pushed) = self.step(&mut machine, wall, time, length, from)?;
            let span = TakenStep {
                time,
                length,
                from,
                to: to.bounded(time)?,
            };
            if !places.wall_is_clearance() {
                span.note_passing(&mut machine, places);
            } else if is_pushed && !was_pushed && from.velocity > 0.0 {
                let ahead = (wall.position - from.position) / from.velocity;
                machine.impacts.push(Impact {
                    time: time + ahead.clamp(0.0, length),
                    velocity: from.velocity,
                });
            }
            (from, was_pushed) = (to, is_pushed);
        }
        Ok(machine.finish(from))
    }
}

impl Moreau {
    /// The end of a step, and whether the stop has given an impulse.
    fn step(
        &self,
        machine: &mut Machine,
        wall: Wall,
        time: f64,
        h: f64,
        from: State,
    ) -> Result<(State, bool), MethodError> {
        let (position, velocity, guess) = from.parts();
        let theta = self.theta;
        let before = machine.acceleration(Laws::All, time, position, velocity);
        let gained = (1.0 - theta) * h * before;
        let along = position + h * (velocity + theta * gained);
        let balance = Balance {
            laws: Laws::All,
            time: time + h,
            position: (along, theta * theta * h * h),
            velocity: (velocity + gained, theta * h),
            inertia: (0.0, 1.0),
        };
        let acceleration = balance.solve(machine, guess)?;
        let free = velocity + gained + theta * h * acceleration;
        let back = -wall.restitution * velocity;
        let touches = position + 0.5 * h * velocity >= wall.position;
        let pushed = touches && free > back;
        let reached = if pushed { back } else { free };
        let moved = position + h * (theta * reached + (1.0 - theta) * velocity);
        Ok((State::new(moved, reached, acceleration), pushed))
    }
}
