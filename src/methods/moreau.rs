//! Moreau's time stepping for rigid stops (Jean and Moreau 1987; Moreau 1988).

use super::balance::Balance;
use super::ignored::{Places, Span};
use super::machine::{Laws, Machine, State, Steps, in_range, prepare};
use super::{Integrator, MethodError, Solution, Task};
use crate::integrator::Impact;

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
/// one are forces as those of the suspension. A contact that lasts is held at the velocity 0, whatever
/// the number of impacts that led to it; of these, many may lie in one step.
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
        let prepared = prepare(task, self.step)?;
        let mut machine = Machine::new(task, &prepared.phases);
        let places = Places::of(task, &machine);
        let Some(wall) = places.wall else {
            return Err(MethodError::Unsuited {
                method: self.name(),
                reason:
                    "the scene has no rigid stop, and without one there is no impulse to step over"
                        .to_owned(),
            });
        };
        let stepping = Stepping {
            theta: self.theta,
            places,
            wall,
        };
        let end = stepping.run(&mut machine, prepared.steps, task)?;
        Ok(machine.finish(end))
    }
}

struct Stepping {
    theta: f64,
    places: Places,
    wall: (f64, f64),
}

impl Stepping {
    fn run(&self, machine: &mut Machine, steps: Steps, task: &Task) -> Result<State, MethodError> {
        let (position, velocity) = (task.start.position, task.start.velocity);
        let mut state = State {
            position,
            velocity,
            acceleration: 0.0,
        };
        for index in 0..steps.count {
            let time = steps.time(index);
            let h = steps.time(index + 1) - time;
            machine.count_step(time)?;
            let to = self.step(machine, time, h, &state)?;
            if !to.is_finite() {
                return Err(MethodError::BlownUp { time });
            }
            self.note(machine, time, h, (state, to));
            state = to;
        }
        Ok(state)
    }

    fn step(
        &self,
        machine: &mut Machine,
        time: f64,
        h: f64,
        from: &State,
    ) -> Result<State, MethodError> {
        let State {
            position,
            velocity,
            acceleration: guess,
        } = *from;
        let theta = self.theta;
        let before = machine.acceleration(Laws::All, time, position, velocity);
        let gained = (1.0 - theta) * h * before;
        let balance = Balance {
            laws: Laws::All,
            time: time + h,
            position: (
                position + h * (velocity + theta * gained),
                theta * theta * h * h,
            ),
            velocity: (velocity + gained, theta * h),
            inertia: (0.0, 1.0),
        };
        let acceleration = balance.solve(machine, guess)?;
        let free = velocity + gained + theta * h * acceleration;
        let reached = if self.touches(h, from) {
            free.min(-self.wall.1 * velocity)
        } else {
            free
        };
        Ok(State {
            position: position + h * (theta * reached + (1.0 - theta) * velocity),
            velocity: reached,
            acceleration,
        })
    }

    fn touches(&self, h: f64, from: &State) -> bool {
        from.position + 0.5 * h * from.velocity >= self.wall.0
    }

    /// An impact at the rigid stop is a step with a mass that comes on with a velocity and is sent back or
    /// stopped.
    fn note(&self, machine: &mut Machine, time: f64, h: f64, (from, to): (State, State)) {
        if !self.places.wall_is_clearance() {
            let length = h;
            Span {
                time,
                length,
                from,
                to,
            }
            .note_passing(machine, self.places);
        } else if self.touches(h, &from) && from.velocity > 0.0 {
            let ahead = (self.wall.0 - from.position) / from.velocity;
            machine.impacts.push(Impact {
                time: time + ahead.clamp(0.0, h),
                velocity: from.velocity,
            });
        }
    }
}
