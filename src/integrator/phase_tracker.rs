//! A motion from phase to phase, for methods that find the guards' crossings themselves.

use super::crossing::Crossing;
use super::observer::Observer;
use super::{Impact, Motion, Start};
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::events::{FoundCrossing, Guard};
use crate::phases::{Phase, PhaseId};

/// Most crossings within one instant: a method that makes more does not get on.
const MAX_CROSSINGS_AT_ONCE: u32 = 1000;

/// Where a motion is between its phases: which law holds, which guards end it, and what a crossing of one
/// leads to, by the same rules as those of the exact method.
///
/// Bounces on a rigid stop whose sum the exact method would take are rest at once: it would come within
/// 2^-26 of a drive period.
#[derive(Debug, Clone)]
pub struct PhaseTracker {
    motion: Motion,
    /// The guards that end the present phase, or let go a mass that is held.
    guards: Vec<Guard>,
    time: f64,
    at_once: u32,
    impacts: Vec<Impact>,
}

/// The impact of a crossing, if it is one.
#[derive(Default)]
struct ImpactVelocity(Option<f64>);

impl Observer for ImpactVelocity {
    fn crossing(&mut self, crossing: &Crossing) {
        self.0 = crossing.impact_velocity();
    }
}

impl PhaseTracker {
    /// A motion of this machine from this state at time 0.
    ///
    /// # Errors
    /// [`MotionError`] if the start makes no sense.
    pub fn new(scene: &CheckedScene, start: Start) -> Result<Self, MotionError> {
        let motion = scene.motion(start)?;
        Ok(Self {
            guards: motion.present_guards().into_owned(),
            motion,
            time: 0.0,
            at_once: 0,
            impacts: Vec::new(),
        })
    }

    /// Time in s of the last crossing of the tracked motion, or 0.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state right after the last crossing of the tracked motion.
    pub fn state(&self) -> Start {
        self.motion.state()
    }

    /// The phase whose law holds after the last crossing; none while the mass is held.
    pub fn phase(&self) -> Option<&Phase> {
        self.motion.phase()
    }

    /// The id of the phase.
    pub fn phase_id(&self) -> Option<PhaseId> {
        self.motion.mode().phase()
    }

    /// The guards that end the present phase. While the mass is held they ask for the forcing alone.
    pub fn guards(&self) -> &[Guard] {
        &self.guards
    }

    /// The impacts of the tracked motion so far.
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// The impacts of the tracked motion, at the end.
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
        let before = match self.phase() {
            Some(_) => before,
            None => self.state(),
        };
        let motion = &mut self.motion;
        let found = FoundCrossing {
            elapsed: motion
                .clock
                .elapsed(motion.start, motion.clock.instant(time)),
            guard,
            position: before.position,
            velocity: before.velocity,
        };
        let mut impact = ImpactVelocity::default();
        motion.pass_crossing(found, &mut impact);
        if let Some(bounces) = motion.course.chatter() {
            motion.end_step(bounces.duration, &mut ());
        }
        self.guards = motion.present_guards().into_owned();
        let impact = impact.0.map(|velocity| Impact { time, velocity });
        self.impacts.extend(impact);
        Ok(())
    }

    /// Refuses more crossings at one instant than a method gets on with.
    fn check_progress(&mut self, elapsed: f64) -> Result<(), MotionError> {
        let instant = elapsed <= 4.0 * f64::EPSILON * self.time.max(self.motion.clock.period());
        self.at_once = if instant { self.at_once + 1 } else { 0 };
        if self.at_once <= MAX_CROSSINGS_AT_ONCE {
            return Ok(());
        }
        Err(MotionError::Stalled {
            time: self.time,
            position: self.state().position,
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
