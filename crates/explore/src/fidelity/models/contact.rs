//! One contact by itself: what it takes, how deep it goes, how long it lasts.

use softstop::{
    Clock, Crossing, CrossingKind, Instant, MotionError, Observer, Scene, SceneError, Start,
};
use softstop_dynamics::StroboscopicMap;

/// What a contact is like that begins with a given velocity, with nothing but the contact's own forces
/// (neither suspension nor drive): the limit in which a rigid stop's restitution is defined.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Contact {
    /// Before-impact velocity in m/s, > 0.
    pub velocity: f64,
    /// After-impact speed over before-impact velocity; 0 if the mass does not come back.
    pub restitution: f64,
    /// Largest penetration beyond the clearance in m.
    pub penetration: f64,
    /// How long the mass is beyond the clearance, in s; infinite if it does not come back.
    pub duration: f64,
}

/// Drive periods after which a mass that has not come back is taken not to.
const MAX_CONTACT_PERIODS: u64 = 1024;

impl Contact {
    /// The contact of a scene's stop, and of the strip before it, at a before-impact velocity in m/s,
    /// by the exact flow of its phases.
    ///
    /// # Errors
    /// [`MotionError`] if the scene is invalid, or the velocity not positive and finite.
    pub fn of(scene: &Scene, velocity: f64) -> Result<Self, MotionError> {
        if !(velocity.is_finite() && velocity > 0.0) {
            return Err(MotionError::Scene(SceneError::OutOfRange {
                name: "before-impact velocity",
                value: velocity,
                allowed: "finite and > 0",
            }));
        }
        let bare = bare(scene);
        let start = Start::new(bare.clearance, velocity);
        let mut exit = ExitRecorder {
            clearance: bare.clearance,
            found: None,
        };
        let mut motion = bare.motion(start)?;
        let clock = *motion.clock();
        let mut cycles = 0;
        while exit.found.is_none() && cycles < MAX_CONTACT_PERIODS {
            cycles = (2 * cycles).max(1);
            motion.advance(Clock::at_cycle(cycles), &mut exit)?;
        }
        let map = StroboscopicMap::new(&bare, cycles)?;
        let deepest = map.max_position(start.into())?;
        let (restitution, duration) = exit.found.map_or((0.0, f64::INFINITY), |(at, speed)| {
            (speed / velocity, clock.time(at))
        });
        Ok(Self {
            velocity,
            restitution,
            penetration: deepest - bare.clearance,
            duration,
        })
    }
}

/// The scene without suspension and drive. The damper of the suspension goes with it; in contact all of
/// the contact damping stays.
fn bare(scene: &Scene) -> Scene {
    let mut bare = scene.clone();
    bare.stiffness = 0.0;
    bare.damping = 0.0;
    bare.excitation.amplitude = 0.0;
    bare.clearance = 0.0;
    bare.below = None;
    bare
}

/// Waits for the mass to come back through the clearance.
struct ExitRecorder {
    clearance: f64,
    /// When, and how fast.
    found: Option<(Instant, f64)>,
}

impl Observer for ExitRecorder {
    fn crossing(&mut self, crossing: &Crossing) {
        let leaves = match crossing.kind {
            CrossingKind::Surface { forward, .. } => !forward,
            CrossingKind::Rebound { .. } => true,
            _ => false,
        };
        let outside = crossing.position == self.clearance && crossing.velocity_after < 0.0;
        if leaves && outside && self.found.is_none() {
            self.found = Some((crossing.instant, -crossing.velocity_after));
        }
    }
}
