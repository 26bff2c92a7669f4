//! The energy that a motion stores.

use super::{Motion, Start};
use crate::phases::Store;
use crate::scene::Scene;

/// Mechanical energy in J of a state: kinetic, suspension and what the stop's store holds, if there is one.
pub fn mechanical_energy(scene: &Scene, state: Start, store: Option<&Store>) -> f64 {
    let Start { position, velocity } = state;
    let kinetic = 0.5 * scene.mass * velocity * velocity;
    let spring = 0.5 * scene.stiffness * position * position;
    kinetic + spring + store.map_or(0.0, |store| store.energy_at(position))
}

impl Motion {
    /// Mechanical energy in J now, of a motion of this scene.
    pub fn mechanical_energy(&self, scene: &Scene) -> f64 {
        mechanical_energy(scene, self.state(), Some(self.store()))
    }
}
