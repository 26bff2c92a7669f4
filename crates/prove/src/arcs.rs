//! What is proven of the arcs of an enclosed motion: each ends as its sequence says, and no other guard rises through zero
//! before; and what a small change of the motion becomes over a period.

use crate::ProofError;
use crate::interval::Interval;
use crate::machine::{Guard, Law};
use crate::motion::{Event, Kind, Motion, State, UNKNOWNS};
use crate::number::Number;

/// Halvings of an arc at most.
const DEEPEST: u32 = 40;

/// A motion with boxes for its unknowns and its frequency.
pub struct Enclosed<'a> {
    /// The motion.
    pub motion: &'a Motion,
    /// The unknowns of its events.
    pub unknowns: &'a [Interval],
    /// The drive's frequency.
    pub frequency: Interval,
}

/// Position, velocity, acceleration and its derivative.
struct Jet {
    position: Interval,
    velocity: Interval,
    acceleration: Interval,
    jerk: Interval,
}

/// One arc, from its start on.
struct Arc<'a> {
    enclosed: &'a Enclosed<'a>,
    law: &'a Law,
    start: State<Interval>,
}

impl Arc<'_> {
    /// The motion at any time of an interval after the start.
    fn at(&self, elapsed: Interval) -> Jet {
        let motion = self.enclosed.motion;
        let frequency = self.enclosed.frequency;
        let angle = self.start.angle + frequency * elapsed;
        let (position, velocity) =
            motion.flow(self.law, &frequency, &self.start, (&angle, &elapsed));
        self.jet(position, velocity, angle)
    }

    fn jet(&self, position: Interval, velocity: Interval, angle: Interval) -> Jet {
        let (machine, frequency) = (&self.enclosed.motion.machine, self.enclosed.frequency);
        let (sine, cosine) = angle.sin_cos();
        let acceleration = machine.acceleration(self.law, &position, &velocity, &cosine);
        let force = (frequency * sine).times(machine.amplitude)
            + acceleration.times(self.law.damping)
            + velocity.times(self.law.stiffness);
        Jet {
            position,
            velocity,
            acceleration,
            jerk: -force / Interval::point(machine.mass),
        }
    }

    /// The motion at any time of an interval after the start, by Taylor's formula about its middle: tighter than [`Arc::at`].
    fn over(&self, elapsed: Interval) -> Jet {
        let middle = Interval::point(elapsed.middle());
        let (rough, center) = (self.at(elapsed), self.at(middle));
        let away = elapsed - middle;
        let half_square = away.square() * Interval::point(0.5);
        let position = center.position + center.velocity * away + rough.acceleration * half_square;
        let velocity = center.velocity + center.acceleration * away + rough.jerk * half_square;
        let angle = self.start.angle + self.enclosed.frequency * elapsed;
        self.jet(position, velocity, angle)
    }
}

/// A guard of an arc with what is known of it: how many of its derivatives, itself among them, vanish at the start and at the
/// end.
struct Watched<'a> {
    guard: &'a Guard,
    start: usize,
    end: usize,
}

impl Watched<'_> {
    /// True if it stays below zero on a part of an arc; at the first and the last part it may be zero at the very end.
    fn stays_below(&self, jet: &Jet, is_first: bool, is_last: bool) -> bool {
        let [p, q] = [self.guard.position, self.guard.velocity].map(Interval::point);
        let slope = p * jet.velocity + q * jet.acceleration;
        let curvature = p * jet.acceleration + q * jet.jerk;
        let falls = match self.start {
            1 => slope.is_negative(),
            2 => curvature.is_negative(),
            _ => false,
        };
        let rises = match self.end {
            1 => slope.is_positive(),
            2 => curvature.is_negative(),
            _ => false,
        };
        let value = self.guard.value(&jet.position, &jet.velocity);
        value.is_negative() || (is_first && falls) || (is_last && rises)
    }
}

/// How many derivatives of its guard vanish at an event, the guard itself among them.
fn order(kind: Kind) -> usize {
    match kind {
        Kind::Crossing => 1,
        Kind::Touch => 2,
        Kind::Section => 0,
    }
}

