//! The establishment of a stable motion: the share of starts that settle on it, and the largest ball of them.

use serde::{Deserialize, Serialize};

use super::basin_test::BasinTest;
use super::start_balls::StartBalls;
use crate::attractors::{Region, starting_box};
use crate::monitor::Monitor;
use crate::orbit::{Orbit, OrbitError};
use crate::wilson_interval::wilson_interval;
use softstop::Start;

/// How certainly a stable motion establishes itself: the share of starts in a box that settle on it.
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
    /// The establishment of a stable motion, by starts in the box that all commands take starts from ([`starting_box`]).
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if the motion cannot be computed; [`OrbitError::Stopped`].
    pub fn of(orbit: &Orbit, starts: usize, monitor: Monitor<'_>) -> Result<Self, OrbitError> {
        let region = starting_box(&orbit.scene, monitor)?;
        Self::within_region(orbit, &region, starts, monitor)
    }

    /// The establishment of a stable motion, by starts in a region.
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

    /// Whether a condition holds of the establishment of a stable motion in a region, computed no farther than needed to tell.
    /// The condition must go on to hold as more starts lead to the motion.
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

    /// The establishment of a stable motion by starts in a region, and the radius of the largest ball of starts about the motion
    /// that leads to it alone ([`Integrity::radius`](super::Integrity::radius)).
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

    /// The establishment of a stable motion by given starts in a region, and the radius of the largest ball of starts about the
    /// motion, as [`Establishment::with_ball_radius`] computes them.
    pub(super) fn with_ball_radius_of_starts(
        orbit: &Orbit,
        region: &Region,
        states: &[Start],
        monitor: Monitor<'_>,
    ) -> Result<(Self, f64), OrbitError> {
        let basin_test = BasinTest::of(orbit)?;
        let reached = basin_test.test_starts(states, monitor)?;
        let certainty = Self::from_reached(&reached, region);
        let ball = StartBalls::new(orbit, region);
        let mut radius = ball.nearest_lost_distance(states, &reached, ball.edge_distance(region));
        // Smaller balls count as none.
        while radius > 1e-4 {
            let filling = ball.starts_in_ball(radius, (states.len() / 8).max(64));
            let reached = basin_test.test_starts(&filling, monitor)?;
            let smaller = ball.nearest_lost_distance(&filling, &reached, radius);
            if smaller == radius {
                return Ok((certainty, radius));
            }
            radius = smaller;
        }
        Ok((certainty, 0.0))
    }

    /// The establishment of a motion from whether each of the starts in a region has reached it.
    fn from_reached(reached: &[bool], region: &Region) -> Self {
        let own = reached.iter().filter(|reached| **reached).count();
        Self::of_count(own, reached.len(), region)
    }

    /// The establishment of a motion that `own` of the starts in a region have reached.
    fn of_count(own: usize, starts: usize, region: &Region) -> Self {
        Self {
            share: own as f64 / starts.max(1) as f64,
            interval: wilson_interval(own, starts),
            starts,
            region: *region,
        }
    }
}

/// Seed of the quasi-random starts by which shares of a box are counted.
pub(super) const START_SEED: u64 = 0;
