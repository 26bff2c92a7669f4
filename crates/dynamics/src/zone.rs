//! The hysteresis zone above resonance: from grazing of the impact-less motion (g0) to the fold of
//! the z = 1 motion (s_SN), Peterka 2003, section 3.

use thiserror::Error;

use crate::continuation::{BranchPoint, Family, Follower, Heading};
use crate::orbit::{Orbit, OrbitError, find};
use softstop::error::{MotionError, SceneError};
use softstop::scene::{Ratios, Scene};

/// Why a machine has no hysteresis zone.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ZoneError {
    /// The impact-less motion never reaches the stop.
    #[error(
        "clearance = {clearance}: must be > 0 and below {largest}, the largest amplitude of the \
         impact-less motion, for a grazing boundary to exist"
    )]
    NoGrazing {
        /// The clearance rho.
        clearance: f64,
        /// The amplitude at resonance.
        largest: f64,
    },
    /// There is no stable z = 1 motion where the zone would begin.
    #[error("no hysteresis: no stable z = 1 motion at the grazing boundary eta = {frequency}")]
    NoOrbit {
        /// Frequency ratio of the grazing boundary.
        frequency: f64,
    },
    /// The z = 1 branch loses its stability otherwise than by a fold.
    #[error(
        "the z = 1 branch loses its stability by a flip near eta = {frequency}, before any fold"
    )]
    Flip {
        /// Frequency ratio at which it is first seen unstable.
        frequency: f64,
    },
    /// The z = 1 branch goes on without a fold.
    #[error("the z = 1 branch was followed to eta = {frequency} without meeting a fold")]
    NoFold {
        /// Frequency ratio up to which it was followed.
        frequency: f64,
    },
    /// A place outside the zone was asked for.
    #[error("s = {share}: must lie in [0, 1], from g0 to s_SN")]
    Outside {
        /// The share that was asked for.
        share: f64,
    },
    /// The branch could not be computed.
    #[error(transparent)]
    Orbit(#[from] OrbitError),
}

impl From<SceneError> for ZoneError {
    fn from(error: SceneError) -> Self {
        Self::Orbit(error.into())
    }
}

/// The hysteresis zone of one machine, with its branch of z = 1 motions.
#[derive(Debug, Clone)]
pub struct Zone {
    /// The machine; its frequency plays no part.
    pub ratios: Ratios,
    /// Lower grazing frequency ratio, below resonance; none if the static deflection reaches the
    /// stop.
    pub frequency_g0_below: Option<f64>,
    /// Grazing frequency ratio g0 above resonance: s = 0.
    pub frequency_g0: f64,
    /// Frequency ratio of the fold s_SN: s = 1.
    pub frequency_sn: f64,
    /// Before-impact velocity at the fold.
    pub velocity_sn: f64,
    /// The branch from g0 on, through all its folds, in order of arclength.
    pub branch: Vec<BranchPoint>,
}

/// Points after which a branch without a fold is given up.
const LONGEST_BRANCH: usize = 2000;
/// Before-impact velocity, in units of that at g0, below which an unstable branch is left: it ends
/// in grazing.
const WEAKEST: f64 = 0.2;
/// 1 - tr + det below which an unstable branch is left: its multiplier grows without bound only where
/// it ends in grazing.
const STEEPEST: f64 = -4.0;
/// Largest 1 - tr + det that a located fold may show.
const AT_FOLD: f64 = 1e-7;
/// Frequency ratio, in units of g0, beyond which no fold is looked for.
const FARTHEST: f64 = 8.0;

/// Frequency ratios at which the impact-less motion grazes the stop: (below resonance, above).
///
/// Its amplitude 1 / sqrt((1 - eta^2)^2 + (2 beta1 eta)^2) equals rho where
/// eta^2 = 1 - 2 beta1^2 +- sqrt(1/rho^2 - 4 beta1^2 (1 - beta1^2)).
///
/// # Errors
/// [`ZoneError::NoGrazing`] if the amplitude never equals the clearance.
pub fn grazing_frequencies(ratios: &Ratios) -> Result<(Option<f64>, f64), ZoneError> {
    let square = ratios.damping * ratios.damping;
    let rho = ratios.clearance;
    let centre = 1.0 - 2.0 * square;
    let least = 4.0 * square * (1.0 - square);
    let discriminant = 1.0 / (rho * rho) - least;
    let largest = if centre > 0.0 {
        1.0 / least.sqrt()
    } else {
        1.0
    };
    let above = centre + discriminant.sqrt();
    if !(rho > 0.0 && discriminant >= 0.0 && above > 0.0) {
        return Err(ZoneError::NoGrazing {
            clearance: rho,
            largest,
        });
    }
    // The product of the roots is 1 - 1/rho^2: no cancellation for the smaller one.
    let below = (1.0 - 1.0 / rho) * (1.0 + 1.0 / rho) / above;
    Ok(((below > 0.0).then(|| below.sqrt()), above.sqrt()))
}

