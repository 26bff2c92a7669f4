//! Moreau's time stepping for rigid stops (Jean and Moreau 1987; Moreau 1988).

use super::balance::Balance;
use super::ignored::{Places, Span};
use super::machine::{Laws, Machine, State, Steps, in_range, prepare};
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
    wall: Wall,
}

impl Stepping {
    fn run(&self, machine: &mut Machine, steps: Steps, task: &Task) -> Result<State, MethodError> {
        let (position, velocity) = (task.start.position, task.start.velocity);
        let mut state = State {
            position,
            velocity,
            acceleration: 0.0,
        };
        let mut was_pushed = false;
        for index in 0..steps.count {
            let time = steps.time(index);
            let h = steps.time(index + 1) - time;
            machine.count_step(time)?;
            let (to, is_pushed) = self.step(machine, time, h, &state)?;
            if !to.is_finite() {
                return Err(MethodError::BlownUp { time });
            }
            let span = Span {
                time,
                length: h,
                from: state,
                to,
            };
            self.note(machine, &span, is_pushed && !was_pushed);
            (state, was_pushed) = (to, is_pushed);
        }
        Ok(state)
    }

    /// The end of a step, and whether the stop has given an impulse.
    fn step(
        &self,
        machine: &mut Machine,
        time: f64,
        h: f64,
        from: &State,
    ) -> Result<(State, bool), MethodError> {
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
        let Wall {
            position: wall,
            restitution,
        } = self.wall;
        let touches = position + 0.5 * h * velocity >= wall;
        let pushed = touches && free > -restitution * velocity;
        let reached = if pushed {
            -restitution * velocity
        } else {
            free
        };
        let to = State {
            position: position + h * (theta * reached + (1.0 - theta) * velocity),
            velocity: reached,
            acceleration,
        };
        Ok((to, pushed))
    }

    fn note(&self, machine: &mut Machine, span: &Span, is_hit: bool) {
        let from = &span.from;
        if !self.places.wall_is_clearance() {
            span.note_passing(machine, self.places);
        } else if is_hit && from.velocity > 0.0 {
            let ahead = (self.wall.position - from.position) / from.velocity;
            machine.impacts.push(Impact {
                time: span.time + ahead.clamp(0.0, span.length),
                velocity: from.velocity,
            });
        }
    }
}
