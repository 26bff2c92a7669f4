//! A search for z = 1 orbits from guessed impacts by Newton's method, known ones deflated.

use super::deflation::DEFLATION_WIDTH;
use super::multi_segment_shooting::{MultiSegmentShooting, ShootingFailure};
use super::{Orbit, OrbitError, TimedImpact};
use crate::monitor::Monitor;
use crate::tolerance::{NEAR, SAME};
use softstop::CheckedScene;

/// Most z = 1 orbits at one frequency: where friction holds the mass at any of many places, there is no end to them.
const MAX_SINGLE_IMPACT_ORBITS: usize = 100;

/// A search for z = 1 orbits, and what its guesses led to.
pub(super) struct SingleImpactSearch {
    pub(super) shooting: MultiSegmentShooting,
    pub(super) period: f64,
    /// The motion's speed in m/s.
    unit: f64,
    /// The orbits that were found.
    pub(super) found: Vec<Orbit>,
    /// Impacts, time in s and velocity in m/s, of near misses.
    pub(super) missed: Vec<TimedImpact>,
}

impl SingleImpactSearch {
    /// A search for z = 1 orbits of a scene; none if the scene has no stop.
    pub(super) fn new(scene: &CheckedScene) -> Option<Self> {
        Some(Self {
            shooting: MultiSegmentShooting::new(scene, 1)?,
            period: scene.clock().period(),
            unit: scene.motion_scales().speed(),
            found: Vec::new(),
            missed: Vec::new(),
        })
    }

    /// Keeps the orbit that Newton's method reaches from a guessed impact, then those that it reaches from there with the known
    /// ones deflated, until none is new; keeps near misses, too.
    pub(super) fn collect_from_guess(
        &mut self,
        guess: TimedImpact,
        monitor: Monitor<'_>,
    ) -> Result<(), OrbitError> {
        OrbitError::ask_monitor(monitor)?;
        let (period, impacts) = (self.period, self.found_impacts());
        let known = |at: &[f64]| {
            let near = |other| impact_distance(other, (at[0], at[1]), period) < NEAR;
            impacts.iter().copied().any(near)
        };
        let Some(guess) = self.shooting.evaluate_guess(&[guess]) else {
            return Ok(());
        };
        let settled = self.shooting.solve_unless_known(guess.clone(), known, &[]);
        let mut next = settled.map_err(|failed| self.keep_near_miss(failed));
        while let Ok(orbit) = next {
            OrbitError::ask_monitor(monitor)?;
            if orbit.is_some_and(|orbit| !self.keep_if_new(orbit)) {
                break;
            }
            let apart = self.shooting.solve(guess.clone(), &self.found_impacts());
            next = apart.map(Some).map_err(drop);
        }
        Ok(())
    }

    /// Keeps an orbit that does more than graze and is not known; false if it does not, or there are too many.
    pub(super) fn keep_if_new(&mut self, orbit: Orbit) -> bool {
        let distance =
            |known| impact_distance(single_impact(known), single_impact(&orbit), self.period);
        let is_known = self.found.iter().any(|known| distance(known) < SAME);
        let is_kept =
            self.has_impact(&orbit) && !is_known && self.found.len() < MAX_SINGLE_IMPACT_ORBITS;
        if is_kept {
            self.found.push(orbit);
        }
        is_kept
    }

    /// True if the impact of an orbit is more than grazing to rounding.
    pub(super) fn has_impact(&self, orbit: &Orbit) -> bool {
        orbit.before_impact_velocity() > SAME * self.unit
    }

    /// The impacts, times in s and velocities in m/s, of the orbits found so far.
    pub(super) fn found_impacts(&self) -> Vec<TimedImpact> {
        self.found.iter().map(single_impact).collect()
    }

    /// Keeps the impact of a search that settled nowhere, if it is a near miss, by less than the velocity and the motion's
    /// speed, and a new one.
    fn keep_near_miss(&mut self, failed: ShootingFailure) {
        let ShootingFailure {
            impact, residual, ..
        } = failed;
        let told =
            |other: &TimedImpact| impact_distance(*other, impact, self.period) < DEFLATION_WIDTH;
        if residual < (impact.1 / self.unit).max(1.0) && !self.missed.iter().any(told) {
            self.missed.push(impact);
        }
    }
}

/// Time in s and before-impact velocity in m/s of the impact of a z = 1 orbit.
fn single_impact(orbit: &Orbit) -> TimedImpact {
    orbit.timed_impacts()[0]
}

/// Distance of two impacts, each a time in s and a velocity in m/s: a share of the period, or of the velocity.
pub(super) fn impact_distance((t, v): TimedImpact, (u, w): TimedImpact, period: f64) -> f64 {
    time_distance(t, u, period).max((v - w).abs() / v.max(w))
}

/// Distance of the times of two impacts around the period, as a share of it.
pub(super) fn time_distance(one: f64, other: f64, period: f64) -> f64 {
    let between = (one - other).rem_euclid(period);
    between.min(period - between) / period
}
