//! A periodic motion of any regime, stable or not.

use std::cmp::Ordering;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::{ImpactPattern, MapApplication, Monodromy, Regime, StroboscopicMap, TimedImpact};
use crate::tolerance::{NEAR, ROUNDING};
use softstop::{CheckedScene, ImpactEvent, Instant, MotionError, Scene, Trajectory};

/// A periodic motion: after [`Orbit::periods`] drive periods, and no fewer, its state returns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Orbit {
    /// The scene it belongs to.
    pub scene: CheckedScene,
    /// Drive periods after which it repeats: the n of z = p/n.
    pub periods: u64,
    /// Position in m at time 0, that is at drive angle phi.
    pub position: f64,
    /// Velocity in m/s at time 0.
    pub velocity: f64,
    /// Its impacts within the period, in order of time from 0 on.
    pub impacts: Vec<ImpactEvent>,
    /// When complete chatter ends within the period: infinitely many ever weaker impacts, of which
    /// [`Orbit::impacts`] holds those before the summed ones.
    pub rests: Vec<Instant>,
    /// Largest position in m.
    pub max_position: f64,
    /// Jacobian of the map over the period, saltation included.
    pub monodromy: Monodromy,
    /// Integral of damping over mass along the period: det = exp(-integral), times R^2 for each rebound
    /// from a rigid stop, unless the mass turns or sticks under dry friction.
    pub damping_integral: f64,
}

impl Orbit {
    /// Times in s and before-impact velocities in m/s of the orbit's impacts.
    pub(crate) fn timed_impacts(&self) -> Vec<TimedImpact> {
        let clock = self.scene.clock();
        let timed = |touch: &ImpactEvent| (clock.time(touch.instant), touch.before_impact_velocity);
        self.impacts.iter().map(timed).collect()
    }

    /// The orbit through a fixed point of the map over its own period that is already known.
    pub(crate) fn from_map(periods: u64, state: Vector2<f64>, passage: MapApplication) -> Self {
        Self {
            periods,
            position: state.x,
            velocity: state.y,
            max_position: passage.trajectory.max_position(),
            scene: passage.trajectory.scene,
            impacts: passage.impacts,
            rests: passage.rests,
            monodromy: passage.monodromy,
            damping_integral: passage.damping_integral,
        }
    }

    /// The arcs and crossings of the orbit over its period.
    ///
    /// # Errors
    /// [`MotionError`] if it cannot be computed.
    pub(crate) fn trajectory(&self) -> Result<Trajectory, MotionError> {
        StroboscopicMap::new(&self.scene, self.periods).trajectory(self.state())
    }

    /// The regime z = p/n of the orbit. Of complete chatter only the impacts before the summed ones count.
    pub fn regime(&self) -> Regime {
        Regime {
            impacts: self.impacts.len() as u64,
            periods: self.periods,
        }
    }

    /// The order of the orbit's impacts over its drive periods.
    pub fn pattern(&self) -> ImpactPattern {
        let instants: Vec<Instant> = self.impacts.iter().map(|touch| touch.instant).collect();
        let period = self.scene.clock().period();
        ImpactPattern::new(&instants, &self.rests, self.periods, period)
    }

    /// True if the orbit has infinitely many impacts in its period, ever weaker ones that end in rest.
    pub fn chatters(&self) -> bool {
        !self.rests.is_empty()
    }

    /// Before-impact velocity in m/s of the orbit's hardest impact; 0 if it has none.
    pub fn before_impact_velocity(&self) -> f64 {
        self.before_impact_velocities().fold(0.0, f64::max)
    }

