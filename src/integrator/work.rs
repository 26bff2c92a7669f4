//! Work done along an arc: what the drive supplies and what is dissipated.

use serde::{Deserialize, Serialize};

use super::Arc;

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

/// Work from the start of an arc to `elapsed` seconds later, for a machine with mass `mass`.
pub fn work(arc: &Arc<'_>, mass: f64, elapsed: f64) -> Work {
    if let Some(chatter) = arc.course.chatter() {
        let (_, velocity) = chatter.at(elapsed);
        let lost = (chatter.speed - velocity) * (chatter.speed + velocity);
        return Work {
            supplied: 0.0,
            dissipated: 0.5 * mass * lost,
        };
    }
    let Some(phase) = arc.phase else {
        return Work::default();
    };
    let end = arc.node(elapsed);
    let power = arc.course.power(&end, phase.law.force / mass);
    let (low, high) = (arc.course.departure.position, end.position);
    let stored = phase.store.energy_at(high) - phase.store.energy_at(low);
    Work {
        supplied: mass * power.supplied,
        dissipated: mass * power.lost + phase.elastic_work(low, high) - stored,
    }
}
