//! Motions by the safe engine: whether rounding can change the number of crossings, and how far it can move the end.
//!
//! The covariance of the rounding errors is carried along with the exact tangent of the motion,
//! C -> T C T' + [`ROUNDING`]^2 I for each arc and C -> S C S' at each crossing with saltation matrix S,
//! so that errors count from where they are made on. A number of crossings can change where the mass turns as
//! near to a face as the errors go, where it passes one so slowly that it goes no further beyond
//! it than that, and wherever the errors have grown so far that the tangent says nothing of them.

use nalgebra::Matrix2;
use softstop::internals::{ArcSolution, turning_points};
use softstop::{Arc, Clock, Crossing, CrossingKind, Observer, Scene, Start, Stop, Tangent};

/// Errors of position (m) and velocity (m/s) made on one arc. An arc has some ten windows and the motions are
/// up to 20 m and 30 m/s large: rounding makes at most some 10 * 4e-15, the 4th differences of both
/// engines' tables less than 1e-12. The tests of the batch engine ask for 1e-10.
pub const ROUNDING: f64 = 1e-10;
/// Growth of errors beyond which a motion counts as chaotic: with [`ROUNDING`] they are 1e-4 of a length of 1,
/// no longer small against what the tangent leaves out.
const CHAOS: f64 = 1e6;

/// What the safe engine finds of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    pub impacts: u64,
    /// Of all faces.
    pub crossings: u64,
    pub end: Start,
    /// How far rounding can move position (m) and velocity (m/s) of the end.
    pub error_bound: f64,
    /// Rounding can change the numbers, or the error bound says nothing of the end.
    pub is_ambiguous: bool,
}

/// Follows a motion with the safe engine.
pub fn follow(scene: &Scene, start: Start, periods: u64) -> Reference {
    let mut errors = RoundingErrors {
        faces: faces(scene),
        covariance: Matrix2::identity() * (ROUNDING * ROUNDING),
        tangent: Tangent::default(),
        impacts: 0,
        crossings: 0,
        is_ambiguous: false,
    };
    let mut motion = scene.motion(start).expect("valid");
    let end = Clock::at_cycle(periods);
    motion.advance(end, &mut errors).expect("bounded");
    motion.tell_arc(&mut errors);
    Reference {
        impacts: errors.impacts,
        crossings: errors.crossings,
        end: motion.state(),
        error_bound: errors.bound(),
        is_ambiguous: errors.is_ambiguous,
    }
}

/// Where a machine has faces, in m.
pub fn faces(scene: &Scene) -> Vec<f64> {
    let stop = scene.stop_position();
    let mut faces = vec![scene.clearance, stop];
    let strip = scene.piercing;
    faces.extend(strip.map(|strip| scene.clearance + strip.thickness));
    faces.extend(scene.wall().map(|wall| wall.position));
    if let Stop::PiecewiseLinear { loading, unloading } = &scene.stop {
        let corners = loading.iter().chain(unloading);
        faces.extend(corners.map(|slope| stop + slope.from));
    }
    faces
}

struct RoundingErrors {
    faces: Vec<f64>,
    covariance: Matrix2<f64>,
    tangent: Tangent,
    impacts: u64,
    crossings: u64,
    is_ambiguous: bool,
}

impl RoundingErrors {
    fn bound(&self) -> f64 {
        self.covariance.trace().sqrt()
    }

    /// Carries the errors over the last arc or crossing.
    fn carry(&mut self) {
        let tangent = std::mem::take(&mut self.tangent).matrix;
        self.covariance = tangent * self.covariance * tangent.transpose();
        // NaN is ambiguous too.
        let small = self.bound() < CHAOS * ROUNDING;
        self.is_ambiguous |= !small;
    }

    fn passes_near(&self, position: f64, bound: f64) -> bool {
        let mut faces = self.faces.iter();
        faces.any(|face| (position - face).abs() <= bound)
    }
}

impl Observer for RoundingErrors {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        if self.is_ambiguous {
            return;
        }
        let before = self.bound();
        self.tangent.arc(arc, elapsed);
        self.carry();
        self.covariance += Matrix2::identity() * (ROUNDING * ROUNDING);
        let bound = before.max(self.bound());
        let mut turns = turning_points(arc.course, elapsed, goes_on(arc.course, elapsed));
        let near = turns.any(|turn| self.passes_near(turn.position, bound));
        self.is_ambiguous |= near;
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.impacts += u64::from(crossing.impact_velocity().is_some());
        self.crossings += 1;
        if self.is_ambiguous {
            return;
        }
        let bound = self.bound();
        let (before, after) = (crossing.acceleration_before, crossing.acceleration_after);
        let depth = 0.5 * crossing.velocity.powi(2) / before.abs().max(after.abs());
        self.is_ambiguous |= match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => depth <= bound,
            CrossingKind::Reversal => self.passes_near(crossing.position, bound),
            _ => false,
        };
        self.tangent.crossing(crossing);
        self.carry();
    }
}

/// Whether the mass turns back first, on its way from the start of an arc.
fn goes_on(arc: &ArcSolution, duration: f64) -> bool {
    match arc.start_node().velocity {
        0.0 => arc.node_at(1e-6 * duration).velocity >= 0.0,
        velocity => velocity >= 0.0,
    }
}
