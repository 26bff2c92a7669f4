//! The faces that end a phase, as linear functions of position and velocity.

use super::cycle_state::FaceCrossing;
use super::law::PhaseConstants;

/// A face that ends a phase: `position` x + `velocity` v = `level`; inside the phase the left side is smaller.
#[derive(Debug, Clone, Copy)]
pub(super) struct PhaseFace {
    pub position: f64,
    pub velocity: f64,
    pub level: f64,
}

impl PhaseConstants {
    /// The face of the phase that a crossing is made at, told by its position.
    pub fn crossed_face(&self, passage: &FaceCrossing) -> PhaseFace {
        let [high, low, further] = self.faces();
        match passage.position {
            x if x == high.level => high,
            x if x == -low.level => low,
            _ => further,
        }
    }

    /// The faces that end the phase: the upper position, the lower one, and the further guard (friction, release of contact);
    /// with the level at infinity where there is none.
    pub fn faces(&self) -> [PhaseFace; 3] {
        let face = |position, velocity, level| PhaseFace {
            position,
            velocity,
            level,
        };
        [
            face(1.0, 0.0, self.high),
            face(-1.0, 0.0, -self.low),
            face(self.by_position, self.by_velocity, self.level),
        ]
    }
}