/// The hysteresis zone of a machine; `ratios.frequency` plays no part.
///
/// # Errors
/// [`ZoneError`] if there is no grazing boundary, no z = 1 motion at it, or no fold.
pub fn hysteresis(ratios: &Ratios) -> Result<Zone, ZoneError> {
    ratios.scene()?;
    let (frequency_g0_below, frequency_g0) = grazing_frequencies(ratios)?;
    let family = Frequencies(*ratios);
    let start = find(&family.scene([frequency_g0]).map_err(OrbitError::from)?).map_err(|_| {
        ZoneError::NoOrbit {
            frequency: frequency_g0,
        }
    })?;
    let follower = Follower::new(&family, 1);
    let mut branch =
        follower.follow(&start, frequency_g0, Heading::Up, LONGEST_BRANCH, |point| {
            let flipped = !point.is_stable() && point.fold_test() > 0.0;
            let weak = point.before_impact_velocity() < WEAKEST * start.before_impact_velocity();
            let outside =
                point.parameter < frequency_g0 || point.parameter > FARTHEST * frequency_g0;
            let ends_in_grazing = point.fold_test() < STEEPEST || (weak && point.fold_test() < 0.0);
            flipped || outside || ends_in_grazing
        })?;
    insert_folds(&follower, &mut branch)?;
    let fold = branch
        .iter()
        .filter(|point| point.fold_test().abs() < AT_FOLD)
        .max_by(|a, b| a.parameter.total_cmp(&b.parameter))
        .ok_or_else(|| no_fold(&branch))?;
    Ok(Zone {
        ratios: *ratios,
        frequency_g0_below,
        frequency_g0,
        frequency_sn: fold.parameter,
        velocity_sn: fold.before_impact_velocity(),
        branch,
    })
}

/// Adds the folds to a branch, between the neighbours where 1 - tr + det changes its sign.
fn insert_folds(
    follower: &Follower<'_, Frequencies>,
    branch: &mut Vec<BranchPoint>,
) -> Result<(), ZoneError> {
    let mut index = 1;
    while index < branch.len() {
        let (from, to) = (&branch[index - 1], &branch[index]);
        if from.fold_test() * to.fold_test() < 0.0 {
            let fold = follower.locate(from, to, BranchPoint::fold_test)?;
            branch.insert(index, fold);
            index += 1;
        }
        index += 1;
    }
    Ok(())
}

fn no_fold(branch: &[BranchPoint]) -> ZoneError {
    let frequency = branch.last().map_or(f64::NAN, |point| point.parameter);
    if branch.iter().all(BranchPoint::is_stable) {
        ZoneError::NoFold { frequency }
    } else {
        ZoneError::Flip { frequency }
    }
}

impl Zone {
    /// eta = g0 + s (eta_SN - g0).
    pub fn frequency_at(&self, share: f64) -> f64 {
        self.frequency_g0 + share * (self.frequency_sn - self.frequency_g0)
    }

    /// The z = 1 orbit of the highest before-impact velocity at a place s of the zone, on the stable
    /// side of the folds; s = 1 is the last fold itself.
    ///
    /// # Errors
    /// [`ZoneError::Outside`] if s is not in [0, 1]; [`ZoneError::Orbit`] if the orbit is lost.
    pub fn orbit_at(&self, share: f64) -> Result<Orbit, ZoneError> {
        if !(0.0..=1.0).contains(&share) {
            return Err(ZoneError::Outside { share });
        }
        let family = Frequencies(self.ratios);
        let follower = Follower::new(&family, 1);
        let target = self.frequency_at(share);
        let mut best: Option<BranchPoint> = None;
        for pair in self.branch.windows(2) {
            let (from, to) = (&pair[0], &pair[1]);
            if from.fold_test() < -AT_FOLD || to.fold_test() < -AT_FOLD {
                continue;
            }
            let point = match (from.parameter - target, to.parameter - target) {
                (0.0, _) => from.clone(),
                (_, 0.0) => to.clone(),
                (a, b) if a * b < 0.0 => {
                    follower.locate(from, to, |point| point.parameter - target)?
                }
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
            clearance: self.ratios.clearance,
        };
        Ok(follower.orbit(&best.ok_or(lost)?)?)
    }
}

/// One machine at all frequencies.
struct Frequencies(Ratios);

impl Family for Frequencies {
    fn scene(&self, [frequency]: [f64; 1]) -> Result<Scene, MotionError> {
        Ok(Ratios {
            frequency,
            ..self.0
        }
        .scene()?)
    }

    fn state_scales(&self) -> [f64; 2] {
        [self.0.clearance.abs().max(1.0); 2]
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [0.2]
    }
}