impl Enclosed<'_> {
    fn arc(&self, index: usize) -> Arc<'_> {
        Arc {
            enclosed: self,
            law: self.motion.law(index),
            start: self.motion.after(index, self.unknowns),
        }
    }

    /// The event after an arc, with the state before it and how long the arc lasts.
    fn end(&self, arc: usize) -> (Event, State<Interval>, Interval) {
        let events = &self.motion.events;
        let end = self.motion.before(arc + 1, self.unknowns);
        let start = self.unknowns[UNKNOWNS * arc];
        let elapsed = (end.angle - start) / self.frequency;
        (events[(arc + 1) % events.len()], end, elapsed)
    }

    /// Divides each arc into parts on which it is proven that no guard rises through zero before the event at the end of the
    /// arc, and that this is passed with a slope: times since the start of the arc.
    ///
    /// # Errors
    /// [`ProofError`] naming the arc.
    pub fn divisions(&self) -> Result<Vec<Vec<f64>>, ProofError> {
        let arcs = 0..self.motion.events.len();
        arcs.map(|arc| self.division(arc)).collect()
    }

    fn watched(&self, index: usize) -> Vec<Watched<'_>> {
        let events = &self.motion.events;
        let begin = events[index];
        let (end, ..) = self.end(index);
        let begin_guard = (begin.event != Kind::Section).then(|| self.motion.guard(index));
        let guards = self.motion.machine.phases[begin.phase]
            .guards
            .iter()
            .enumerate();
        let watched = guards.map(|(number, guard)| Watched {
            guard,
            start: match begin_guard {
                // Without any restitution the mass starts at rest.
                Some(zero) if guard.is_zero_with(zero) && zero.factor == 0.0 => 2,
                Some(zero) if guard.is_zero_with(zero) => order(begin.event),
                _ => 0,
            },
            end: if number == end.guard {
                order(end.event)
            } else {
                0
            },
        });
        watched.collect()
    }

    /// True if the guard of an event stays zero as the velocity jumps, and has no slope where it is touched: a guard of the
    /// position alone.
    fn keeps_its_guard(&self, index: usize) -> bool {
        let guard = self.motion.guard(index);
        match self.motion.events[index].event {
            Kind::Crossing => guard.factor == 1.0 || guard.velocity == 0.0,
            Kind::Touch => guard.velocity == 0.0,
            Kind::Section => true,
        }
    }

    fn division(&self, index: usize) -> Result<Vec<f64>, ProofError> {
        let (end, _, elapsed) = self.end(index);
        let next = match end.event {
            Kind::Crossing => self.motion.guard(index + 1).to.contains(&end.phase),
            Kind::Touch | Kind::Section => end.phase == self.motion.events[index].phase,
        };
        if !next || !elapsed.is_positive() {
            return Err(ProofError::Sequence { arc: index });
        }
        if !self.keeps_its_guard(index) {
            return Err(ProofError::NotClear { arc: index });
        }
        let (arc, watched) = (self.arc(index), self.watched(index));
        let longest = elapsed.high();
        let mut breaks = vec![0.0];
        let mut ends = vec![(longest, 0)];
        while let Some((to, depth)) = ends.pop() {
            let from = breaks[breaks.len() - 1];
            let jet = arc.over(Interval::new(from, to));
            let (is_first, is_last) = (from == 0.0, to == longest);
            if watched
                .iter()
                .all(|it| it.stays_below(&jet, is_first, is_last))
            {
                breaks.push(to);
                continue;
            }
            let middle = 0.5 * (from + to);
            if depth == DEEPEST || middle <= from || middle >= to {
                return Err(ProofError::NotClear { arc: index });
            }
            ends.push((to, depth + 1));
            ends.push((middle, depth + 1));
        }
        Ok(breaks)
    }

    /// Trace and determinant of the monodromy matrix; touches left out.
    pub fn monodromy(&self) -> (Interval, Interval) {
        let start = [
            [Interval::ONE, Interval::ZERO],
            [Interval::ZERO, Interval::ONE],
        ];
        let arcs = 0..self.motion.events.len();
        let (matrix, determinant) =
            arcs.fold((start, Interval::ONE), |(matrix, determinant), arc| {
                let (flow, by_flow) = self.transition(arc);
                let (jump, by_jump) = self.saltation(arc);
                (
                    product(&jump, &product(&flow, &matrix)),
                    by_jump * by_flow * determinant,
                )
            });
        (matrix[0][0] + matrix[1][1], determinant)
    }

    /// The matrix of an arc, with its determinant.
    fn transition(&self, index: usize) -> (Matrix, Interval) {
        let (.., elapsed) = self.end(index);
        let decay = self.motion.machine.decay(self.motion.law(index));
        let (u, s) = elapsed.decay(&decay);
        let matrix = [
            [u + decay.rate * s, s],
            [-(decay.stiffness * s), u - decay.rate * s],
        ];
        (matrix, (-((decay.rate + decay.rate) * elapsed)).exp())
    }

    /// The matrix of the event after an arc, with its determinant: G + (f+ - G f-) grad g/(grad g . f-) with G = diag(1, factor)
    /// (Leine and Nijmeijer 2004, chapter 7).
    fn saltation(&self, arc: usize) -> (Matrix, Interval) {
        let (zero, one) = (Interval::ZERO, Interval::ONE);
        let (event, at, _) = self.end(arc);
        if event.event != Kind::Crossing {
            return ([[one, zero], [zero, one]], one);
        }
        let (motion, count) = (self.motion, self.motion.events.len());
        let guard = motion.guard(arc + 1);
        let (_, cosine) = at.angle.sin_cos();
        let acceleration = |law, velocity| {
            motion
                .machine
                .acceleration(law, &at.position, &velocity, &cosine)
        };
        let [p, q, factor] = [guard.position, guard.velocity, guard.factor].map(Interval::point);
        let after = at.velocity * factor;
        let before_acceleration = acceleration(motion.law(arc), at.velocity);
        let after_acceleration = acceleration(motion.law((arc + 1) % count), after);
        let rate = p * at.velocity + q * before_acceleration;
        let jumps = [
            (after - at.velocity) / rate,
            (after_acceleration - factor * before_acceleration) / rate,
        ];
        let row = |own: [Interval; 2], jump: Interval| [own[0] + jump * p, own[1] + jump * q];
        let matrix = [row([one, zero], jumps[0]), row([zero, factor], jumps[1])];
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        (matrix, determinant)
    }
}

type Matrix = [[Interval; 2]; 2];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |row: usize, column: usize| a[row][0] * b[0][column] + a[row][1] * b[1][column];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}
