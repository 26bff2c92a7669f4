//! A motion from phase to phase, for methods that find the guards' crossings themselves.

use super::bounce_train::BounceTrain;
use super::reset::ResetContext;
use super::{Impact, Start};
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::events::{FoundCrossing, Guard};
use crate::flow::Polynomial;
use crate::phases::{Mode, Phase, PhaseId};

/// Most crossings within one instant: a method that makes more does not get on.
const MAX_CROSSINGS_AT_ONCE: u32 = 1000;

/// Where a motion is between its phases: which law holds, which guards end it, and what a crossing of one
/// leads to, by the same rules as those of the exact method.
///
/// Bounces on a rigid stop whose sum the exact method would take are rest at once: it would come within
/// 2^-26 of a drive period.
#[derive(Debug, Clone)]
pub struct PhaseTracker {
    scene: CheckedScene,
    mode: Mode,
    /// Guards that let go a mass that is held.
    releases: Vec<Guard>,
    time: f64,
    state: Start,
    bounce_train: BounceTrain,
    at_once: u32,
    impacts: Vec<Impact>,
}

impl PhaseTracker {
    /// A motion of this machine from this state at time 0.
    ///
    /// # Errors
    /// [`MotionError`] if the start makes no sense.
    pub fn new(scene: &CheckedScene, start: Start) -> Result<Self, MotionError> {
        scene.motion(start)?;
        let mut walk = Self {
            scene: scene.clone(),
            mode: Mode::Moving(PhaseId::FREE),
            releases: Vec::new(),
            time: 0.0,
            state: start,
            bounce_train: BounceTrain::default(),
            at_once: 0,
            impacts: Vec::new(),
        };
        let Start { position, velocity } = start;
        let forcing = walk.forcing_per_mass();
        let mode = scene.phases().mode_at(position, velocity, forcing, true);
        walk.enter_mode(mode, forcing);
        Ok(walk)
    }

    /// Time in s of the last crossing, or 0.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state right after the last crossing.
    pub fn state(&self) -> Start {
        self.state
    }

    /// The phase whose law holds after the last crossing; none while the mass is held.
    pub fn phase(&self) -> Option<&Phase> {
        self.phase_id().map(|phase| &self.scene.phases()[phase])
    }

    /// The id of the phase.
    pub fn phase_id(&self) -> Option<PhaseId> {
        self.mode.phase()
    }

    /// The guards that end the present phase. While the mass is held they ask for the forcing alone.
    pub fn guards(&self) -> &[Guard] {
        self.phase().map_or(&self.releases, |phase| &phase.guards)
    }

    /// The impacts so far.
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// The impacts, at the end.
    pub fn into_impacts(self) -> Vec<Impact> {
        self.impacts
    }

    /// Goes on beyond a guard that was found to rise through zero at `time` in s and `before` the crossing.
    ///
    /// # Errors
    /// [`MotionError::Stalled`] if crossings follow one another without time going on.
    pub fn cross(&mut self, guard: usize, time: f64, before: Start) -> Result<(), MotionError> {
        let elapsed = time - self.time;
        self.time = time;
        self.check_progress(elapsed)?;
        let forcing = self.forcing_per_mass();
        let (state, mode) = match self.mode {
            Mode::Moving(phase) => {
                let found = FoundCrossing {
                    elapsed,
                    guard,
                    position: before.position,
                    velocity: before.velocity,
                };
                self.reset(phase, &found, forcing)
            }
            Mode::Held(hold) | Mode::Chattering(hold) => (self.state, hold.after_release(guard)),
        };
        self.state = state;
        self.enter_mode(mode, forcing);
        Ok(())
    }

    /// State and mode after a crossing out of a phase, by the rules of [`ResetContext`].
    fn reset(&mut self, phase: PhaseId, found: &FoundCrossing, forcing: f64) -> (Start, Mode) {
        if let Some(surface) = self.scene.phases().endless_surface(phase, found.guard) {
            self.bounce_train.count_crossing(surface, found.velocity);
        }
        let moved = self.state.velocity != 0.0 || found.elapsed > 0.0;
        let force = Polynomial::default();
        let ground = ResetContext {
            phases: self.scene.phases(),
            fed: true,
            pierced: false,
            threshold: self.bounce_train.rest_threshold(),
            force: &force,
            period: self.scene.period(),
        };
        let landing = ground.reset(phase, found, forcing, moved);
        if landing.kind.is_impact() {
            let (time, velocity) = (self.time, found.velocity);
            self.impacts.push(Impact { time, velocity });
        }
        match landing.mode {
            Mode::Chattering(hold) => {
                let position = landing.state.position;
                let mode = self.scene.phases().mode_from_rest(hold, position, forcing);
                (Start::new(position, 0.0), mode)
            }
            mode => (landing.state, mode),
        }
    }

    fn enter_mode(&mut self, mode: Mode, forcing: f64) {
        let releases = |hold| {
            self.scene
                .phases()
                .release_guards(hold, self.state.position, forcing)
        };
        self.releases = mode.sticking().map(releases).unwrap_or_default();
        self.mode = mode;
    }

    /// Forcing of the drive per mass in m/s^2 at the last crossing.
    fn forcing_per_mass(&self) -> f64 {
        let drive = self.scene.excitation;
        let angle = drive.frequency * self.time + drive.reduced_phase();
        drive.amplitude / self.scene.mass * angle.cos()
    }

    /// Refuses more crossings at one instant than a method gets on with.
    fn check_progress(&mut self, elapsed: f64) -> Result<(), MotionError> {
        let instant = elapsed <= 4.0 * f64::EPSILON * self.time.max(self.scene.period());
        self.at_once = if instant { self.at_once + 1 } else { 0 };
        if self.at_once <= MAX_CROSSINGS_AT_ONCE {
            return Ok(());
        }
        Err(MotionError::Stalled {
            time: self.time,
            position: self.state.position,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Ratios, Stop};

    const START: Start = Start::new(9.0, 2.0);

    fn scene() -> CheckedScene {
        let mut scene = Ratios::unloaded().scene().expect("a machine");
        scene.stop = Stop::Rigid { restitution: 0.6 };
        scene.check().expect("valid")
    }

    #[test]
    fn a_crossing_leads_on_by_the_rules_of_landing() {
        let scene = scene();
        let mut walk = PhaseTracker::new(&scene, START).expect("a start");
        assert_eq!(walk.guards(), [Guard::rising_to(10.0)]);
        let before = Start::new(10.0 + 1e-12, 2.5);
        walk.cross(0, 0.4, before).expect("a rebound");
        let after = Start::new(10.0, -1.5);
        assert_eq!((walk.time(), walk.state()), (0.4, after));
        let impact = Impact {
            time: 0.4,
            velocity: 2.5,
        };
        assert_eq!(walk.impacts(), [impact]);
        assert!(walk.phase().is_some());
    }

    #[test]
    fn crossings_without_end_in_one_instant_are_an_error() {
        let scene = scene();
        let mut walk = PhaseTracker::new(&scene, START).expect("a start");
        let before = Start::new(10.0, 2.5);
        let error = (0..2000).find_map(|_| walk.cross(0, 0.4, before).err());
        assert!(
            matches!(error, Some(MotionError::Stalled { time: 0.4, .. })),
            "{error:?}"
        );
    }
}
