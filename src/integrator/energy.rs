//! The energy that a motion stores.

use super::{Motion, Start};
use crate::scene::Scene;

/// Mechanical energy in J: kinetic, suspension and what the stop stores.
pub fn mechanical_energy(scene: &Scene, motion: &Motion) -> f64 {
    let Start { position, velocity } = motion.state();
    let kinetic = 0.5 * scene.mass * velocity * velocity;
    let spring = 0.5 * scene.stiffness * position * position;
    kinetic + spring + motion.store().energy_at(position)
}
