//! A machine made ready for the lanes.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::law::Constants;
use softstop::internals::{Beyond, PhaseId, Phases};
use softstop::{Clock, Scene, SceneError};

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
        let laws = phases.phases.iter();
        let laws = laws.map(|phase| Constants::of(&phases, phase));
        let drive = scene.excitation;
        let for_lanes = count <= MOST_PHASES && !may_hum(&phases, drive.amplitude);
        let (sin, cos) = drive.phase.sin_cos();
        Ok(Self {
            laws: if for_lanes { laws.collect() } else { None },
            clock: scene.clock(),
            phases: Arc::new(phases),
            frequency: drive.frequency,
            angle: (cos, sin),
        })
    }

    /// True if its motions can be followed in lanes: all its laws are linear, none is much stiffer than the
    /// drive is slow, and none can hold the mass at a face that throws it back for thousands of bounces.
    pub fn is_for_lanes(&self) -> bool {
        self.laws.is_some()
    }

    /// Its phases, shared.
    pub fn shared_phases(&self) -> Arc<Phases> {
        self.phases.clone()
    }

    /// True if a position lies clearly in the free phase, the first, and lanes can follow the machine.
    pub(super) fn is_free_at(&self, position: f64) -> bool {
        let free = self.laws.iter().flatten().next();
        free.is_some_and(|free| {
            free.low + free.grain < position && position < free.high - free.grain
        })
    }

    /// A drive period in s.
    pub(super) fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

/// Restitution above which bounces go on beyond counting.
const ELASTIC: f64 = 1.0 - 1.0 / 65_536.0;

/// True if the drive can press the mass onto a surface that throws it back with hardly any loss: a jump of the force
/// that is larger than the press, or a wall that is nearly elastic. Bounces there form rows without end, whose
/// end the safe engine decides from the whole row.
fn may_hum(phases: &Phases, amplitude: f64) -> bool {
    let at_rest = |phase: PhaseId, position: f64| {
        let law = &phases[phase].law;
        law.force - law.stiffness * position
    };
    phases.surfaces.iter().any(|surface| {
        let pressed = at_rest(surface.below, surface.position) + amplitude > 0.0;
        let [fed, unfed] = [Some(surface.above), surface.above_unfed];
        let elastic = [fed, unfed].into_iter().flatten().any(|above| match above {
            Beyond::Phase(above) => {
                let (before, after) = (
                    at_rest(surface.below, surface.position),
                    at_rest(above, surface.position),
                );
                after - amplitude < 0.0 && after < before
            }
            Beyond::Wall { restitution } => restitution > ELASTIC,
        });
        pressed && elastic
    })
}
