//! The exact method, as one among others.

use super::{Integrator, MethodError, Solution, Task, Work};
use softstop::{Arc, Clock, Crossing, Impact, Observer};

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
            taken: Work::default(),
        };
        motion
            .advance(task.end(), &mut watcher)
            .map_err(|error| MethodError::from(error).after(watcher.taken.steps))?;
        motion.tell_arc(&mut watcher.taken);
        let state = motion.state();
        Ok(Solution {
            end: (state.position, state.velocity),
            impacts: watcher.impacts,
            work: watcher.taken,
        })
    }
}

struct Watcher {
    clock: Clock,
    impacts: Vec<Impact>,
    taken: Work,
}

impl Observer for Watcher {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.taken.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(velocity) = crossing.impact_velocity() {
            let time = self.clock.time(crossing.instant);
            self.impacts.push(Impact { time, velocity });
        }
    }
}
