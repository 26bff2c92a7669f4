//! Steps on a fixed grid that take the law as it is where the state is, whatever they step over.

use super::machine::{Machine, State};
use super::rise::{Probe, locate_rise};
use super::step::Step;
use super::{MethodError, Task};
use softstop::{Impact, Wall};

/// The places that end or count a motion onwards.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    /// The clearance, if something stands there.
    pub clearance: Option<f64>,
    /// The rigid stop and its restitution.
    pub wall: Option<Wall>,
}

impl Places {
    pub fn of(task: &Task, machine: &Machine) -> Self {
        let any = !machine.phases().surfaces.is_empty();
        Self {
            clearance: any.then_some(task.scene.clearance),
            wall: task.scene.wall(),
        }
    }

    /// True if nothing stands before the rigid stop.
    pub fn wall_is_clearance(&self) -> bool {
        self.wall
            .is_some_and(|wall| self.clearance == Some(wall.position))
    }
}

/// Runs all steps. A mass that is beyond the rigid stop at the end of one is put on it and sent back with
/// restitution: time and energy of the flight behind it are not given back.
pub(super) fn run(
    machine: &mut Machine,
    places: Places,
    start: Step,
) -> Result<State, MethodError> {
    let mut from = start.restarted(machine);
    let steps = machine.steps;
    for index in 0..steps.count {
        let (time, next) = (steps.time(index), steps.time(index + 1));
        let step = Step {
            time,
            from,
            ..start
        };
        let length = next - time;
        let to = step.taken(machine, length)?;
        let span = TakenStep {
            time,
            length,
            from,
            to,
        };
        from = span.land(machine, places, &step);
    }
    Ok(from)
}

/// A step that has been made.
pub(super) struct TakenStep {
    pub time: f64,
    pub length: f64,
    pub from: State,
    pub to: State,
}

impl TakenStep {
    fn land(&self, machine: &mut Machine, places: Places, step: &Step) -> State {
        let hit = places.wall.filter(|wall| self.to.position > wall.position);
        if !places.wall_is_clearance() {
            self.note_passing(machine, places);
        }
        let Some(wall) = hit else {
            return self.to;
        };
        if places.wall_is_clearance() {
            machine.impacts.push(self.impact_at(wall.position));
        }
        let (_, velocity, acceleration) = self.to.parts();
        let back = if velocity > 0.0 {
            -wall.restitution
        } else {
            1.0
        };
        let restart = Step {
            time: self.time + self.length,
            from: State::new(wall.position, back * velocity, acceleration),
            ..*step
        };
        restart.restarted(machine)
    }

    /// Counts an impact if the clearance is passed onwards between both ends.
    pub fn note_passing(&self, machine: &mut Machine, places: Places) {
        let passed = |at: &f64| self.from.position < *at && self.to.position >= *at;
        if let Some(clearance) = places.clearance.filter(passed) {
            machine.impacts.push(self.impact_at(clearance));
        }
    }

    /// Time and velocity at a position between both ends, by the cubic that has their positions and velocities.
    fn impact_at(&self, position: f64) -> Impact {
        let probe = |share: f64| {
            let (x, velocity) = self.cubic(share);
            Ok::<_, std::convert::Infallible>((x - position, velocity))
        };
        let end = |at: f64, state: &State| Probe {
            at,
            value: state.position - position,
            state: state.velocity,
        };
        let (low, high) = (end(0.0, &self.from), end(1.0, &self.to));
        if low.value >= 0.0 {
            return Impact {
                time: self.time,
                velocity: self.from.velocity.max(0.0),
            };
        }
        let tolerance = f64::EPSILON * position.abs();
        let Ok(found) = locate_rise([low, high], f64::EPSILON, tolerance, probe);
        Impact {
            time: self.time + found.at * self.length,
            velocity: found.state,
        }
    }

    fn cubic(&self, s: f64) -> (f64, f64) {
        let (h, from, to) = (self.length, &self.from, &self.to);
        let rise = to.position - from.position;
        // Newton's form of the interpolant with both ends taken twice.
        let first = rise - h * from.velocity;
        let second = h * (from.velocity + to.velocity) - 2.0 * rise;
        let position = from.position + s * (h * from.velocity + s * (first + (s - 1.0) * second));
        let slope = h * from.velocity + s * (2.0 * first + (3.0 * s - 2.0) * second);
        (position, slope / h)
    }
}
