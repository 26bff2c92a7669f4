//! The exact method, as one among others.

use super::{Integrator, MethodError, Solution, Task, Work};
use crate::error::MotionError;
use crate::flow::DEGREE;
use crate::integrator::{Arc, Clock, Crossing, Impact, Instant, Motion, Observer};

/// Closed forms from crossing to crossing, Taylor steps where a law is not linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Exact;

impl Integrator for Exact {
    fn name(&self) -> String {
        "exact".to_owned()
    }

    fn integrate(&self, task: &Task) -> Result<Solution, MethodError> {
        let mut motion = task.scene.motion(task.start)?;
        let mut watcher = Watcher {
            clock: *motion.clock(),
            impacts: Vec::new(),
            work: Work::default(),
        };
        let end = end_of(task, motion.clock());
        motion
            .advance(end, &mut watcher)
            .map_err(|error| failure(error, &watcher))?;
        watcher.last_arc(&motion, end);
        let state = motion.state();
        Ok(Solution {
            end: (state.position, state.velocity),
            impacts: watcher.impacts,
            work: watcher.work,
        })
    }
}

/// Whole periods and the rest of them.
fn end_of(task: &Task, clock: &Clock) -> Instant {
    let cycles = task.periods.floor();
    let offset = (task.periods - cycles) * clock.period();
    Instant { cycles, offset }
}

fn failure(error: MotionError, watcher: &Watcher) -> MethodError {
    match error {
        MotionError::Unbounded { time, .. } => MethodError::BlownUp { time },
        MotionError::Stalled { time, .. } => MethodError::Stuck {
            time,
            steps: watcher.work.steps,
            reason: error.to_string(),
        },
        other => MethodError::Task(other),
    }
}

struct Watcher {
    clock: Clock,
    impacts: Vec<Impact>,
    work: Work,
}

impl Watcher {
    fn last_arc(&mut self, motion: &Motion, end: Instant) {
        let arc = motion.arc();
        let elapsed = self.clock.elapsed(arc.start, end);
        self.arc(&arc, elapsed);
    }
}

impl Observer for Watcher {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let windows = if arc.course.segment().is_some() {
            0
        } else {
            (elapsed / arc.course.flow.window).ceil() as u64
        };
        self.work.steps += windows.max(1);
        self.work.evaluations += windows + DEGREE as u64;
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(velocity) = crossing.impact_velocity() {
            let time = self.clock.time(crossing.instant);
            self.impacts.push(Impact { time, velocity });
        }
    }
}
