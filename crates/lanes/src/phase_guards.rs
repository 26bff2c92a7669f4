//! The guards that end a phase, as linear functions of position and velocity.

use super::cycle_state::GuardCrossing;
use super::lane_laws::PhaseConstants;

/// A guard that ends a phase where `position` x + `velocity` v = `level`; inside the phase the left side is smaller.
#[derive(Debug, Clone, Copy)]
pub(super) struct PhaseGuard {
    pub position: f64,
    pub velocity: f64,
    pub level: f64,
}

impl PhaseConstants {
    /// The guard of the phase that a crossing is of, told by its position.
    pub fn crossed_guard(&self, crossing: &GuardCrossing) -> PhaseGuard {
        let [high, low, further] = self.guards();
        match crossing.position {
            x if x == high.level => high,
            x if x == -low.level => low,
            _ => further,
        }
    }

    /// The guards that end the phase: the upper position, the lower one, and the further guard (friction, release of contact);
    /// with the level at infinity where there is none.
    pub fn guards(&self) -> [PhaseGuard; 3] {
        let guard = |position, velocity, level| PhaseGuard {
            position,
            velocity,
            level,
        };
        [
            guard(1.0, 0.0, self.high),
            guard(-1.0, 0.0, -self.low),
            guard(self.by_position, self.by_velocity, self.level),
        ]
    }
}
