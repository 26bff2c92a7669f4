//! Integrity along the hysteresis zone: how the basin of z = 1 is eaten away from g0 to s_SN (Thompson 1989; Rega and
//! Lenci 2005).

use serde::{Deserialize, Serialize};

use super::establishment::{Establishment, START_SEED};
use crate::attractors::{Region, starting_box, states_for_starting_box};
use crate::monitor::Monitor;
use crate::orbit::{Orbit, OrbitError};
use crate::parallel;
use crate::zone::{Zone, ZoneError};
use softstop::{Scene, Start};

/// One box of starts for all places of a hysteresis zone: that of the machine at its own frequency ([`starting_box`]), made wider
/// if motions at the ends of the zone or in the middle lie outside it; and whether it is wider.
///
/// # Errors
/// As [`starting_box`].
pub fn zone_box(
    scene: &Scene,
    zone: &Zone,
    monitor: Monitor<'_>,
) -> Result<(Region, bool), OrbitError> {
    let own = starting_box(scene, monitor)?;
    let mut all = Vec::new();
    for place in [0.0, 0.5, 0.99] {
        all.extend(states_for_starting_box(&zone.scene_at(place), monitor)?);
    }
    let region = own.widened_to_hold(scene, &all);
    Ok((region, region != own))
}

/// The integrity of the z = 1 motion at one place of a hysteresis zone: share and ball of the starts that lead to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Integrity {
    /// Place s: 0 at g0, 1 at s_SN.
    pub place: f64,
    /// Frequency in rad/s.
    pub frequency: f64,
    /// Before-impact velocity of the motion in m/s.
    pub velocity: f64,
    /// Share of the box that leads to it.
    pub certainty: Establishment,
    /// Radius of the largest ball about the motion's state at drive angle phi that lies in the box and all of whose starts lead
    /// to it: the local integrity measure. In units of half of each axis of the box, so that on the plane of states it is an
    /// ellipse. The ball is filled with starts until all lead there.
    pub radius: f64,
}

/// The integrity of the z = 1 motion at places along its hysteresis zone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ErosionProfile {
    /// The box of starts, one for all places.
    pub region: Region,
    /// Whether it is wider than was asked for: a motion lies outside that.
    pub widened: bool,
    /// The places, as they were asked for.
    pub places: Vec<Integrity>,
}

impl ErosionProfile {
    /// The erosion profile at places s in [0, 1] of a hysteresis zone, with the same starts at each in one box, which is made
    /// wider if a motion lies outside it. At the fold s_SN itself the motion attracts from one side alone: what it still attracts has a
    /// share, but no ball lies in it. The result is the same for any number of threads.
    ///
    /// # Errors
    /// [`ZoneError`] if a place lies outside the zone, a motion is lost, the monitor says stop or the budget is spent.
    pub fn of(
        zone: &Zone,
        region: &Region,
        (places, starts): (&[f64], usize),
        monitor: Monitor<'_>,
    ) -> Result<Self, ZoneError> {
        let orbits = places.iter().map(|place| zone.orbit_at(*place));
        let orbits: Vec<Orbit> = orbits.collect::<Result<_, _>>()?;
        let all = orbits.iter().map(|orbit| Start::from(orbit.state()));
        let held = region.widened_to_hold(&zone.scene, &all.collect::<Vec<_>>());
        let widened = held != *region;
        let region = held;
        let states = region.starts(starts, START_SEED);
        let place = |(place, orbit): &(&f64, &Orbit)| -> Result<Integrity, ZoneError> {
            let (certainty, radius) =
                Establishment::with_ball_radius_of_starts(orbit, &region, &states, monitor)?;
            Ok(Integrity {
                place: **place,
                frequency: orbit.scene.excitation.frequency,
                velocity: orbit.before_impact_velocity(),
                certainty,
                radius,
            })
        };
        let places: Vec<_> = places.iter().zip(&orbits).collect();
        Ok(Self {
            widened,
            region,
            places: parallel::try_map(&places, place)?,
        })
    }

    /// `count` places of a profile along a hysteresis zone, evenly spaced from grazing (g0) to the fold (s_SN), both included.
    pub fn evenly_spaced_places(count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|place| place as f64 / last).collect()
    }
}
