//! Where an orbit comes near to grazing.

use std::sync::Arc as Shared;

use nalgebra::Vector2;

use super::face::{Face, Touch};
use super::period_map::carry_on;
use crate::orbit::turn::turns;
use softstop::internals::{Motion, Phases};
use softstop::{Arc, Clock, Crossing, CrossingKind, MotionError, Observer, Scene};

/// An orbit seen from close by.
pub(crate) struct CloseApproaches {
    /// The turning point that comes nearest to the surface ahead of it, if any turns before one.
    pub turn: Option<Touch>,
    /// Times in s, positions and kinds of all crossings, in order.
    crossings: Vec<(f64, f64, CrossingKind)>,
}

impl CloseApproaches {
    /// How many crossings go with one, at a time, if it dies: a rebound with the rest right after it, all up to the way
    /// back through a surface otherwise.
    pub fn taken(&self, time: f64) -> usize {
        let at = |one: &(f64, f64, CrossingKind)| one.0 == time;
        let Some(index) = self.crossings.iter().position(at) else {
            return 0;
        };
        let (_, position, kind) = self.crossings[index];
        if matches!(kind, CrossingKind::Rebound { .. }) {
            let rests = |kind| matches!(kind, CrossingKind::Rest | CrossingKind::Release);
            let after = self.crossings[index + 1..].iter();
            return 1 + after.take_while(|one| rests(one.2)).count();
        }
        let same = |one: &(f64, f64, CrossingKind)| one.1 == position;
        let (before, after) = (&self.crossings[..index], &self.crossings[index + 1..]);
        let ways = [
            after.iter().position(same),
            before.iter().rev().position(same),
        ];
        ways.into_iter()
            .flatten()
            .min()
            .map_or(1, |between| between + 2)
    }
}

/// How an orbit comes near to surfaces.
pub(crate) fn close_approaches(
    (scene, phases): (&Scene, Shared<Phases>),
    periods: u64,
    state: Vector2<f64>,
) -> Result<CloseApproaches, MotionError> {
    let mut motion = Motion::new(phases, scene.clock(), Clock::at_cycle(0), state.into())?;
    let mut turns = Turns {
        clock: *motion.clock(),
        faces: Face::ALL
            .into_iter()
            .filter_map(|face| Some((face, face.position(scene)?)))
            .collect(),
        nearest: None,
        crossings: Vec::new(),
    };
    for period in 1..=periods {
        carry_on(&mut motion, Clock::at_cycle(period), &mut turns)?;
    }
    motion.tell_arc(&mut turns);
    Ok(CloseApproaches {
        turn: turns.nearest,
        crossings: turns.crossings,
    })
}

struct Turns {
    clock: Clock,
    faces: Vec<(Face, f64)>,
    nearest: Option<Touch>,
    crossings: Vec<(f64, f64, CrossingKind)>,
}

impl Observer for Turns {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let start = self.clock.time(arc.start);
        let back = arc.course.departure.velocity > 0.0;
        for turn in turns(arc.course, elapsed, back) {
            self.turn(turn.back, start + turn.elapsed, turn.position, false);
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        let time = self.clock.time(crossing.instant);
        self.crossings
            .push((time, crossing.position, crossing.kind));
        if crossing.kind == CrossingKind::Reversal {
            let back = crossing.acceleration_before < 0.0;
            self.turn(back, time, crossing.position, true);
        }
    }
}

impl Turns {
    fn turn(&mut self, back: bool, time: f64, position: f64, reverses: bool) {
        for &(face, level) in &self.faces {
            let amount = if back {
                level - position
            } else {
                position - level
            };
            let nearer = self
                .nearest
                .is_none_or(|known| amount < known.amount || (reverses && amount == known.amount));
            if amount > 0.0 && nearer {
                self.nearest = Some(Touch {
                    time,
                    amount,
                    face,
                    reverses,
                });
            }
        }
    }
}
