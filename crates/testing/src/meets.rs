//! What a motion meets on its way: by this, tests leave out motions that no difference can follow.

use softstop::{Crossing, CrossingKind, Instant, Observer, Scene, Start};

/// What a motion has met.
#[derive(Clone, Debug)]
pub struct Meets {
    /// All crossings in their order.
    pub crossings: Vec<CrossingKind>,
    /// How many of them are impacts.
    pub impacts: u64,
    /// The lowest speed at a surface or a rebound, in m/s; infinite where there is none.
    pub slowest: f64,
    /// ln of the product of R^2 over all rebounds.
    pub contraction: f64,
    /// It turned under friction, was held or came to rest.
    pub held: bool,
}

impl Default for Meets {
    fn default() -> Self {
        Self {
            crossings: Vec::new(),
            impacts: 0,
            slowest: f64::INFINITY,
            contraction: 0.0,
            held: false,
        }
    }
}

impl Meets {
    /// What a motion meets from its start, at drive angle phi, to an instant.
    ///
    /// # Panics
    /// If the start cannot be, or the motion has no end.
    pub fn until(scene: &Scene, start: Start, end: Instant) -> Self {
        let mut meets = Self::default();
        let mut motion = scene.motion(start).expect("valid");
        motion.advance(end, &mut meets).expect("bounded");
        meets
    }
}

impl Observer for Meets {
    fn crossing(&mut self, crossing: &Crossing) {
        self.crossings.push(crossing.kind);
        self.impacts += u64::from(crossing.impact_velocity().is_some());
        match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => {
                self.slowest = self.slowest.min(crossing.velocity.abs());
            }
            CrossingKind::Switch => {}
            _ => self.held = true,
        }
        if let CrossingKind::Rebound { .. } = crossing.kind {
            let kept = crossing.velocity_after / crossing.velocity;
            self.contraction += 2.0 * kept.abs().ln();
        }
    }
}
