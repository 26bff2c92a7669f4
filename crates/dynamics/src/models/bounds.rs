//! Where the z = 1 motion of a machine begins and ends as the drive's frequency changes.

use nalgebra::Vector2;
use serde::Serialize;

use super::Observation;
use crate::continuation::{Heading, Test};
use crate::orbit::{Orbit, OrbitError};
use crate::zone::{grazing_frequencies, loss_of_stability};
use softstop::Scene;

/// Frequencies in rad/s that bound regimes of a machine.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// g0: above it the motion without impacts does not reach the clearance.
    pub grazing: Option<f64>,
    /// s_PD: the z = 1 motion, followed down from the scene's frequency, doubles its period.
    pub flip: Option<f64>,
    /// s_SN: the z = 1 motion, followed up from the scene's frequency, ends in a fold.
    pub fold: Option<f64>,
}

/// The bounds of a scene whose settled motion has been observed; those of the z = 1 motion only if it
/// is one.
///
/// # Errors
/// [`OrbitError`] if the branch cannot be begun.
pub fn bounds(scene: &Scene, observed: &Observation) -> Result<Bounds, OrbitError> {
    let is_z1 = observed
        .regime
        .is_some_and(|regime| (regime.impacts, regime.periods) == (1, 1));
    let (flip, fold) = if is_z1 {
        let start = Vector2::new(observed.start.position, observed.start.velocity);
        let orbit = Orbit::near(scene, start)?;
        let bound = |heading, test| {
            let point = loss_of_stability(&orbit, heading, test)?;
            Ok::<_, OrbitError>(point.map(|point| point.parameter))
        };
        (
            bound(Heading::Down, Test::Flip)?,
            bound(Heading::Up, Test::Fold)?,
        )
    } else {
        (None, None)
    };
    Ok(Bounds {
        grazing: grazing_frequencies(scene).ok().map(|(_, above)| above),
        flip,
        fold,
    })
}
