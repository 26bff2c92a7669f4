//! A machine made ready for the lanes.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::law::Constants;
use crate::error::SceneError;
use crate::integrator::Clock;
use crate::phases::Phases;
use crate::scene::Scene;

/// A machine, lowered once for any number of motions.
#[derive(Debug, Clone)]
pub struct Machine {
    pub(super) phases: Arc<Phases>,
    pub(super) clock: Clock,
    pub(super) laws: Option<Vec<Constants>>,
    /// The drive: frequency in rad/s, cos and sin of its angle at time 0.
    pub(super) frequency: f64,
    pub(super) angle: (f64, f64),
}

/// Most phases that lanes choose between.
const MOST_PHASES: usize = 16;

impl Machine {
    /// Lowers a scene.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is invalid.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        let phases = scene.phases();
        let count = phases.phases.len();
        let laws = (0..count)
            .map(|index| Constants::of(&phases, index))
            .collect();
        let drive = scene.excitation;
        let (sin, cos) = drive.phase.sin_cos();
        Ok(Self {
            laws: if count <= MOST_PHASES { laws } else { None },
            clock: Clock::new(drive.frequency, drive.phase),
            phases: Arc::new(phases),
            frequency: drive.frequency,
            angle: (cos, sin),
        })
    }

    /// True if its motions can be followed in lanes: all its laws are linear, and none is much stiffer
    /// than the drive is slow.
    pub fn is_for_lanes(&self) -> bool {
        self.laws.is_some()
    }

    /// Its phases, shared.
    pub(crate) fn shared_phases(&self) -> Arc<Phases> {
        self.phases.clone()
    }

    /// True if each phase is ended by one position alone.
    pub(super) fn is_plain(&self) -> bool {
        self.laws.iter().flatten().all(Constants::is_plain)
    }

    /// A drive period in s.
    pub(super) fn period(&self) -> f64 {
        TAU / self.frequency
    }
}
