//! Integrity along the hysteresis zone: how the basin of z = 1 is eaten away from g0 to s_SN (Thompson 1989; Rega and
//! Lenci 2005).

use std::f64::consts::TAU;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::basin_test::BasinTest;
use crate::attractors::region::evenly_spread_point;
use crate::attractors::{Region, end_states, starting_box};
use crate::monitor::Monitor;
use crate::orbit::{Orbit, OrbitError};
use crate::parallel;
use crate::wilson_interval::wilson_interval;
use crate::zone::{Zone, ZoneError};
use softstop::{Scene, Start};

/// How certainly a motion establishes itself: the share of starts in a box that settle on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Establishment {
    /// The share.
    pub share: f64,
    /// Wilson's 95 % interval of it, as if the starts were drawn at random; they lie more evenly, so that it is wide.
    pub interval: [f64; 2],
    /// How many starts there were.
    pub starts: usize,
    /// The box in which they lie, at drive angle phi.
    pub region: Region,
}

impl Establishment {
    /// The establishment of a stable motion, in the box that all commands take starts from ([`starting_box`]).
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::Stopped`].
    pub fn of(orbit: &Orbit, starts: usize, monitor: Monitor<'_>) -> Result<Self, OrbitError> {
        let region = starting_box(&orbit.scene, monitor)?;
        Self::within_region(orbit, &region, starts, monitor)
    }

    /// The establishment of a stable motion, from starts in a region.
    ///
    /// # Errors
    /// As [`Establishment::of`].
    pub fn within_region(
        orbit: &Orbit,
        region: &Region,
        starts: usize,
        monitor: Monitor<'_>,
    ) -> Result<Self, OrbitError> {
        let states = region.starts(starts, START_SEED);
        let reached = BasinTest::of(orbit)?.test_starts(&states, monitor)?;
        Ok(Self::from_reached(&reached, region))
    }

    /// Whether a condition holds of the establishment of a stable motion in a region, as of
    /// [`Establishment::within_region`]. The condition must go on to hold as more starts lead to the motion.
    ///
    /// # Errors
    /// As [`Establishment::of`].
    pub fn is_enough_within_region(
        orbit: &Orbit,
        region: &Region,
        starts: usize,
        is_enough: impl Fn(&Self) -> bool,
        monitor: Monitor<'_>,
    ) -> Result<bool, OrbitError> {
        let with = |own: usize| Self::of_count(own, starts, region);
        let Some(needed) = (0..=starts).find(|own| is_enough(&with(*own))) else {
            return Ok(false);
        };
        let states = region.starts(starts, START_SEED);
        BasinTest::of(orbit)?.is_reached_from(&states, needed, monitor)
    }

    /// The establishment of a stable motion in a region as by [`Establishment::within_region`], and the radius of the
    /// largest ball of starts about the motion that leads to it alone ([`Integrity::radius`]).
    ///
    /// # Errors
    /// As [`Establishment::of`].
    pub fn with_ball_radius(
        orbit: &Orbit,
        region: &Region,
        starts: usize,
        monitor: Monitor<'_>,
    ) -> Result<(Self, f64), OrbitError> {
        Self::with_ball_radius_of_starts(orbit, region, &region.starts(starts, START_SEED), monitor)
    }

    /// [`Establishment::with_ball_radius`] of starts that are made already.
    fn with_ball_radius_of_starts(
        orbit: &Orbit,
        region: &Region,
        states: &[Start],
        monitor: Monitor<'_>,
    ) -> Result<(Self, f64), OrbitError> {
        let basin_test = BasinTest::of(orbit)?;
        let reached = basin_test.test_starts(states, monitor)?;
        let certainty = Self::from_reached(&reached, region);
        let ball = StateBall::new(orbit, region);
        let mut radius = ball.nearest_lost_distance(states, &reached, ball.edge_distance(region));
        while radius > MIN_BALL_RADIUS {
            let filling =
                ball.starts_in_ball(radius, (states.len() / FILL_DIVISOR).max(MIN_FILL_STARTS));
            let reached = basin_test.test_starts(&filling, monitor)?;
            let smaller = ball.nearest_lost_distance(&filling, &reached, radius);
            if smaller == radius {
                return Ok((certainty, radius));
            }
            radius = smaller;
        }
        Ok((certainty, 0.0))
    }

    /// The establishment of a motion from which of the starts in a region have reached it.
    fn from_reached(reached: &[bool], region: &Region) -> Self {
        let own = reached.iter().filter(|reached| **reached).count();
        Self::of_count(own, reached.len(), region)
    }

    /// The establishment of a motion that so many of the starts in a region have reached.
    fn of_count(own: usize, starts: usize, region: &Region) -> Self {
        Self {
            share: own as f64 / starts.max(1) as f64,
            interval: wilson_interval(own, starts),
            starts,
            region: *region,
        }
    }
}

/// Seed of the quasi-random starts, which shifts them.
const START_SEED: u64 = 0;
/// Places of a zone that its box of starts is made for.
const BOX_PLACES: [f64; 3] = [0.0, 0.5, 0.99];
/// Divisor of the number of starts for those with which a ball is filled anew.
const FILL_DIVISOR: usize = 8;
/// Least number of starts with which a ball is filled.
const MIN_FILL_STARTS: usize = 64;
/// Radius, in halves of the box, below which a ball counts as none.
const MIN_BALL_RADIUS: f64 = 1e-4;

/// One box of starts for a whole hysteresis zone: that of the machine at its own frequency ([`starting_box`]), and whether
/// it is wider, as motions that are found at the ends of the zone or in the middle lie outside that.
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
    for place in BOX_PLACES {
        all.extend(end_states(&zone.scene_at(place), monitor)?);
    }
    let region = own.widened_to_hold(scene, &all);
    Ok((region, region != own))
}

/// The integrity of z = 1 at one place of the zone.
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
    /// Radius of the largest ball about the motion's state at drive angle phi that lies in the box and all of whose
    /// starts lead to it: the local integrity measure. In units of half of each axis of the box, so that on the plane
    /// of states it is an ellipse. The ball is filled with starts until all lead there.
    pub radius: f64,
}

/// The integrity of z = 1 along its hysteresis zone.
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
    /// The profile at places s in [0, 1] of a zone, with so many starts at each in one box, which is made wider if a motion
    /// lies outside it. At s_SN itself the motion attracts from one side alone: what it still attracts has a share, but no
    /// ball lies in it. The same for any number of threads.
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

    /// So many places of a zone, evenly spaced from g0 to s_SN, both of them included.
    pub fn evenly_spaced_places(count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|place| place as f64 / last).collect()
    }
}

/// Balls of starts about the state of an orbit, in units of half of each axis of a box.
pub(super) struct StateBall {
    centre: Vector2<f64>,
    half: Vector2<f64>,
}

impl StateBall {
    /// Balls about an orbit's state, measured by a box of starts.
    pub fn new(orbit: &Orbit, region: &Region) -> Self {
        let half = [region.position, region.velocity].map(|[low, high]| 0.5 * (high - low));
        Self {
            centre: orbit.state(),
            half: half.into(),
        }
    }

    /// Distance from the centre of the balls to the nearest edge of the box; 0 if it is not in it.
    pub fn edge_distance(&self, region: &Region) -> f64 {
        let sides = [region.position, region.velocity].into_iter().enumerate();
        let sides = sides.flat_map(|(axis, [low, high])| {
            [self.centre[axis] - low, high - self.centre[axis]].map(|way| way / self.half[axis])
        });
        sides.fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Distance from the centre to the nearest start that does not lead to the motion, if that is nearer than `radius`.
    pub fn nearest_lost_distance(&self, starts: &[Start], reached: &[bool], radius: f64) -> f64 {
        let lost = starts.iter().zip(reached).filter(|(_, reached)| !**reached);
        let ways = lost.map(|(start, _)| {
            let way = Vector2::new(start.position, start.velocity) - self.centre;
            way.component_div(&self.half).norm()
        });
        ways.fold(radius, f64::min)
    }

    /// So many starts that fill a ball of a radius evenly.
    pub fn starts_in_ball(&self, radius: f64, count: usize) -> Vec<Start> {
        let start = |index| {
            let [area, turn] = evenly_spread_point([0.5; 2], index);
            let (sin, cos) = (TAU * turn).sin_cos();
            let way = radius * area.sqrt() * Vector2::new(cos, sin);
            Start::from(self.centre + way.component_mul(&self.half))
        };
        (0..count).map(start).collect()
    }
}
