//! Steps that end where the law changes.

use super::machine::{Laws, Machine, State};
use super::rise::{Fineness, Probe, rise};
use super::step::Step;
use super::{MethodError, Task};
use softstop::Start;
use softstop::internals::{Guard, Walk};

/// How often a step is halved in the search for the side that a guard begins from.
const HALVINGS: u32 = 60;

/// A motion under way, from crossing to crossing.
pub(super) struct Located<'a> {
    machine: &'a mut Machine,
    walk: Walk,
    /// The present step's start.
    at: Step,
}

/// A guard that has risen, after how long, and the state there.
type Risen = (usize, f64, State);

impl<'a> Located<'a> {
    pub fn new(machine: &'a mut Machine, task: &Task, start: Step) -> Result<Self, MethodError> {
        let mut motion = Self {
            walk: Walk::new(&machine.scene, task.start)?,
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
        let risen = match self.walk.phase_id() {
            Some(_) => {
                let to = self.at.taken(self.machine, span)?;
                let risen = self.first_rise(span, to)?;
                self.at.from = risen.map_or(to, |_| self.at.from);
                risen
            }
            None => self.first_release(span)?,
        };
        match risen {
            Some(risen) => self.cross(risen),
            None => {
                self.at.time = until;
                Ok(())
            }
        }
    }

    /// The first of a phase's guards to be above zero at the end of a step, where it rises.
    fn first_rise(&mut self, span: f64, to: State) -> Result<Option<Risen>, MethodError> {
        let mut end = (span, to);
        let mut first = None;
        for (guard, law) in self.walk.guards().iter().enumerate() {
            let value = |state: &State| law.value_at(state.position, state.velocity);
            let begins_above = value(&self.at.from) >= 0.0;
            let noise = if begins_above {
                self.noise(law, &end)
            } else {
                0.0
            };
            if value(&end.1) <= noise {
                continue;
            }
            let at = self.at;
            let ends = [(0.0, at.from), end].map(|(at, what)| Probe {
                at,
                value: value(&what),
                what,
            });
            let found = locate(ends, law, |elapsed| {
                let state = at.taken(self.machine, elapsed)?;
                Ok((value(&state), state))
            })?;
            end = (found.at, found.what);
            first = Some((guard, found.at, found.what));
        }
        Ok(first)
    }

    /// What rounding may leave of a guard that begins on zero.
    fn noise(&self, guard: &Guard, (span, to): &(f64, State)) -> f64 {
        let speed = to.velocity.abs().max(self.at.from.velocity.abs());
        let push = self.machine.phases().amplitude;
        let gained = span * (push + to.acceleration.abs());
        let position = (guard.position * to.position).abs() + guard.level.abs();
        let velocity = guard.velocity.abs() * (speed.min(gained));
        8.0 * f64::EPSILON * (position + velocity)
    }

    /// When a held mass is let go within the next `span` seconds, by the push at their end.
    fn first_release(&mut self, span: f64) -> Result<Option<Risen>, MethodError> {
        let time = self.at.time;
        self.machine.count_step(time)?;
        let (from, machine) = (self.at.from, &mut *self.machine);
        let mut end = span;
        let mut first = None;
        for (guard, law) in self.walk.guards().iter().enumerate() {
            let mut probe = |elapsed: f64| {
                machine.work.evaluations += 1;
                let value = law.push * machine.push(time + elapsed) - law.level;
                Ok((value, ()))
            };
            let [start, end_value] = [probe(0.0)?.0, probe(end)?.0];
            if end_value <= 0.0 {
                continue;
            }
            let ends = [(0.0, start), (end, end_value)].map(|(at, value)| Probe {
                at,
                value,
                what: (),
            });
            end = locate(ends, law, probe)?.at;
            first = Some((guard, end, from));
        }
        Ok(first)
    }

    fn cross(&mut self, (guard, elapsed, state): Risen) -> Result<(), MethodError> {
        let (position, velocity, acceleration) = state.parts();
        let time = self.at.time + elapsed;
        let before = Start::new(position, velocity);
        let crossed = self.walk.cross(guard, time, before);
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

/// Where a guard rises through zero between two ends, the later one above zero. If it begins on zero, it is
/// taken to dip below first; if no dip is found, it rises at once.
fn locate<T: Copy>(
    [mut low, mut high]: [Probe<T>; 2],
    law: &Guard,
    mut probe: impl FnMut(f64) -> Result<(f64, T), MethodError>,
) -> Result<Probe<T>, MethodError> {
    let (begin, width) = (low, high.at);
    let mut halvings = 0;
    while low.value >= 0.0 {
        if halvings == HALVINGS {
            return Ok(begin);
        }
        halvings += 1;
        let at = 0.5 * high.at;
        let (value, what) = probe(at)?;
        let tried = Probe { at, value, what };
        match value < 0.0 {
            true => low = tried,
            false => high = tried,
        }
    }
    let rounding = 2.0 * f64::EPSILON * law.level.abs();
    let fine = Fineness {
        width: 2.0 * f64::EPSILON * width,
        value: rounding.max(f64::EPSILON * (high.value - low.value)),
    };
    rise(low, high, fine, probe)
}
