//! The establishing certainty of z = 1 along the hysteresis zone.

use super::basin_survey::find_basins_of_scenes;
use super::{BasinOptions, Basins, Grid};
use crate::monitor::{Monitor, OptionalMemory};
use crate::orbit::Regime;
use crate::zone::{Zone, ZoneError};
use softstop::Scene;

/// The establishing certainty of z = 1 at one place of a hysteresis zone, with the basins there.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CertaintyAtPlace {
    /// Place s: 0 at g0, 1 at s_SN.
    pub place: f64,
    /// Frequency in rad/s.
    pub frequency: f64,
    /// Share of the cells that lead to z = 1: the establishing certainty.
    pub certainty: f64,
    /// Wilson's 95 % interval of it.
    pub interval: [f64; 2],
    /// All basins there.
    pub basins: Basins,
}

/// The establishing certainty of z = 1 at places s of a hysteresis zone (Peterka 2003, section 3: it is said to rise from 0 at
/// s_SN to 1 at g0): the share of the initial states of a grid that lead to any z = 1 motion. The monitor is told of the cells
/// done at all places.
///
/// # Errors
/// [`ZoneError`] if a place lies outside the zone, the basins cannot be computed or the monitor says stop.
pub fn establishing_certainties(
    zone: &Zone,
    places: &[f64],
    grid: &Grid,
    options: &BasinOptions,
    monitor: Monitor<'_>,
    kept: OptionalMemory<'_>,
) -> Result<Vec<CertaintyAtPlace>, ZoneError> {
    if let Some(place) = places.iter().find(|it| !(0.0..=1.0).contains(*it)) {
        return Err(ZoneError::Outside { share: *place });
    }
    let scenes: Vec<Scene> = places.iter().map(|place| zone.scene_at(*place)).collect();
    let all = find_basins_of_scenes(&scenes, grid, options, monitor, kept)?;
    let at = |((place, scene), basins): ((&f64, &Scene), Basins)| {
        let (certainty, interval) = basins.regime_share(Regime::ONE);
        CertaintyAtPlace {
            place: *place,
            frequency: scene.excitation.frequency,
            certainty,
            interval,
            basins,
        }
    };
    Ok(places.iter().zip(&scenes).zip(all).map(at).collect())
}
