//! Bounds of z = 1: the frequencies at which the motion of a machine begins and ends.

use serde::Serialize;

use super::{grazing_frequencies, loss_of_stability};
use crate::continuation::{Direction, TestFunction};
use crate::orbit::{Orbit, OrbitError};
use softstop::{Scene, Start};

/// Frequencies in rad/s that bound z = 1 of a machine: grazing g0, flip s_PD, fold s_SN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Bounds {
    /// g0: above it the motion without impacts does not reach the clearance.
    pub grazing: Option<f64>,
    /// s_PD: the z = 1 motion, followed down from the scene's frequency, doubles its period.
    pub flip: Option<f64>,
    /// s_SN: the z = 1 motion, followed up from the scene's frequency, ends in a fold.
    pub fold: Option<f64>,
}

impl Bounds {
    /// The bounds of a scene; those of its z = 1 motion only with a state near it.
    ///
    /// # Errors
    /// [`OrbitError`] if the branch cannot be begun.
    pub fn of_scene(scene: &Scene, near: Option<Start>) -> Result<Self, OrbitError> {
        let grazing = grazing_frequencies(scene).ok().map(|(_, above)| above);
        let orbit = near.map(|start| Orbit::find_near(scene, start.into()));
        let orbit = orbit.transpose()?;
        let bound = |heading, test| match &orbit {
            Some(orbit) => loss_of_stability(orbit, heading, test),
            None => Ok(None),
        };
        Ok(Self {
            grazing,
            flip: bound(Direction::Down, TestFunction::Flip)?.map(|point| point.parameter),
            fold: bound(Direction::Up, TestFunction::Fold)?.map(|point| point.parameter),
        })
    }
}
