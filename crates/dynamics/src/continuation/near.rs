//! Where an orbit comes near to grazing.

use nalgebra::Vector2;

use super::face::{Face, Touch};
use super::round::carry_on;
use crate::orbit::turn::turns;
use softstop::{Arc, Clock, Crossing, CrossingKind, MotionError, Observer, Scene};

/// The turning point that comes nearest to the surface ahead of it, if any turns before one.
pub(crate) fn nearest_turn(
    scene: &Scene,
    periods: u64,
    state: Vector2<f64>,
) -> Result<Option<Touch>, MotionError> {
    let mut motion = scene.motion(state.into())?;
    let mut turns = Turns {
        clock: *motion.clock(),
        faces: Face::ALL
            .into_iter()
            .filter_map(|face| Some((face, face.position(scene)?)))
            .collect(),
        nearest: None,
    };
    for period in 1..=periods {
        carry_on(&mut motion, Clock::at_cycle(period), &mut turns)?;
    }
    motion.tell_arc(&mut turns);
    Ok(turns.nearest)
}

struct Turns {
    clock: Clock,
    faces: Vec<(Face, f64)>,
    nearest: Option<Touch>,
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
        if crossing.kind == CrossingKind::Reversal {
            let back = crossing.acceleration_before < 0.0;
            let time = self.clock.time(crossing.instant);
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
