//! Work done along an arc, what the drive supplies and what is dissipated, and the energy that a motion stores.

use serde::{Deserialize, Serialize};

use super::{Arc, Motion, Start};
use crate::phases::StopEnergy;
use crate::scene::Scene;

/// Energies in J that crossed the machine's boundary.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Work {
    /// Work of the drive and the external force.
    pub supplied: f64,
    /// Work lost in dampers, in the strip and in friction.
    pub dissipated: f64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.supplied += other.supplied;
        self.dissipated += other.dissipated;
    }
}

/// Energies in J that crossed the machine's boundary along an arc, by what took them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WorkShares {
    /// Work of the drive and the external force.
    pub supplied: f64,
    /// Lost in the damper that holds on the arc.
    pub damper: f64,
    /// Lost in stop or strip by their own law: friction, hysteresis, what a deflected stop does not give back.
    pub law: f64,
    /// Lost by bounces that are summed.
    pub bounces: f64,
}

/// Work from the start of an arc to `elapsed` seconds later, for a machine with mass `mass`.
pub fn work(arc: &Arc<'_>, mass: f64, elapsed: f64) -> Work {
    let of = work_shares(arc, mass, elapsed);
    Work {
        supplied: of.supplied,
        dissipated: of.damper + of.law + of.bounces,
    }
}

/// Work from the start of an arc to `elapsed` seconds later, for a machine with mass `mass`, by what took it.
pub fn work_shares(arc: &Arc<'_>, mass: f64, elapsed: f64) -> WorkShares {
    if let Some(chatter) = arc.course.chatter() {
        let (_, velocity) = chatter.state_after(elapsed);
        let lost = (chatter.speed - velocity) * (chatter.speed + velocity);
        return WorkShares {
            bounces: 0.5 * mass * lost,
            ..WorkShares::default()
        };
    }
    let Some(phase) = arc.phase else {
        return WorkShares::default();
    };
    let end = arc.node_after(elapsed);
    let power = arc.course.work_integrals(&end, phase.law.force / mass);
    let (low, high) = (arc.course.departure.position, end.position);
    let stored = phase.store.energy_at(high) - phase.store.energy_at(low);
    WorkShares {
        supplied: mass * power.supplied,
        damper: mass * power.lost,
        law: mass * power.pressed + phase.elastic_work(low, high) - stored,
        bounces: 0.0,
    }
}

/// Mechanical energy in J of a state: kinetic, suspension and what the stop's store holds, if there is one.
pub fn mechanical_energy(scene: &Scene, state: Start, store: Option<&StopEnergy>) -> f64 {
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
