//! The guards that end a phase, as linear functions of position and velocity.

use super::cycle_state::GuardCrossing;
use super::lane_laws::PhaseConstants;
use softstop::internals::Guard;

impl PhaseConstants {
    /// The guard of the phase that a crossing is of, told by its position.
    pub fn crossed_guard(&self, crossing: &GuardCrossing) -> Guard {
        let [high, low, further] = self.guards();
        match crossing.position {
            x if x == high.level => high,
            x if x == -low.level => low,
            _ => further,
        }
    }

    /// The guards that end the phase: the upper position, the lower one, and the further guard (friction, release of contact);
    /// with the level at infinity where there is none.
    pub fn guards(&self) -> [Guard; 3] {
        let further = Guard {
            position: self.by_position,
            velocity: self.by_velocity,
            forcing: 0.0,
            level: self.level,
        };
        [
            Guard::rising_to(self.high),
            Guard::falling_to(self.low),
            further,
        ]
    }
}
