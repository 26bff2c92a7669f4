//! One machine, one period: where a state goes, and where the z = 1 motion near it is.

use nalgebra::{RowVector2, Vector2};

use softstop::{Arc, CheckedScene, Clock, Crossing, MotionError, Observer, Scene, Tangent};
use softstop_dynamics::continuation::{BranchPoint, TestFunction};
use softstop_dynamics::internals::advance_in_period;
use softstop_dynamics::orbit::Monodromy;

/// Periods that are looked at before a motion is given up.
const LOOKS: usize = 6;
/// Length of a step, in the scales of the motion, after which what is left of the way is its square.
const SHORT: f64 = 1e-5;
/// How many times longer than the last step the way to a loss of stability has to be.
const CLEAR: f64 = 1e3;

/// A period from a state on.
#[derive(Default)]
struct ReturnMap {
    /// The state after it.
    end: Vector2<f64>,
    /// The exact Jacobian.
    tangent: Tangent,
    /// Impacts on the way.
    impacts: usize,
    /// Before-impact velocity in m/s of the last of them.
    velocity: f64,
    /// How that changes with the state at the beginning.
    by_state: RowVector2<f64>,
}

impl ReturnMap {
    /// The period of a machine from a state on.
    ///
    /// # Errors
    /// [`MotionError`] for a motion that cannot be computed.
    fn at(scene: &CheckedScene, state: Vector2<f64>) -> Result<Self, MotionError> {
        let mut motion = scene.motion(state.into())?;
        let mut once = Self::default();
        advance_in_period(&mut motion, Clock::at_cycle(1), &mut once)?;
        motion.tell_arc(&mut once);
        once.end = motion.state().into();
        Ok(once)
    }

    /// From the state to the fixed point, as the Jacobian has it.
    fn step(&self, state: Vector2<f64>) -> Option<Vector2<f64>> {
        let inverse = Monodromy::from(&self.tangent).resolvent()?;
        Some(inverse * (self.end - state))
    }
}

impl Observer for ReturnMap {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        self.tangent.arc(arc, elapsed);
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if let Some(velocity) = crossing.impact_velocity() {
            let [position, rate] = [0, 1].map(|row| self.tangent.matrix.row(row).into_owned());
            self.impacts += 1;
            self.velocity = velocity;
            // The face is met sooner by as much as the mass is ahead.
            self.by_state = rate - crossing.acceleration_before / velocity * position;
        }
        self.tangent.crossing(crossing);
    }
}

/// A stable z = 1 motion.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct StableMotion {
    /// Position in m and velocity in m/s at time 0.
    pub state: Vector2<f64>,
    /// Before-impact velocity in m/s.
    pub velocity: f64,
}

impl StableMotion {
    /// That of a point of a branch.
    pub(super) fn of(point: &BranchPoint) -> Self {
        Self {
            state: point.state(),
            velocity: point.before_impact_velocity(),
        }
    }

    /// The stable z = 1 motion of a machine to which a few steps of Newton's method lead from a state near it, no farther
    /// than `reach` in the scales of the motion; none where that is in any doubt.
    pub fn near(scene: &Scene, guess: Vector2<f64>, reach: f64) -> Option<Self> {
        let scene = &scene.check().ok()?;
        let scales = scene.motion_scales();
        let mut state = guess;
        for _ in 0..LOOKS {
            let once = ReturnMap::at(scene, state).ok()?;
            let step = once.step(state).filter(|_| once.impacts == 1)?;
            state += step;
            if scales.state(&(state - guess)).norm() > reach {
                return None;
            }
            let far = scales.state(&step).norm();
            let monodromy = Monodromy::from(&once.tangent);
            let clear = |test: TestFunction| test.scaled_value(&monodromy) > CLEAR * far;
            let sure = far <= SHORT && clear(TestFunction::Fold) && clear(TestFunction::Flip);
            if sure && monodromy.is_stable() {
                return Some(Self {
                    state,
                    velocity: once.velocity + (once.by_state * step).x,
                });
            }
        }
        None
    }
}
