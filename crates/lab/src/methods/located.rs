//! Steps that end where the law changes.

use super::machine::{Laws, Machine, State};
use super::rise::{Probe, locate_rise};
use super::step::Step;
use super::{MethodError, Task};
use softstop::Start;
use softstop::internals::{Guard, PhaseTracker};

/// A motion under way, from crossing to crossing.
pub(super) struct Located<'a> {
    machine: &'a mut Machine,
    walk: PhaseTracker,
    /// The present step's start.
    at: Step,
}

/// A guard that rises through zero in a step.
struct Rise {
    guard: usize,
    /// Time in s since the step began.
    elapsed: f64,
    state: State,
}

impl<'a> Located<'a> {
    pub fn new(machine: &'a mut Machine, task: &Task, start: Step) -> Result<Self, MethodError> {
        let mut motion = Self {
            walk: PhaseTracker::new(&machine.scene, task.start)?,
            machine,
            at: start,
        };
        motion.depart();
        Ok(motion)
    }

    pub fn run(mut self) -> Result<State, MethodError> {
        let steps = self.machine.steps;
        for index in 1..=steps.count {
            let until = steps.time(index);
            while self.at.time < until {
                self.advance(until)?;
            }
        }
        self.machine.impacts = self.walk.into_impacts();
        Ok(self.at.from)
    }

    /// One step to `until`, or to the first crossing before.
    fn advance(&mut self, until: f64) -> Result<(), MethodError> {
        let span = until - self.at.time;
        if self.walk.phase_id().is_none() {
            self.machine.count_step(self.at.time)?;
        }
        let to = self.state_after(span)?;
        match self.first_rise(span, to)? {
            Some(rise) => self.cross(rise),
            None => {
                (self.at.time, self.at.from) = (until, to);
                Ok(())
            }
        }
    }

    /// The state that a step of the scheme leads to; that of a held mass stays.
    fn state_after(&mut self, elapsed: f64) -> Result<State, MethodError> {
        match self.walk.phase_id() {
            Some(_) => self.at.taken(self.machine, elapsed),
            None => Ok(self.at.from),
        }
    }

    /// The value of a guard in a state; a held mass is let go by the forcing of the drive, which is counted.
    fn guard_value(&mut self, law: &Guard, elapsed: f64, state: State) -> f64 {
        if self.walk.phase_id().is_some() {
            return law.value_at(state.position, state.velocity);
        }
        self.machine.work.evaluations += 1;
        law.forcing * self.machine.push(self.at.time + elapsed) - law.level
    }

    /// The first of the guards to be above zero at the end of a step, where it rises.
    fn first_rise(&mut self, span: f64, to: State) -> Result<Option<Rise>, MethodError> {
        let (mut end, mut first) = ((span, to), None);
        let from = self.at.from;
        for guard in 0..self.walk.guards().len() {
            let law = self.walk.guards()[guard];
            let ends = [(0.0, from), end].map(|(at, state)| Probe {
                at,
                value: self.guard_value(&law, at, state),
                state,
            });
            let [begin, last] = ends;
            let noise = match begin.value >= 0.0 && self.walk.phase_id().is_some() {
                true => self.noise(&law, &end),
                false => 0.0,
            };
            if last.value <= noise {
                continue;
            }
            let width = 2.0 * f64::EPSILON * last.at;
            let rounding = 2.0 * f64::EPSILON * law.level.abs();
            let tolerance = rounding.max(f64::EPSILON * (last.value - begin.value));
            let found = locate_rise(ends, width, tolerance, |elapsed| {
                let state = self.state_after(elapsed)?;
                Ok::<_, MethodError>((self.guard_value(&law, elapsed, state), state))
            })?;
            end = (found.at, found.state);
            first = Some(Rise {
                guard,
                elapsed: found.at,
                state: found.state,
            });
        }
        Ok(first)
    }

    /// What rounding may leave of a guard that begins on zero.
    fn noise(&self, guard: &Guard, (span, to): &(f64, State)) -> f64 {
        let speed = to.velocity.abs().max(self.at.from.velocity.abs());
        let forcing = self.machine.phases().amplitude;
        let gained = span * (forcing + to.acceleration.abs());
        let position = (guard.position * to.position).abs() + guard.level.abs();
        let velocity = guard.velocity.abs() * (speed.min(gained));
        8.0 * f64::EPSILON * (position + velocity)
    }

    fn cross(&mut self, rise: Rise) -> Result<(), MethodError> {
        let (position, velocity, acceleration) = rise.state.parts();
        let time = self.at.time + rise.elapsed;
        let before = Start::new(position, velocity);
        let crossed = self.walk.cross(rise.guard, time, before);
        crossed.map_err(|error| MethodError::from(error).after(self.machine.work.steps))?;
        self.at.time = time;
        self.at.from = State {
            acceleration,
            ..State::of(self.walk.state())
        };
        self.depart();
        Ok(())
    }

    /// Begins a phase.
    fn depart(&mut self) {
        if let Some(phase) = self.walk.phase_id() {
            self.at.laws = Laws::One(phase);
            self.at.from = self.at.restarted(self.machine);
        }
    }
}
