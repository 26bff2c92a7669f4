//! Where z = 1 begins and ends over the drive's frequency: the grazing of the motion without impacts
//! (g0, in closed form), the hysteresis zone from there to the fold s_SN, the flip s_PD (Peterka 2003,
//! section 3). In the scene's own units, with any stop.

mod bounds;
mod grazing;
mod hysteresis;
mod loss;

pub use bounds::Bounds;
pub use grazing::{free_amplitude, grazing_frequencies};
pub use hysteresis::{Zone, hysteresis};
pub use loss::loss_of_stability;

use thiserror::Error;

use crate::continuation::Family;
use crate::orbit::OrbitError;
use softstop::internals::Scales;
use softstop::{MotionError, Scene, SceneError};

/// Why a machine has no hysteresis zone.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ZoneError {
    /// The impact-less motion never reaches the stop.
    #[error(
        "clearance = {clearance}: must be > 0 and below {largest}, the largest amplitude of the \
         impact-less motion, for a grazing boundary to exist"
    )]
    NoGrazing {
        /// The clearance in m.
        clearance: f64,
        /// The amplitude at resonance in m.
        largest: f64,
    },
    /// There is no stable z = 1 motion where the zone would begin.
    #[error(
        "no hysteresis: no stable z = 1 motion at the grazing boundary frequency = {frequency}"
    )]
    NoOrbit {
        /// Frequency of the grazing boundary in rad/s.
        frequency: f64,
    },
    /// The z = 1 branch loses its stability otherwise than by a fold.
    #[error(
        "the z = 1 branch loses its stability by a flip near frequency = {frequency}, before any fold"
    )]
    Flip {
        /// Frequency in rad/s at which it is first seen unstable.
        frequency: f64,
    },
    /// The z = 1 branch goes on without a fold.
    #[error("the z = 1 branch was followed to frequency = {frequency} without meeting a fold")]
    NoFold {
        /// Frequency in rad/s up to which it was followed.
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

/// A scene at another frequency of its drive.
fn at(scene: &Scene, frequency: f64) -> Scene {
    let mut scene = scene.clone();
    scene.excitation.frequency = frequency;
    scene
}

/// One scene at all frequencies.
struct Frequencies<'a>(&'a Scene);

impl Family for Frequencies<'_> {
    fn scene(&self, [frequency]: [f64; 1]) -> Result<Scene, MotionError> {
        let scene = at(self.0, frequency);
        scene.validate()?;
        Ok(scene)
    }

    fn state_scales(&self) -> [f64; 2] {
        let Scales { length, rate } = self.0.scales();
        let length = self.0.clearance.abs().max(length);
        [length, length * rate]
    }

    fn parameter_scales(&self) -> [f64; 1] {
        [0.2 * self.0.scales().rate]
    }
}
