//! Counts the impacts of a motion as it goes on.

use softstop::{Crossing, Observer};

/// An observer that counts the impacts of a motion.
#[derive(Default)]
pub struct ImpactCounter(pub u64);

impl Observer for ImpactCounter {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0 += u64::from(crossing.impact_velocity().is_some());
    }
}
