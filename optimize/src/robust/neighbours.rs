//! Motions of machines near one whose motion is known.

use crate::spread::{Settled, along, in_coordinates, varied};
use nalgebra::Vector2;
use softstop_dynamics::Orbit;
use softstop_dynamics::figure::Figure;
use softstop_dynamics::slopes;

use super::Tolerances;

/// How far from where its derivatives lead a motion may be found: a share of that way, and so far anyway, in the scales of the
/// motion.
const REACH: f64 = 0.5;
const NEAR: f64 = 1e-3;

/// The machines of a spread, about the motion of the nominal one.
pub(crate) struct Neighbours<'a> {
    pub spread: &'a Tolerances,
    pub nominal: &'a Orbit,
    /// How position and velocity at time 0 change with each coordinate; none where they have no derivatives.
    state: Option<[Vec<f64>; 2]>,
}

impl<'a> Neighbours<'a> {
    pub fn new(spread: &'a Tolerances, nominal: &'a Orbit) -> Self {
        let centre = vec![0.0; spread.dimensions()];
        let slopes = slopes::differentiate_orbit(nominal, &varied(spread, &centre)).ok();
        let state = slopes.map(|slopes| {
            [&slopes.position, &slopes.velocity]
                .map(|it| in_coordinates(spread, &centre, &slopes.parameters, &it.by))
        });
        Self {
            spread,
            nominal,
            state,
        }
    }

    /// The motion at some coordinates that goes on from the nominal one: by Newton's method from where its derivatives lead,
    /// and where that is in any doubt by following it there. None if it is lost on the way.
    pub fn motion(&self, at: &[f64]) -> Option<Orbit> {
        let scene = self.spread.scene(at);
        if let Some(settled) = self.settled(at) {
            return Orbit::find_near(&scene, settled.state).ok();
        }
        let reached = along(self.spread, self.nominal, at, 1.0).ok()?;
        let orbit = Orbit::find_near(&scene, reached.point.state());
        orbit.ok().filter(|_| reached.loss.is_none())
    }

    fn settled(&self, at: &[f64]) -> Option<Settled> {
        let [position, velocity] = self.state.as_ref()?;
        let along = |by: &Vec<f64>| by.iter().zip(at).map(|(by, at)| by * at).sum::<f64>();
        let way = Vector2::new(along(position), along(velocity));
        let far = self.nominal.scene.motion_scales().state(&way).norm();
        let reach = (REACH * far).max(NEAR);
        Settled::near(&self.spread.scene(at), self.nominal.state() + way, reach)
    }

    /// The value of a figure of the motion at some coordinates.
    pub fn value(&self, at: &[f64], figure: Figure) -> Option<f64> {
        self.spread.value(figure, &self.motion(at)?)
    }
}
