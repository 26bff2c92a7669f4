//! The faces that end a phase, as linear functions of position and velocity.

use super::cycle_state::Passage;
use super::law::Constants;

/// A face of a phase, `position` x + `velocity` v = `level`; inside the phase the left side is smaller.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    pub position: f64,
    pub velocity: f64,
    pub level: f64,
}

impl Face {
    /// True if both are levels of the same function of position and velocity.
    pub fn has_gradient_of(&self, other: &Self) -> bool {
        (self.position, self.velocity) == (other.position, other.velocity)
    }
}

impl Constants {
    /// The face of the phase that a passage crosses, by its position.
    pub fn crossed_face(&self, passage: &Passage) -> Face {
        let [high, low, further] = self.faces();
        match passage.position {
            x if x == high.level => high,
            x if x == -low.level => low,
            _ => further,
        }
    }

    /// The faces that end the phase: the upper and the lower position, and the further guard (friction, release of
    /// contact); at infinity where there is none.
    pub fn faces(&self) -> [Face; 3] {
        let face = |position, velocity, level| Face {
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
