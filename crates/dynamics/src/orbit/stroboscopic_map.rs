//! The stroboscopic map, from a state at a drive angle to the state at the same drive angle whole periods later.

use nalgebra::{Matrix2, Vector2};

use super::Monodromy;
use super::recurrence::{motion_size, state_distance};
use crate::record_trajectory::record_trajectory;
use crate::tolerance::SAME;
use softstop::{
    CheckedScene, Clock, ImpactEvent, Instant, MotionError, Observer, Start, Trajectory,
};

/// The stroboscopic map of a scene: from a state at time 0 to the state some drive periods later.
#[derive(Debug, Clone)]
pub struct StroboscopicMap {
    scene: CheckedScene,
    periods: u64,
}

/// One application of the map.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MapApplication {
    /// Position and velocity after the periods.
    pub end: Vector2<f64>,
    /// Exact Jacobian of the map.
    pub monodromy: Monodromy,
    /// Integral of damping over mass along the way, which the determinant follows from.
    pub damping_integral: f64,
    /// Impacts on the way, in order of time.
    pub impacts: Vec<ImpactEvent>,
    /// Ends of complete chatter: infinitely many ever weaker impacts that end in rest, of which `impacts`
    /// holds only those before the summed ones.
    pub rests: Vec<Instant>,
    /// All arcs and crossings of the way.
    pub(crate) trajectory: Trajectory,
}

impl MapApplication {
    /// True if dry friction holds the mass at this state for all of the way, or lets it creep ever more slowly: the state
    /// is one of many at which it holds. The drive's frequency, in rad/s, scales positions to velocities.
    pub(crate) fn is_at_rest(&self, from: &Start, frequency: f64) -> bool {
        let held = Matrix2::new(1.0, 0.0, 0.0, 0.0);
        let gap = Start::new(from.position - self.end.x, from.velocity);
        let creep = state_distance(frequency, &gap, &Start::REST);
        let size = motion_size(frequency, [from]);
        (self.monodromy.matrix - held).norm() <= SAME && creep <= SAME * size
    }
}

impl StroboscopicMap {
    /// The map of `scene` over `periods` drive periods.
    pub fn new(scene: &CheckedScene, periods: u64) -> Self {
        Self {
            scene: scene.clone(),
            periods,
        }
    }

    /// Drive periods of one application of the map.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// The scene of the map.
    pub fn scene(&self) -> &CheckedScene {
        &self.scene
    }

    /// The image of a state under the map, with the Jacobian and the impacts on the way.
    ///
    /// # Errors
    /// [`MotionError`] if the state is not finite or the motion unbounded.
    pub fn apply(&self, state: Vector2<f64>) -> Result<MapApplication, MotionError> {
        let trajectory = self.trajectory(state)?;
        let tangent = trajectory.tangent();
        Ok(MapApplication {
            end: trajectory.end.into(),
            monodromy: Monodromy::from(&tangent),
            damping_integral: tangent.damping_integral,
            impacts: trajectory.impacts().collect(),
            rests: trajectory.rests().collect(),
            trajectory,
        })
    }

    /// The image of a state under the map, without the Jacobian.
    ///
    /// # Errors
    /// As [`StroboscopicMap::apply`].
    pub fn image(&self, state: Vector2<f64>) -> Result<Vector2<f64>, MotionError> {
        self.image_with_observer(state, &mut ())
    }

    /// The image of a state under the map; an observer is told of the way, of which nothing is kept.
    pub(crate) fn image_with_observer(
        &self,
        state: Vector2<f64>,
        observer: &mut dyn Observer,
    ) -> Result<Vector2<f64>, MotionError> {
        let end = Clock::at_cycle(self.periods);
        let mut motion = self.scene.motion(state.into())?;
        motion.advance(end, observer)?;
        Ok(motion.state().into())
    }

    /// The largest position in m on the way of the map from a state.
    ///
    /// # Errors
    /// As [`StroboscopicMap::apply`].
    pub fn max_position(&self, state: Vector2<f64>) -> Result<f64, MotionError> {
        Ok(self.trajectory(state)?.max_position())
    }

    /// The arcs and crossings of the motion that the map follows from a state.
    ///
    /// # Errors
    /// As [`StroboscopicMap::apply`].
    pub fn trajectory(&self, state: Vector2<f64>) -> Result<Trajectory, MotionError> {
        let end = Clock::at_cycle(self.periods);
        record_trajectory(&self.scene, state, |motion, kept| motion.advance(end, kept))
    }
}
