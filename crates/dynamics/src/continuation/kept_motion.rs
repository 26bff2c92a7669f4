//! A motion that is kept, and what follows from it without running it again.

use std::sync::Arc as Shared;

use nalgebra::Vector2;

use super::face::{Face, Touch};
use super::period_map::follow;
use crate::orbit::turn::turns;
use softstop::internals::{ArcSolution, Phases};
use softstop::{Arc, Clock, Crossing, CrossingKind, MotionError, Observer, Scene};

/// The arcs and crossings of a motion from time 0 on, in order of time.
#[derive(Debug, Clone)]
pub(crate) struct KeptMotion {
    clock: Clock,
    arcs: Vec<KeptArc>,
    crossings: Vec<KeptCrossing>,
    /// Whether the mass moves on the last arc.
    flies: bool,
}

#[derive(Debug, Clone)]
struct KeptArc {
    /// Time in s.
    start: f64,
    /// How long it lasts, in s.
    elapsed: f64,
    course: ArcSolution,
}

#[derive(Debug, Clone)]
struct KeptCrossing {
    /// Time in s.
    time: f64,
    crossing: Crossing,
    /// True if the mass moves before it.
    ends_flight: bool,
}

impl KeptMotion {
    /// The motion of a valid scene, with its phases, from a state over a number of drive periods. Few of the points
    /// that a continuation evaluates are asked for it, and keeping the arcs of them all costs more than a second run.
    pub fn of(
        machine: (&Scene, Shared<Phases>),
        periods: u64,
        state: Vector2<f64>,
    ) -> Result<Self, MotionError> {
        let mut motion = Self {
            clock: machine.0.clock(),
            arcs: Vec::new(),
            crossings: Vec::new(),
            flies: true,
        };
        follow(machine, periods, state, &mut motion)?;
        Ok(motion)
    }

    /// The turning point that comes nearest to a surface of the scene ahead of it, if any turns before one.
    pub fn nearest_turn(&self, scene: &Scene) -> Option<Touch> {
        let faces = Face::ALL.into_iter();
        let faces = faces.filter_map(|face| Some((face, face.position(scene)?)));
        let faces: Vec<(Face, f64)> = faces.collect();
        let on_arcs = self.arcs.iter().flat_map(|arc| {
            let back = arc.course.departure.velocity > 0.0;
            let turns = turns(&arc.course, arc.elapsed, back);
            turns.map(|turn| (turn.back, arc.start + turn.elapsed, turn.position, false))
        });
        let crossings = self.crossings.iter();
        let reversals = crossings.filter(|it| it.crossing.kind == CrossingKind::Reversal);
        let reversals = reversals.map(|KeptCrossing { time, crossing, .. }| {
            let back = crossing.acceleration_before < 0.0;
            (back, *time, crossing.position, true)
        });
        let touches = on_arcs
            .chain(reversals)
            .flat_map(|(back, time, position, reverses)| {
                faces.iter().map(move |&(face, level)| Touch {
                    time,
                    amount: if back {
                        level - position
                    } else {
                        position - level
                    },
                    face,
                    reverses,
                })
            });
        let ahead = touches.filter(|touch| touch.amount > 0.0);
        ahead.reduce(|known, touch| {
            let is_equal = touch.reverses && touch.amount == known.amount;
            match touch.amount < known.amount || is_equal {
                true => touch,
                false => known,
            }
        })
    }

    /// How many crossings go with one, at a time in s, if it dies: a rebound with the rest right after it, all up to the
    /// way back through a surface otherwise.
    pub fn taken(&self, time: f64) -> usize {
        let Some(index) = self.crossings.iter().position(|one| one.time == time) else {
            return 0;
        };
        let Crossing { kind, position, .. } = self.crossings[index].crossing;
        let (before, after) = (&self.crossings[..index], &self.crossings[index + 1..]);
        if matches!(kind, CrossingKind::Rebound { .. }) {
            let rests = |kind| matches!(kind, CrossingKind::Rest | CrossingKind::Release);
            let after = after.iter().take_while(|one| rests(one.crossing.kind));
            return 1 + after.count();
        }
        let same = |one: &KeptCrossing| one.crossing.position == position;
        let ways = [
            after.iter().position(same),
            before.iter().rev().position(same),
        ];
        let between = ways.into_iter().flatten().min();
        between.map_or(1, |between| between + 2)
    }

    /// Middle and length of the longest time in which the motion, which repeats after so many drive periods, crosses
    /// nothing and is not held, in drive periods.
    pub fn longest_flight(&self, periods: u64) -> (f64, f64) {
        let crossings = self.crossings.iter();
        let all = crossings.map(|it| (it.time / self.clock.period(), it.ends_flight));
        // The longest flight may lead over time 0.
        let again = all.clone().take(1);
        let again = again.map(|(time, ends_flight)| (time + periods as f64, ends_flight));
        let pairs = all.clone().zip(all.skip(1).chain(again));
        let flights = pairs.filter(|(_, (_, ends_flight))| *ends_flight);
        let flights = flights.map(|((from, _), (to, _))| (0.5 * (from + to), to - from));
        flights.fold((0.0, 0.0), |longest, flight| {
            if flight.1 > longest.1 {
                flight
            } else {
                longest
            }
        })
    }
}

impl Observer for KeptMotion {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.flies = !(arc.course.is_held() || arc.course.is_chattering());
        self.arcs.push(KeptArc {
            start: self.clock.time(arc.start),
            elapsed,
            course: arc.course.clone(),
        });
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.crossings.push(KeptCrossing {
            time: self.clock.time(crossing.instant),
            crossing: *crossing,
            ends_flight: self.flies,
        });
    }
}
