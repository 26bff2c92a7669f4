//! Where z = 1 begins and ends over the drive's frequency: the grazing of the motion without impacts
//! (g0, in closed form), the hysteresis zone from there to the fold s_SN, the flip s_PD (Peterka 2003,
//! section 3); and all ranges of stable z = 1, wherever they are. In the scene's own units, with any stop.

mod all_stable_ranges;
pub(crate) mod end_of_followed_branch;
mod error;
mod find_zones;
mod frequency_family;
mod hysteresis_zone;
mod impactless_motion;
mod loss_of_stability;
mod single_impact_zone;
mod stable_range;
mod stable_ranges_of_zone;
mod zone_end;

pub use all_stable_ranges::{stable_ranges, stable_ranges_with_monitor};
pub use error::{StableBranchEnd, StatedFrequency, ZoneError};
pub use find_zones::{find, find_among, find_with_monitor, find_zones};
pub use frequency_family::FrequencyFamily;
pub use hysteresis_zone::{
    hysteresis, hysteresis_and_stable_ranges, hysteresis_batch, hysteresis_with_monitor,
};
pub use impactless_motion::{free_amplitude, grazing_frequencies};
pub use loss_of_stability::{StabilityBounds, find_end_along, loss_of_stability};
pub use single_impact_zone::single_impact;
pub use stable_range::StableRange;
pub use zone_end::{Loss, ZoneEnd};

use crate::continuation::{BranchPoint, Continuation};
use crate::orbit::{Orbit, OrbitError};
use softstop::{CheckedScene, Scene};

/// The kind of a zone: a hysteresis zone, or all stable z = 1 motions on one branch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ZoneKind {
    /// Those that coexist with the motion without impacts: from g0 to the fold s_SN ([`hysteresis`](hysteresis())).
    #[default]
    Hysteresis,
    /// All stable ones on the branch of the hardest one between two frequencies in rad/s ([`single_impact`](single_impact())).
    SingleImpact {
        /// Lowest and highest frequency at which the motion is looked for.
        between: (f64, f64),
    },
}

/// A range of frequencies in which a machine has a stable z = 1 motion, and the branch of that motion.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Zone {
    /// Which motions it holds.
    pub kind: ZoneKind,
    /// Which of the ranges of the branch it holds, as [`Zone::on_range`] counts them; none if it holds the whole branch.
    pub range: Option<usize>,
    /// The machine; the frequency of its drive plays no part.
    pub scene: CheckedScene,
    /// Lower grazing frequency in rad/s, below resonance; none if the static deflection reaches the stop.
    pub frequency_g0_below: Option<f64>,
    /// Grazing frequency g0 in rad/s, above resonance: above it the motion without impacts does not reach the clearance. 0 if it
    /// never does, infinite without a clearance.
    pub frequency_g0: f64,
    /// The lower end, s = 0: of a hysteresis zone g0.
    pub low: ZoneEnd,
    /// The upper end, s = 1: of a hysteresis zone the fold s_SN.
    pub high: ZoneEnd,
    /// The branch from the lower end on, through all its folds, in order of arclength.
    pub branch: Vec<BranchPoint>,
}

impl Zone {
    /// True if the zone holds only motions that coexist with the motion without impacts.
    pub fn is_hysteresis(&self) -> bool {
        self.kind == ZoneKind::Hysteresis
    }

    /// True if the zone begins where the motion without impacts grazes: a hysteresis zone but for its upper ranges.
    pub fn begins_at_g0(&self) -> bool {
        self.is_hysteresis() && self.low.loss == Loss::FreeGrazing
    }

    /// The scene at a place s of the zone, with the drive's frequency there.
    pub fn scene_at(&self, share: f64) -> Scene {
        self.scene.at_frequency(self.frequency_at(share))
    }

    /// The drive frequency in rad/s at a place s of the zone: 0 at its lower end, 1 at its upper one.
    pub fn frequency_at(&self, share: f64) -> f64 {
        self.low.frequency + share * self.frequency_width()
    }

    /// The place s in the zone of a drive frequency in rad/s.
    pub fn place_of(&self, frequency: f64) -> f64 {
        (frequency - self.low.frequency) / self.frequency_width()
    }

    /// Width of the zone in rad/s, from end to end.
    pub fn frequency_width(&self) -> f64 {
        self.high.frequency - self.low.frequency
    }

    /// The z = 1 orbit at a place s of the zone: that of [`Zone::point_at`] with its impacts and times.
    ///
    /// # Errors
    /// [`ZoneError::Outside`] if s is not in [0, 1]; [`ZoneError::Orbit`] if the orbit is lost.
    pub fn orbit_at(&self, share: f64) -> Result<Orbit, ZoneError> {
        self.orbit_of(&self.point_at(share)?)
    }

    /// The orbit at a point of the zone's branch, computed with its impacts and times.
    ///
    /// # Errors
    /// [`ZoneError::Orbit`] if the orbit is lost.
    pub fn orbit_of(&self, point: &BranchPoint) -> Result<Orbit, ZoneError> {
        let family = FrequencyFamily(&self.scene);
        Ok(Continuation::new(&family, 1).orbit_at(point)?)
    }

    /// The z = 1 motion with the hardest impact at a place s of the zone, on the stable side of its folds.
    ///
    /// # Errors
    /// [`ZoneError::Outside`] if s is not in [0, 1]; [`ZoneError::Orbit`] if the orbit is lost.
    pub fn point_at(&self, share: f64) -> Result<BranchPoint, ZoneError> {
        if !(0.0..=1.0).contains(&share) {
            return Err(ZoneError::Outside { share });
        }
        let family = FrequencyFamily(&self.scene);
        let continuation = Continuation::new(&family, 1);
        let target = self.frequency_at(share);
        let mut best: Option<BranchPoint> = None;
        for pair in self.stable_sides().flat_map(|side| side.windows(2)) {
            let (from, to) = (&pair[0], &pair[1]);
            let point = match (from.parameter - target, to.parameter - target) {
                (0.0, _) => from.clone(),
                (_, 0.0) => to.clone(),
                (a, b) if a * b < 0.0 => continuation.point_between(from, to, target)?,
                _ => continue,
            };
            let stronger =
                |best: &BranchPoint| point.before_impact_velocity() > best.before_impact_velocity();
            if best.as_ref().is_none_or(stronger) {
                best = Some(point);
            }
        }
        let lost = OrbitError::NotFound {
            frequency: target,
            clearance: self.scene.clearance,
        };
        Ok(best.ok_or(lost)?)
    }
}

/// Refuses a scene with a stop below the mass: zones start from the grazing of the impact-less motion at one stop.
fn refuse_below(scene: &Scene) -> Result<(), ZoneError> {
    match scene.below {
        None => Ok(()),
        Some(_) => Err(ZoneError::StopBelow),
    }
}
