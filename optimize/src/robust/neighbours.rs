//! Motions of machines near one whose motion is known.

use crate::spread::{in_coordinates, motion_of, varied};
use nalgebra::Vector2;
use softstop_dynamics::Orbit;
use softstop_dynamics::derivatives;
use softstop_dynamics::figure::Figure;

use super::Tolerances;
use super::meeting::dot;

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
        let slopes = derivatives::differentiate_orbit(nominal, &varied(spread, &centre)).ok();
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
        let guess = self.state.as_ref().map(|state| {
            let way = Vector2::from(state.each_ref().map(|by| dot(by, at)));
            let far = self.nominal.scene.motion_scales().state(&way).norm();
            (self.nominal.state() + way, (REACH * far).max(NEAR))
        });
        let settled = motion_of(self.spread, self.nominal, at, guess)?;
        Orbit::find_near(&self.spread.scene(at), settled.state).ok()
    }

    /// The value of a figure of the motion at some coordinates.
    pub fn value(&self, at: &[f64], figure: Figure) -> Option<f64> {
        self.spread.value(figure, &self.motion(at)?)
    }
}
