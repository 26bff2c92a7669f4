//! A chaotic attractor: its exponents, impacts and lifetime.

use crate::ensemble::Ensemble;
use crate::extremes::extremes;
use crate::orbit::{Exponents, OrbitError, StroboscopicMap};
use softstop::{CheckedScene, Crossing, Observer, Start};

/// A chaotic motion, one that never repeats as far as it was watched.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Chaos {
    /// A state of it at drive angle phi.
    pub state: Start,
    /// Its Lyapunov exponents.
    pub exponents: Exponents,
    /// Mean number of drive periods before it ends, if it is transient.
    pub lifetime: Option<f64>,
    /// Starts of the region that came to it; those that it has let go count where they ended.
    pub entered: usize,
    /// Mean number of impacts per drive period.
    pub impacts_per_period: f64,
    /// Least and largest before-impact velocity in m/s seen; none without impacts.
    pub velocities: Option<[f64; 2]>,
    /// Drive periods for which motions on it were watched, all together. Without an escape, its mean
    /// lifetime exceeds a third of this with 95 % confidence.
    pub watched: u64,
}

/// Records the before-impact velocities in m/s of a motion.
#[derive(Default)]
struct ImpactVelocities(Vec<f64>);

impl Observer for ImpactVelocities {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0.extend(crossing.impact_velocity());
    }
}

/// Most drive periods over which the impacts of chaos are counted.
const MAX_COUNTED_PERIODS: u64 = 4096;

impl Chaos {
    /// The chaos that a motion from a state is, which still wanders at the end of its exponents.
    pub(super) fn of_motion(
        scene: &CheckedScene,
        ensemble: &Ensemble<'_>,
        (begin, state): (Start, Start),
        exponents: Exponents,
    ) -> Result<Self, OrbitError> {
        let counted = MAX_COUNTED_PERIODS.min(exponents.periods);
        let map = StroboscopicMap::new(scene, counted);
        let mut impacts = ImpactVelocities::default();
        map.image_with_observer(begin.into(), &mut impacts)?;
        let ImpactVelocities(velocities) = impacts;
        ensemble.count_work(counted)?;
        Ok(Self {
            state,
            exponents,
            lifetime: None,
            entered: 0,
            impacts_per_period: velocities.len() as f64 / counted as f64,
            velocities: extremes(velocities),
            watched: 0,
        })
    }
}
