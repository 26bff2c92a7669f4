//! Machines made ready for the lanes.

use super::bounce_trains::BounceTrains;
use super::lane_laws::PhaseConstants;
use softstop::CheckedScene;

/// Most phases of a machine that lanes follow.
const MAX_PHASES: usize = 16;

/// A machine whose phases are made ready for the lanes, once for any number of motions.
#[derive(Debug, Clone)]
pub struct LoweredMachine {
    scene: CheckedScene,
    pub(super) laws: Option<Vec<PhaseConstants>>,
    /// Cos and sin of the drive angle at time 0.
    pub(super) angle: (f64, f64),
}

impl LoweredMachine {
    /// Lowers a scene to the laws of its phases for the lanes, if they can follow them.
    pub fn new(scene: &CheckedScene) -> Self {
        let (phases, drive) = (scene.phases(), scene.excitation);
        let trains = BounceTrains { phases, drive };
        let for_lanes = phases.phases.len() <= MAX_PHASES && trains.ends_before_rest();
        let laws = if for_lanes { lane_laws(&trains) } else { None };
        let (sin, cos) = drive.phase.sin_cos();
        Self {
            laws,
            scene: scene.clone(),
            angle: (cos, sin),
        }
    }

    /// The scene of the machine.
    pub fn scene(&self) -> &CheckedScene {
        &self.scene
    }

    /// True if lanes can follow the machine's motions; else the safe engine does. All laws are linear but for a power law at the
    /// end, none is much stiffer than the drive is slow, and none can hold the mass at a surface that throws it back in trains of
    /// bounces without end.
    pub fn is_for_lanes(&self) -> bool {
        self.laws.is_some()
    }

    /// True if drive periods of settled motions are skipped; not with power laws, for which nothing is proven of returns.
    pub fn skips_periods(&self) -> bool {
        let laws = self.laws.as_ref();
        laws.is_some_and(|laws| !laws.iter().any(PhaseConstants::has_power_law))
    }

    /// True if lanes can follow the machine and a position lies clearly in its phase without contact.
    pub(super) fn is_free_at(&self, position: f64) -> bool {
        let free = self.laws.iter().flatten().next();
        free.is_some_and(|free| {
            free.low + free.ambiguity < position && position < free.high - free.ambiguity
        })
    }
}

/// The constants of all phases of the machine for the lanes; none if the lanes cannot follow one of them.
fn lane_laws(trains: &BounceTrains<'_>) -> Option<Vec<PhaseConstants>> {
    let mut laws = vec![PhaseConstants::default(); trains.phases.phases.len()];
    for (law, phase) in laws.iter_mut().zip(&trains.phases.phases) {
        law.set_to_phase(trains.phases, phase)?;
        law.slow = law.slow.max(trains.slowest_bounce(phase));
    }
    Some(laws)
}
