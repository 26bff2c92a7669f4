//! A periodic motion from event to event, and the equations that it solves.

use serde::Serialize;

use crate::elementary::full_turn;
use crate::interval::Interval;
use crate::machine::{Guard, Law, Machine};
use crate::number::{Dual, Number};

/// What happens where one arc ends and the next one begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Kind {
    /// A guard rises through zero.
    Crossing,
    /// A guard touches zero from below, at velocity zero: grazing. The phase goes on.
    Touch,
    /// Drive angle 0, where a motion begins that crosses nothing.
    Section,
}

/// An event, and the phase that follows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Event {
    /// What happens.
    pub event: Kind,
    /// The guard, one of the phase before.
    pub guard: usize,
    /// The phase that follows.
    pub phase: usize,
}

/// Drive angle in rad and state of an event.
#[derive(Debug, Clone)]
pub struct State<T> {
    /// Drive angle in rad.
    pub angle: T,
    /// Position in m.
    pub position: T,
    /// Velocity in m/s.
    pub velocity: T,
}

/// Unknowns of each event: drive angle, position, velocity before it.
pub const UNKNOWNS: usize = 3;

/// A motion that repeats after some drive periods: its events in order of time.
#[derive(Debug, Clone)]
pub struct Motion {
    /// The machine.
    pub machine: Machine,
    /// Drive periods of the motion.
    pub periods: u64,
    /// The events of a period of the motion.
    pub events: Vec<Event>,
}

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Problem {
    /// The motion at this drive frequency in rad/s.
    Orbit {
        /// The frequency.
        frequency: f64,
    },
    /// The motion and the frequency at which one of its events is a touch.
    Grazing,
    /// The motion and the frequency at which a multiplier is 1, with the tangent that a period carries into itself (Moore
    /// and Spence 1980); one component of the tangent is 1.
    Fold {
        /// The index of the component.
        pinned: usize,
    },
    /// The motion and the frequency at which a multiplier is -1, with the tangent that a period carries into its opposite; one
    /// component of the tangent is 1.
    Flip {
        /// The index of the component.
        pinned: usize,
    },
}

impl Motion {
    /// Its impacts in a period: how often it comes to the clearance.
    pub fn impacts(&self) -> usize {
        let crossings =
            (0..self.events.len()).filter(|it| self.events[*it].event == Kind::Crossing);
        crossings.filter(|it| self.guard(*it).impact).count()
    }

    /// True if no event may be the first one, whole drive periods later, before the period is over. A section may be at every
    /// drive period: a motion with one is proven for a single period alone.
    pub fn has_no_shorter_period(&self, unknowns: &[Interval]) -> bool {
        if self.events.iter().any(|it| it.event == Kind::Section) {
            return self.periods == 1;
        }
        let angles = unknowns.iter().step_by(UNKNOWNS);
        let apart = |angle: &Interval, periods: u64| {
            let turns = full_turn() * Interval::point(periods as f64);
            !(*angle - unknowns[0] - turns).contains(0.0)
        };
        let mut later = angles.skip(1);
        later.all(|angle| (1..self.periods).all(|periods| apart(angle, periods)))
    }

    /// The number of unknowns of its events.
    pub fn unknowns(&self) -> usize {
        UNKNOWNS * self.events.len()
    }

    /// The law of the arc after an event.
    pub fn law(&self, event: usize) -> &Law {
        &self.machine.phases[self.events[event].phase].law
    }

    /// The guard that is zero at an event, counted on into the next period.
    pub fn guard(&self, event: usize) -> &Guard {
        let count = self.events.len();
        let before = self.events[(event + count - 1) % count].phase;
        &self.machine.phases[before].guards[self.events[event % count].guard]
    }

    /// The state right before an event; that of the first one a period of the motion later for the one after the last.
    pub fn before<T: Number>(&self, event: usize, unknowns: &[T]) -> State<T> {
        let first = UNKNOWNS * (event % self.events.len());
        let [angle, position, velocity] = [0, 1, 2].map(|it| unknowns[first + it].clone());
        let angle = match event < self.events.len() {
            true => angle,
            false => angle + T::from(full_turn() * Interval::point(self.periods as f64)),
        };
        State {
            angle,
            position,
            velocity,
        }
    }

    /// The state right after an event.
    pub fn after<T: Number>(&self, event: usize, unknowns: &[T]) -> State<T> {
        let before = self.before(event, unknowns);
        match self.events[event].event {
            Kind::Crossing => State {
                velocity: before.velocity.times(self.guard(event).factor),
                ..before
            },
            Kind::Touch | Kind::Section => before,
        }
    }

