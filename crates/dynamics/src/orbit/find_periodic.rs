//! Finding the periodic orbit near a state, or near given impacts, by Newton's method.

use nalgebra::Vector2;

use super::impact_guesses::guess_impacts;
use super::multi_segment_shooting::MultiSegmentShooting;
use super::periodic_orbit::state_error;
use super::{Orbit, OrbitError, StroboscopicMap, TimedImpact, find_fixed_point};
use crate::tolerance::{NEAR, ROUNDING, ROUNDING_SHARE};
use softstop::{CheckedScene, Scene};

/// Impacts up to which orbits are sought from impact to impact, which costs their cube: more are chatter.
const MAX_SHOOTING_IMPACTS: usize = 128;

impl Orbit {
    /// The z = 1 orbit, stable or not, that Newton's method reaches from a state near it.
    ///
    /// # Errors
    /// [`OrbitError`] if Newton's method does not settle or settles on another regime.
    pub fn find_near(scene: &Scene, state: Vector2<f64>) -> Result<Self, OrbitError> {
        let orbit = Self::find_with_impacts(scene, state, 1, 1)?;
        match orbit.impacts[..] {
            [_] => Ok(orbit),
            _ => Err(OrbitError::OtherRegime {
                impacts: orbit.impacts.len(),
            }),
        }
    }

    /// The periodic orbit, stable or not and of whatever impacts, that Newton's method reaches from a state
    /// near it. Its own period may be a part of `periods`.
    ///
    /// Newton's method on the map comes first. Where that fails, as it does near grazing, or an impact is weak,
    /// it goes from impact to impact ([`Orbit::find_by_impacts`]).
    ///
    /// # Errors
    /// [`OrbitError`] if Newton's method does not settle or a motion cannot be computed.
    pub fn find_periodic(
        scene: &Scene,
        state: Vector2<f64>,
        periods: u64,
    ) -> Result<Self, OrbitError> {
        Self::find_with_impacts(scene, state, periods.max(1), MAX_SHOOTING_IMPACTS)
    }

    /// The periodic orbit near a state, sought by the stroboscopic map and, where that leads to none, by shooting from impact to
    /// impact with up to `most` impacts.
    fn find_with_impacts(
        scene: &Scene,
        state: Vector2<f64>,
        periods: u64,
        most: usize,
    ) -> Result<Self, OrbitError> {
        let scene = &scene.check()?;
        match Self::find_on_map(scene, state, periods) {
            Ok(orbit) if orbit.has_weak_impact() && orbit.impacts.len() <= MAX_SHOOTING_IMPACTS => {
                let impacts: Vec<TimedImpact> = orbit.timed_impacts();
                Ok(Self::find_by_impacts(scene, orbit.periods, &impacts).unwrap_or(orbit))
            }
            Ok(orbit) => Ok(orbit),
            Err(error) => Self::find_by_guesses(scene, state, periods, most).ok_or(error),
        }
    }

    /// The periodic orbit near a state, from impact to impact, from guesses of its impacts.
    pub(super) fn find_by_guesses(
        scene: &CheckedScene,
        state: Vector2<f64>,
        periods: u64,
        most: usize,
    ) -> Option<Self> {
        guess_impacts(scene, state, periods)
            .ok()?
            .iter()
            .filter(|impacts| impacts.len() <= most)
            .find_map(|impacts| Self::find_by_impacts(scene, periods, impacts).ok())
    }

    /// The orbit that Newton's method on the map leads to. Of two orbits that rounding does not tell apart, the stable
    /// one: near a flip the fixed point of twice the period is known far less well than that of the period.
    fn find_on_map(
        scene: &CheckedScene,
        state: Vector2<f64>,
        periods: u64,
    ) -> Result<Self, OrbitError> {
        let (map, scales) = (StroboscopicMap::new(scene, periods), scene.scales());
        let (state, passage) = find_fixed_point(&map, state)?;
        for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
            let size = |state: &Vector2<f64>| scales.state(state).norm();
            let unit = 1.0 + size(&state);
            if size(&(passage.trajectory.at_cycle(part) - state)) > NEAR * unit {
                continue;
            }
            let shorter = StroboscopicMap::new(scene, part);
            let Ok((own, once)) = find_fixed_point(&shorter, state) else {
                continue;
            };
            let apart = size(&(own - state));
            let stays = once.monodromy.is_stable() || !passage.monodromy.is_stable();
            let error = state_error(scene, &state, &passage.monodromy) / ROUNDING_SHARE;
            if apart <= ROUNDING * unit || apart <= error && stays {
                return Ok(Self::from_map(part, own, once));
            }
        }
        Ok(Self::from_map(periods, state, passage))
    }

    /// The periodic orbit, stable or not, that Newton's method from impact to impact reaches from times in s
    /// and before-impact velocities in m/s of all impacts near its own. It is regular down to grazing,
    /// where the map is not. No impact may come to rest.
    ///
    /// # Errors
    /// [`OrbitError`] if it does not settle, or on impacts between which there are others.
    pub fn find_by_impacts(
        scene: &CheckedScene,
        periods: u64,
        impacts: &[(f64, f64)],
    ) -> Result<Self, OrbitError> {
        let none = OrbitError::OtherRegime { impacts: 0 };
        if impacts.is_empty() {
            return Err(none);
        }
        let shooting = MultiSegmentShooting::new(scene, periods.max(1)).ok_or(none)?;
        let guess = shooting.evaluate_guess(impacts).ok_or(OrbitError::LOST)?;
        let orbit = shooting.solve(guess, &[])?;
        let all = orbit.timed_impacts();
        for part in (1..periods).filter(|part| periods.is_multiple_of(*part)) {
            let share = all.len() as u64 * part;
            if share.is_multiple_of(periods) && orbit.repeats_after(&all, part) {
                let first = &all[..(share / periods) as usize];
                return Self::find_by_impacts(scene, part, first);
            }
        }
        Ok(orbit)
    }
}
