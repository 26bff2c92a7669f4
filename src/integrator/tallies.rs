//! What is counted and added up while a machine runs.

use serde::{Deserialize, Serialize};

use super::arc::Arc;
use super::clock::Instant;
use super::crossing::Crossing;
use super::observer::Observer;
use super::{Work, work};

/// An observer that counts and adds up.
pub(crate) struct Tallies<'a> {
    mass: f64,
    counts: &'a mut Counts,
}

/// Counts of impacts and pierced strips, and energies, since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Counts {
    pub impacts: u64,
    pub pierced: u64,
    /// Of the impacts, those on a stop below.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub below: u64,
    /// When the last impact was, and its before-impact velocity in m/s.
    pub last_impact: Option<(Instant, f64)>,
    pub work: Work,
}

impl Counts {
    /// An observer that counts on, of a machine with mass `mass`.
    pub fn observer(&mut self, mass: f64) -> Tallies<'_> {
        Tallies { mass, counts: self }
    }
}

fn is_zero(count: &u64) -> bool {
    *count == 0
}

impl Observer for Tallies<'_> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.counts.work += work(arc, self.mass, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.counts.work.dissipated += crossing.lost_energy(self.mass);
        self.counts.pierced += u64::from(crossing.pierces());
        if let Some(velocity) = crossing.impact_velocity() {
            self.counts.impacts += 1;
            self.counts.below += u64::from(crossing.velocity < 0.0);
            self.counts.last_impact = Some((crossing.instant, velocity));
        }
    }
}
