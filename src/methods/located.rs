//! Steps that end where the law changes.

use super::MethodError;
use super::machine::{Laws, Machine, State, Steps};
use super::rise::{Fineness, Probe, rise};
use super::step::Step;
use crate::events::{Found, Guard};
use crate::flow::Polynomial;
use crate::integrator::{CrossingKind, Ground, Hum, Impact};
use crate::phases::Mode;

/// Crossings in a row that may take no time at all.
const MOST_AT_ONCE: u32 = 1_000;
/// How often a step is halved in the search for the side that a guard begins from.
const HALVINGS: u32 = 60;

/// A motion under way, from crossing to crossing.
pub(super) struct Located<'a, 'b> {
    machine: &'a mut Machine<'b>,
    /// The present step's start.
    at: Step,
    mode: Mode,
    hum: Hum,
    period: f64,
    at_once: u32,
}

/// A guard that has risen, and where.
#[derive(Clone, Copy)]
struct Risen {
    guard: usize,
    elapsed: f64,
    state: State,
}

impl<'a, 'b> Located<'a, 'b> {
    pub fn new(machine: &'a mut Machine<'b>, start: Step, period: f64) -> Self {
        let State {
            position, velocity, ..
        } = start.from;
        let mode = machine
            .phases
            .locate(position, velocity, machine.push(0.0), true);
        let mut motion = Self {
            machine,
            at: start,
            mode,
            hum: Hum::default(),
            period,
            at_once: 0,
        };
        motion.depart(mode);
        motion
    }

    pub fn run(mut self, steps: Steps) -> Result<State, MethodError> {
        for index in 1..=steps.count {
            let until = steps.time(index);
            while self.at.time < until {
                self.advance(until)?;
            }
        }
        Ok(self.at.from)
    }

    /// One step to `until`, or to the first crossing before.
    fn advance(&mut self, until: f64) -> Result<(), MethodError> {
        let span = until - self.at.time;
        let risen = match self.mode {
            Mode::Moving(phase) => {
                let to = self.at.taken(self.machine, span)?;
                match self.first_rise(phase, span, to)? {
                    Some(risen) => Some(risen),
                    None => {
                        self.at.from = to;
                        None
                    }
                }
            }
            Mode::Held { forward, backward } => self.first_release(forward, backward, span)?,
            Mode::Chattering { backward } => self.first_release(None, backward, span)?,
        };
        match risen {
            Some(risen) => self.cross(risen),
            None => {
                self.at.time = until;
                self.at_once = 0;
                Ok(())
            }
        }
    }

    /// The first of a phase's guards to be above zero at the end of a step, where it rises.
    fn first_rise(
        &mut self,
        phase: usize,
        span: f64,
        to: State,
    ) -> Result<Option<Risen>, MethodError> {
        let phases = self.machine.phases;
        let mut end = (span, to);
        let mut first = None;
        for (guard, law) in phases.phases[phase].guards.iter().enumerate() {
            let start = value(law, &self.at.from);
            let noise = if start >= 0.0 {
                self.noise(law, &end)
            } else {
                0.0
            };
            if value(law, &end.1) <= noise {
                continue;
            }
            let at = self.at;
            let machine = &mut *self.machine;
            let mut probe = |elapsed: f64| {
                let state = at.taken(machine, elapsed)?;
                Ok((value(law, &state), state))
            };
            let ends = [(0.0, at.from), end].map(|(at, state)| Probe {
                at,
                value: value(law, &state),
                what: state,
            });
            let rounding = 2.0 * f64::EPSILON * law.level.abs();
            let found = locate(ends, rounding, &mut probe)?;
            end = (found.at, found.what);
            first = Some(Risen {
                guard,
                elapsed: found.at,
                state: found.what,
            });
        }
        Ok(first)
    }

    /// What rounding may leave of a guard that begins on zero.
    fn noise(&self, guard: &Guard, (span, to): &(f64, State)) -> f64 {
        let speed = to.velocity.abs().max(self.at.from.velocity.abs());
        let push = self.machine.phases.held.amplitude;
        let gained = span * (push + to.acceleration.abs());
        let position = (guard.position * to.position).abs() + guard.level.abs();
        let velocity = guard.velocity.abs() * (speed.min(gained));
        8.0 * f64::EPSILON * (position + velocity)
    }

