//! Trajectories over some drive periods, kept up to a bound on their arcs.

use std::ops::ControlFlow;

use nalgebra::Vector2;

use crate::monitor::stop_if;
use softstop::internals::Motion;
use softstop::{Arc, CheckedScene, MotionError, Observer, Trajectory};

/// Most arcs that a recorded trajectory may have: some 150 MB, and up to three times that of Taylor steps.
const MAX_KEPT_ARCS: usize = 1 << 18;

/// An observer that stops a motion with more arcs than a recorded trajectory may have.
#[derive(Default)]
struct ArcLimit(usize);

impl ArcLimit {
    fn is_exceeded(&self) -> bool {
        self.0 > MAX_KEPT_ARCS
    }
}

impl Observer for ArcLimit {
    fn arc(&mut self, _: &Arc<'_>, _: f64) {
        self.0 += 1;
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        stop_if(self.is_exceeded())
    }
}

/// Records the trajectory of a scene's motion from a state at time 0, as far as `advance` moves it.
///
/// # Errors
/// [`MotionError`] if the state is not finite or beyond a rigid stop, and that of advancing; [`MotionError::Endless`] if it has
/// more arcs than are kept.
pub fn record_trajectory(
    scene: &CheckedScene,
    state: Vector2<f64>,
    advance: impl FnOnce(&mut Motion, &mut dyn Observer) -> Result<(), MotionError>,
) -> Result<Trajectory, MotionError> {
    let mut motion = scene.motion(state.into())?;
    let mut kept = Trajectory::empty(scene);
    let mut limit = ArcLimit::default();
    advance(&mut motion, &mut (&mut kept, &mut limit))?;
    if limit.is_exceeded() {
        return Err(MotionError::Endless {
            time: kept.clock.time(motion.now()),
            position: motion.state().position,
        });
    }
    motion.tell_arc(&mut kept);
    kept.end = motion.state();
    Ok(kept)
}
