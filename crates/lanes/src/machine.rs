//! A machine made ready for the lanes.

use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

use super::bounce_trains::BounceTrains;
use super::law::Constants;
use super::phase_graph::{MAX_PHASES, PhaseGraph};
use softstop::internals::Phases;
use softstop::{Clock, Scene, SceneError};

/// A machine, lowered once for any number of motions.
#[derive(Debug, Clone)]
pub struct Machine {
    scene: Scene,
    phases: OnceLock<Arc<Phases>>,
    pub(super) clock: Clock,
    pub(super) laws: Option<Vec<Constants>>,
    pub(super) outline: Option<PhaseGraph>,
    /// The drive: frequency in rad/s, cos and sin of its angle at time 0.
    pub(super) frequency: f64,
    pub(super) angle: (f64, f64),
}

impl Machine {
    /// Lowers a scene.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is invalid.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        scene.validate()?;
        let phases = scene.phases();
        let count = phases.phases.len();
        let drive = scene.excitation;
        let trains = BounceTrains {
            phases: &phases,
            drive,
        };
        let for_lanes = count <= MAX_PHASES && trains.ends_before_rest();
        let laws = if for_lanes { trains.lane_laws() } else { None };
        let kept = OnceLock::new();
        if laws.is_none() {
            let _ = kept.set(Arc::new(phases));
        }
        let (sin, cos) = drive.phase.sin_cos();
        Ok(Self {
            outline: laws.as_deref().map(PhaseGraph::from_laws),
            laws,
            clock: scene.clock(),
            scene: scene.clone(),
            phases: kept,
            frequency: drive.frequency,
            angle: (cos, sin),
        })
    }

    /// True if its motions can be followed in lanes: all its laws are linear but for a power law at the end,
    /// none is much stiffer than the drive is slow, and none can hold the mass at a face that throws it back for rows of bounces without end.
    pub fn is_for_lanes(&self) -> bool {
        self.laws.is_some()
    }

    /// True if drive periods of settled motions are skipped: with power laws that is not proven.
    pub fn skips_periods(&self) -> bool {
        let laws = self.laws.as_ref();
        laws.is_some_and(|laws| !laws.iter().any(Constants::has_power_law))
    }

    /// The phases of the machine, shared; lowered anew when they are first asked for, as few motions in lanes do.
    pub fn shared_phases(&self) -> Arc<Phases> {
        let lowered = || Arc::new(self.scene.phases());
        self.phases.get_or_init(lowered).clone()
    }

    /// True if a position lies clearly in the free phase, the first, and lanes can follow the machine.
    pub(super) fn is_free_at(&self, position: f64) -> bool {
        let free = self.laws.iter().flatten().next();
        free.is_some_and(|free| {
            free.low + free.ambiguity < position && position < free.high - free.ambiguity
        })
    }

    /// A drive period in s.
    pub(super) fn drive_period(&self) -> f64 {
        TAU / self.frequency
    }
}