    /// When a held mass is let go within the next `span` seconds, by the push at their end.
    fn first_release(
        &mut self,
        forward: Option<usize>,
        backward: usize,
        span: f64,
    ) -> Result<Option<Risen>, MethodError> {
        let time = self.at.time;
        self.machine.count_step(time)?;
        let (from, machine) = (self.at.from, &mut *self.machine);
        let push = machine.push(time);
        let (guards, _, count) = machine
            .phases
            .releases(forward, backward, from.position, push);
        let mut end = span;
        let mut first = None;
        for (guard, law) in guards[..count].iter().enumerate() {
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
            let rounding = 2.0 * f64::EPSILON * law.level.abs();
            end = locate(ends, rounding, &mut probe)?.at;
            first = Some(Risen {
                guard,
                elapsed: end,
                state: from,
            });
        }
        Ok(first)
    }

    fn cross(&mut self, risen: Risen) -> Result<(), MethodError> {
        let time = self.at.time + risen.elapsed;
        let instantly = time - self.at.time < 0.25 * f64::EPSILON * self.period;
        self.at_once = if instantly { self.at_once + 1 } else { 0 };
        if self.at_once > MOST_AT_ONCE {
            let reason = "crossings of one place follow each other in no time";
            return Err(self.machine.stuck(time, reason));
        }
        let moved = self.at.from.velocity != 0.0 || !instantly;
        self.at.time = time;
        let mode = match self.mode {
            Mode::Moving(phase) => self.land(phase, risen, moved),
            Mode::Held { forward, backward } => self.let_go(forward, backward, risen),
            Mode::Chattering { backward } => self.let_go(None, backward, risen),
        };
        self.depart(mode);
        Ok(())
    }

    /// Into the phase that a release leads to.
    fn let_go(&self, forward: Option<usize>, backward: usize, risen: Risen) -> Mode {
        let push = self.machine.push(self.at.time);
        let position = self.at.from.position;
        let (_, phases, _) = self
            .machine
            .phases
            .releases(forward, backward, position, push);
        Mode::Moving(phases[risen.guard])
    }

    /// By the rules of the exact method. The last bounces on a rigid stop, which that one sums, count as rest.
    fn land(&mut self, phase: usize, risen: Risen, moved: bool) -> Mode {
        let phases = self.machine.phases;
        let found = Found {
            elapsed: risen.elapsed,
            guard: risen.guard,
            position: risen.state.position,
            velocity: risen.state.velocity,
        };
        if let Some(surface) = phases.endless_surface(phase, risen.guard) {
            self.hum.count(surface, found.velocity);
        }
        let ground = Ground {
            phases,
            fed: true,
            pierced: false,
            threshold: self.hum.threshold(),
            force: &Polynomial::default(),
            period: self.period,
        };
        let push = self.machine.push(self.at.time);
        let landing = ground.leave(phase, &found, push, moved);
        if let CrossingKind::Surface { impact: true, .. }
        | CrossingKind::Rebound { impact: true, .. } = landing.kind
        {
            let (time, velocity) = (self.at.time, found.velocity);
            self.machine.impacts.push(Impact { time, velocity });
        }
        let summed = landing.chatter.is_some();
        self.at.from = State {
            position: landing.state.position,
            velocity: if summed { 0.0 } else { landing.state.velocity },
            ..risen.state
        };
        match landing.mode {
            Mode::Chattering { backward } => {
                phases.leave_hold(None, backward, landing.state.position, push)
            }
            mode => mode,
        }
    }

    /// Begins a phase.
    fn depart(&mut self, mode: Mode) {
        self.mode = mode;
        if let Mode::Moving(phase) = mode {
            self.at.laws = Laws::One(phase);
            self.at.from = self.at.restarted(self.machine);
        }
    }
}

fn value(guard: &Guard, state: &State) -> f64 {
    guard.value(state.position, state.velocity)
}

/// Where a function rises through zero between two ends, the later one above zero. If it begins on zero, it is
/// taken to dip below first; if no dip is found, it rises at once.
fn locate<T: Copy>(
    [mut low, mut high]: [Probe<T>; 2],
    rounding: f64,
    probe: &mut impl FnMut(f64) -> Result<(f64, T), MethodError>,
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
        if value < 0.0 {
            low = tried;
        } else {
            high = tried;
        }
    }
    let fine = Fineness {
        width: 2.0 * f64::EPSILON * width,
        value: rounding.max(f64::EPSILON * (high.value - low.value)),
    };
    rise(low, high, fine, probe)
}
