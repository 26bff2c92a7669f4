//! Periodic orbits from their impacts, and the shortest period that repeats.

use softstop::CheckedScene;

use super::multi_segment_shooting::MultiSegmentShooting;
use super::{Orbit, OrbitError};
use crate::tolerance::ROUNDING;

impl Orbit {
    /// The periodic orbit, stable or not, that Newton's method from impact to impact reaches from times in s
    /// and before-impact velocities in m/s of all impacts near its own. It is regular down to grazing,
    /// where the map is not. No impact may come to rest.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle, or on impacts between which there are others.
    pub fn find_by_impacts(
        scene: &CheckedScene,
        periods: u64,
        impacts: &[(f64, f64)],
    ) -> Result<Self, OrbitError> {
        let none = OrbitError::OtherRegime { impacts: 0 };
        if impacts.is_empty() {
            return Err(none);
        }
        let shooting = MultiSegmentShooting::new(scene, periods.max(1)).ok_or(none)?;
        let orbit = shooting.solve(impacts)?;
        let all = orbit.timed_impacts();
        for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
            let share = all.len() as u64 * part;
            if share.is_multiple_of(periods) && orbit.repeats_after(&all, part) {
                let first = &all[..(share / periods) as usize];
                return Self::find_by_impacts(scene, part, first);
            }
        }
        Ok(orbit)
    }

    /// True if the impacts of an orbit are the same after `part` of its drive periods.
    fn repeats_after(&self, impacts: &[(f64, f64)], part: u64) -> bool {
        let period = self.scene.clock().period();
        let shift = impacts.len() * part as usize / self.periods as usize;
        let span = period * part as f64;
        let speed = self.scene.scales().speed();
        let pairs = impacts.iter().zip(&impacts[shift..]);
        let mut pairs = pairs.map(|(a, b)| ((b.0 - a.0 - span) / period, (b.1 - a.1) / speed));
        let most = ROUNDING * (1.0 + self.velocity.abs() / speed);
        pairs.all(|(time, velocity)| time.hypot(velocity) <= most)
    }
}
