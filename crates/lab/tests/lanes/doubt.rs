//! Whether rounding can change the number of crossings of a motion, and how far it can move the end.
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
pub const CHAOS: f64 = 1e6;

/// What is known of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// How many there are.
    pub impacts: u64,
    /// Crossings of all faces.
    pub crossings: u64,
    /// State at its end.
    pub end: Start,
    /// Errors of position (m) and velocity (m/s) that have come together there.
    pub errors: f64,
    /// Rounding can change the numbers, or says nothing of the end.
    pub doubtful: bool,
}

/// Follows a motion with the safe engine and judges it.
pub fn judge(scene: &Scene, start: Start, periods: u64) -> Verdict {
    let mut doubt = Doubt {
        levels: levels(scene),
        covariance: Matrix2::identity() * (ROUNDING * ROUNDING),
        tangent: Tangent::default(),
        verdict: Verdict {
            impacts: 0,
            crossings: 0,
            end: start,
            errors: 0.0,
            doubtful: false,
        },
    };
    let mut motion = scene.motion(start).expect("valid");
    let end = Clock::at_cycle(periods);
    motion.advance(end, &mut doubt).expect("bounded");
    motion.tell_arc(&mut doubt);
    Verdict {
        end: motion.state(),
        errors: doubt.errors(),
        ..doubt.verdict
    }
}

/// Where a machine has faces, in m.
pub fn levels(scene: &Scene) -> Vec<f64> {
    let stop = scene.stop_position();
    let mut levels = vec![scene.clearance, stop];
    let strip = scene.piercing;
    levels.extend(strip.map(|strip| scene.clearance + strip.thickness));
    levels.extend(scene.wall().map(|wall| wall.position));
    if let Stop::PiecewiseLinear { loading, unloading } = &scene.stop {
        let corners = loading.iter().chain(unloading);
        levels.extend(corners.map(|slope| stop + slope.from));
    }
    levels
}

struct Doubt {
    levels: Vec<f64>,
    covariance: Matrix2<f64>,
    tangent: Tangent,
    verdict: Verdict,
}

impl Doubt {
    /// Errors as large as they may be.
    fn errors(&self) -> f64 {
        self.covariance.trace().sqrt()
    }

    /// Carries the errors over the last stretch.
    fn carry(&mut self) {
        let stretch = std::mem::take(&mut self.tangent).matrix;
        self.covariance = stretch * self.covariance * stretch.transpose();
        // NaN is doubtful too.
        let small = self.errors() < CHAOS * ROUNDING;
        self.verdict.doubtful |= !small;
    }

    fn passes_near(&self, position: f64, errors: f64) -> bool {
        let mut levels = self.levels.iter();
        levels.any(|level| (position - level).abs() <= errors)
    }
}

impl Observer for Doubt {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        if self.verdict.doubtful {
            return;
        }
        let before = self.errors();
        self.tangent.arc(arc, elapsed);
        self.carry();
        self.covariance += Matrix2::identity() * (ROUNDING * ROUNDING);
        let errors = before.max(self.errors());
        let mut turns = turning_points(arc.course, elapsed, goes_on(arc.course, elapsed));
        let near = turns.any(|turn| self.passes_near(turn.position, errors));
        self.verdict.doubtful |= near;
    }

    fn crossing(&mut self, crossing: &Crossing) {
        self.verdict.impacts += u64::from(crossing.impact_velocity().is_some());
        self.verdict.crossings += 1;
        if self.verdict.doubtful {
            return;
        }
        let errors = self.errors();
        let (before, after) = (crossing.acceleration_before, crossing.acceleration_after);
        let depth = 0.5 * crossing.velocity.powi(2) / before.abs().max(after.abs());
        self.verdict.doubtful |= match crossing.kind {
            CrossingKind::Surface { .. } | CrossingKind::Rebound { .. } => depth <= errors,
            CrossingKind::Reversal => self.passes_near(crossing.position, errors),
            _ => false,
        };
        self.tangent.crossing(crossing);
        self.carry();
    }
}

/// Whether the mass turns back first, on its way from the start of a course.
fn goes_on(course: &ArcSolution, duration: f64) -> bool {
    match course.start_node().velocity {
        0.0 => course.node_at(1e-6 * duration).velocity >= 0.0,
        velocity => velocity >= 0.0,
    }
}
