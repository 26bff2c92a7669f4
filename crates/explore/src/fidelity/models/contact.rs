//! One contact by itself: what it takes, how deep it goes, how long it lasts.

use softstop::{Crossing, CrossingKind, MotionError, Scene, SceneError, Start};
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
        let mut cycles = 1;
        let (motion, exit) = loop {
            let motion = StroboscopicMap::new(&bare.check()?, cycles).trajectory(start.into())?;
            let is_exit = |it: &&Crossing| comes_back(it, bare.clearance);
            let exit = motion.crossings().find(is_exit).copied();
            if exit.is_some() || cycles >= MAX_CONTACT_PERIODS {
                break (motion, exit);
            }
            cycles *= 2;
        };
        let (restitution, duration) = exit.map_or((0.0, f64::INFINITY), |exit| {
            let after = -exit.velocity_after;
            (after / velocity, motion.clock.time(exit.instant))
        });
        Ok(Self {
            velocity,
            restitution,
            penetration: motion.max_position() - bare.clearance,
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

/// True if the mass comes back through a clearance.
fn comes_back(crossing: &Crossing, clearance: f64) -> bool {
    let leaves = match crossing.kind {
        CrossingKind::Surface { forward, .. } => !forward,
        CrossingKind::Rebound { .. } => true,
        _ => false,
    };
    leaves && crossing.position == clearance && crossing.velocity_after < 0.0
}