    /// Before-impact velocities in m/s of the orbit's impacts, in order of time.
    pub fn before_impact_velocities(&self) -> impl Iterator<Item = f64> + '_ {
        let impacts = self.impacts.iter();
        impacts.map(|touch| touch.before_impact_velocity)
    }

    /// Drive angles of the orbit's impacts in rad, w t + phi with t within the drive period of each and phi as
    /// [`Excitation::reduced_phase`](softstop::Excitation::reduced_phase) has it.
    pub fn impact_angles(&self) -> impl Iterator<Item = f64> + '_ {
        let drive = self.scene.excitation;
        let angle = move |touch: &ImpactEvent| {
            drive.frequency * touch.instant.offset + drive.reduced_phase()
        };
        self.impacts.iter().map(angle)
    }

    /// The orbit's states at drive angle phi, one for each drive period.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn states(&self) -> Result<Vec<Vector2<f64>>, MotionError> {
        if self.periods == 1 {
            return Ok(vec![self.state()]);
        }
        let motion = self.trajectory()?;
        let later = (1..self.periods).map(|periods| motion.at_cycle(periods));
        Ok(std::iter::once(self.state()).chain(later).collect())
    }

    /// The orbit's state at time 0.
    pub fn state(&self) -> Vector2<f64> {
        Vector2::new(self.position, self.velocity)
    }

    /// How far the orbit's state is off after the period, and what rounding alone may leave, in the scene's scales.
    ///
    /// # Errors
    /// [`MotionError`] if the motion cannot be computed.
    pub fn residual(&self) -> Result<(f64, f64), MotionError> {
        let map = StroboscopicMap::new(&self.scene, self.periods);
        let passage = map.apply(self.state())?;
        let scales = self.scene.scales();
        let gap = scales.state(&(passage.end - self.state())).norm();
        Ok((gap, scales.map_rounding(&self.state(), &passage.monodromy)))
    }

    /// Error of the orbit's state by rounding, in the scene's scales: what rounding alone may leave of P(s) - s, as a slow
    /// return amplifies it, whose multiplier is near 1.
    pub(crate) fn state_error(&self) -> f64 {
        state_error(&self.scene, &self.state(), &self.monodromy)
    }

    /// True if the orbit is stable: both multipliers lie inside the unit circle, or on it where it is neutral.
    pub fn is_stable(&self) -> bool {
        self.monodromy.is_stable()
    }

    /// The order of two orbits by their before-impact velocities.
    pub(crate) fn compare_velocity(&self, other: &Self) -> Ordering {
        let [own, other] = [self, other].map(Self::before_impact_velocity);
        own.total_cmp(&other)
    }

    /// True if the impact of this orbit is harder than that of another one, beyond rounding.
    pub(crate) fn is_harder(&self, other: &Self) -> bool {
        self.before_impact_velocity() > (1.0 + ROUNDING) * other.before_impact_velocity()
    }

    /// True if a weak impact makes the orbit's map so steep that it takes states that are near as far apart as the motion is
    /// wide: then rounding of the state tells in that impact.
    pub(super) fn has_weak_impact(&self) -> bool {
        let steepness = self.scene.scales().jacobian(&self.monodromy).norm();
        !self.impacts.is_empty() && self.rests.is_empty() && NEAR * steepness > 1.0
    }

    /// True if the impacts of an orbit are the same after `part` of its drive periods.
    pub(super) fn repeats_after(&self, impacts: &[TimedImpact], part: u64) -> bool {
        let period = self.scene.clock().period();
        let shift = impacts.len() * part as usize / self.periods as usize;
        let span = period * part as f64;
        let speed = self.scene.scales().speed();
        let pairs = impacts.iter().zip(&impacts[shift..]);
        let mut pairs = pairs.map(|(a, b)| ((b.0 - a.0 - span) / period, (b.1 - a.1) / speed));
        let most = ROUNDING * (1.0 + self.velocity.abs() / speed);
        pairs.all(|(time, velocity)| time.hypot(velocity) <= most)
    }
}

/// Error of a fixed point of a map by rounding, in the scene's scales, infinite at a fold.
pub(super) fn state_error(scene: &Scene, state: &Vector2<f64>, monodromy: &Monodromy) -> f64 {
    let scales = scene.scales();
    let response = monodromy.resolvent();
    let response = response.map_or(f64::INFINITY, |it| scales.jacobian(&it).norm());
    scales.map_rounding(state, monodromy) * response
}