    /// Position and velocity at a drive angle, `elapsed` seconds after a state under a law.
    pub fn flow<T: Number>(
        &self,
        law: &Law,
        frequency: &T,
        from: &State<T>,
        (angle, elapsed): (&T, &T),
    ) -> (T, T) {
        let steady = Steady::new(&self.machine, law, frequency);
        let decay = self.machine.decay(law);
        let (u, s) = elapsed.decay(&decay);
        let (x0, v0) = steady.at(&from.angle);
        let (x1, v1) = steady.at(angle);
        let dx = from.position.clone() - x0;
        let dv = from.velocity.clone() - v0;
        let position = u.clone() * dx.clone() + s.clone() * (dx.times(decay.rate) + dv.clone());
        let velocity = u * dv.clone() - s * (dx.times(decay.stiffness) + dv.times(decay.rate));
        (x1 + position, v1 + velocity)
    }

    /// What is left of the equations of a problem: zero on the motion that is sought. The unknowns are those of the events, at a
    /// fold and a flip a tangent, and but for an orbit the frequency.
    pub fn residuals<T: Number>(&self, problem: Problem, unknowns: &[T]) -> Vec<T> {
        let own = self.unknowns();
        let last = || unknowns[unknowns.len() - 1].clone();
        let (multiplier, pinned) = match problem {
            Problem::Orbit { frequency } => {
                return self.misses(unknowns, unknowns, &Interval::point(frequency).into());
            }
            Problem::Grazing => return self.misses(unknowns, unknowns, &last()),
            Problem::Fold { pinned } => (Interval::ONE, pinned),
            Problem::Flip { pinned } => (-Interval::ONE, pinned),
        };
        let tangents = &unknowns[own..2 * own];
        let along = |factor: Interval| -> Vec<Dual<T>> {
            let pairs = unknowns[..own].iter().zip(tangents);
            let with = |(value, slope): (&T, &T)| Dual {
                value: value.clone(),
                slopes: vec![slope.times(factor)],
            };
            pairs.map(with).collect()
        };
        let frequency = Dual {
            value: last(),
            slopes: Vec::new(),
        };
        let misses = self.misses(&along(Interval::ONE), &along(multiplier), &frequency);
        let slopes: Vec<T> = misses.iter().map(|it| it.slope(0)).collect();
        let mut values: Vec<T> = misses.into_iter().map(|it| it.value).collect();
        values.extend(slopes);
        values.push(tangents[pinned].clone() - T::from(Interval::ONE));
        values
    }

    /// By how much each arc misses the event at its end, and each event its guard. The last arc has to meet the first event of
    /// `closing`, a period later.
    fn misses<T: Number>(&self, unknowns: &[T], closing: &[T], frequency: &T) -> Vec<T> {
        let count = self.events.len();
        let mut misses = Vec::with_capacity(UNKNOWNS * count + 1);
        for arc in 0..count {
            let start = self.after(arc, unknowns);
            let end = self.before(arc + 1, if arc + 1 == count { closing } else { unknowns });
            let elapsed = (end.angle.clone() - start.angle.clone()) * frequency.reciprocal();
            let (x, v) = self.flow(self.law(arc), frequency, &start, (&end.angle, &elapsed));
            misses.extend([x - end.position, v - end.velocity]);
            let here = self.before(arc, unknowns);
            match self.events[arc].event {
                Kind::Section => misses.push(here.angle),
                Kind::Crossing => {
                    misses.push(self.guard(arc).value(&here.position, &here.velocity))
                }
                Kind::Touch => {
                    misses.push(self.guard(arc).value(&here.position, &here.velocity));
                    misses.push(here.velocity);
                }
            }
        }
        misses
    }
}

/// The forced motion that repeats with the drive: `force`/`stiffness` + p cos(angle) + q sin(angle).
struct Steady<T> {
    rest: Interval,
    cosine: T,
    sine: T,
    frequency: T,
}

impl<T: Number> Steady<T> {
    fn new(machine: &Machine, law: &Law, frequency: &T) -> Self {
        let square = frequency.clone() * frequency.clone();
        let elastic = T::constant(law.stiffness) - square.times(machine.mass);
        let damping = frequency.times(law.damping);
        let sum = elastic.clone() * elastic.clone() + damping.clone() * damping.clone();
        let scale = sum.reciprocal().times(machine.amplitude);
        let rest = match law.force {
            0.0 => Interval::ZERO,
            force => Interval::point(force) / Interval::point(law.stiffness),
        };
        Self {
            rest,
            cosine: elastic * scale.clone(),
            sine: damping * scale,
            frequency: frequency.clone(),
        }
    }

    fn at(&self, angle: &T) -> (T, T) {
        let (sine, cosine) = angle.sin_cos();
        let position = self.cosine.clone() * cosine.clone() + self.sine.clone() * sine.clone();
        let velocity = self.sine.clone() * cosine - self.cosine.clone() * sine;
        (
            T::from(self.rest) + position,
            velocity * self.frequency.clone(),
        )
    }
}
