//! A periodic motion of any regime, stable or not, and guesses of the impacts that one near a state may have.

use std::cmp::Ordering;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::stroboscopic_map::find_fixed_point;
use super::{ImpactPattern, MapApplication, Monodromy, OrbitError, Regime, StroboscopicMap};
use crate::tolerance::{NEAR, NEAR_GRAZING, ROUNDING, ROUNDING_SHARE};
use softstop::internals::turning_points;
use softstop::{CheckedScene, ImpactEvent, Instant, MotionError, PhaseKind, Scene, Trajectory};

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

    /// The periodic orbit near a state; from impact to impact it is sought with no more than `most` impacts.
    fn find_with_impacts(
        scene: &Scene,
        state: Vector2<f64>,
        periods: u64,
        most: usize,
    ) -> Result<Self, OrbitError> {
        let scene = &scene.check()?;
        match Self::find_on_map(scene, state, periods) {
            Ok(orbit) if orbit.has_weak_impact() && orbit.impacts.len() <= MAX_SHOOTING_IMPACTS => {
                let impacts: Vec<(f64, f64)> = orbit.timed_impacts();
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

    /// Times in s and before-impact velocities in m/s of the orbit's impacts.
    pub(crate) fn timed_impacts(&self) -> Vec<(f64, f64)> {
        let clock = self.scene.clock();
        let timed = |touch: &ImpactEvent| (clock.time(touch.instant), touch.before_impact_velocity);
        self.impacts.iter().map(timed).collect()
    }

    /// True if a weak impact makes the orbit's map so steep that it takes states that are near as far apart as the motion is
    /// wide: then rounding of the state tells in that impact.
    fn has_weak_impact(&self) -> bool {
        let steepness = self.scene.scales().jacobian(&self.monodromy).norm();
        !self.impacts.is_empty() && self.rests.is_empty() && NEAR * steepness > 1.0
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
}

/// Error of a fixed point of a map by rounding, in the scene's scales, infinite at a fold.
fn state_error(scene: &Scene, state: &Vector2<f64>, monodromy: &Monodromy) -> f64 {
    let scales = scene.scales();
    let response = monodromy.resolvent();
    let response = response.map_or(f64::INFINITY, |it| scales.jacobian(&it).norm());
    scales.map_rounding(state, monodromy) * response
}

/// Time in s and before-impact velocity in m/s of each impact.
pub(super) type TimedImpacts = Vec<(f64, f64)>;

/// Guesses of the impacts of an orbit: those of the motion from a state, with its nearest miss, less the weakest.
pub(super) fn guess_impacts(
    scene: &CheckedScene,
    state: Vector2<f64>,
    periods: u64,
) -> Result<Vec<TimedImpacts>, MotionError> {
    let motion = StroboscopicMap::new(scene, periods).trajectory(state)?;
    let impacts: TimedImpacts = motion.timed_impacts().collect();
    let mut guesses = Vec::new();
    if !impacts.is_empty() {
        guesses.push(impacts.clone());
    }
    if let Some((depth, miss)) = nearest_miss(&motion, scene.clearance)
        && depth <= NEAR_GRAZING * (scene.clearance.abs() + depth)
    {
        let at = impacts.partition_point(|impact| impact.0 < miss.0);
        let mut more = impacts.clone();
        more.insert(at, miss);
        guesses.push(more);
    }
    if impacts.len() > 1 {
        let weakest = (0..impacts.len()).min_by(|a, b| impacts[*a].1.total_cmp(&impacts[*b].1));
        let mut fewer = impacts;
        fewer.remove(weakest.unwrap_or(0));
        guesses.push(fewer);
    }
    Ok(guesses)
}

/// The nearest miss of the face: the distance d by which a turn misses it, in m, with the time in s and the speed in m/s of an
/// impact on a face that stood 2 d nearer.
fn nearest_miss(motion: &Trajectory, face: f64) -> Option<(f64, (f64, f64))> {
    let free = motion
        .observed_arcs()
        .filter(|(arc, _)| arc.kind == PhaseKind::Free);
    let misses = free.flat_map(|(arc, elapsed)| {
        let back = turning_points(arc.course, elapsed, true).filter(|turn| turn.back);
        back.map(move |turn| {
            let forcing = arc.course.flow.amplitude * arc.drive(turn.elapsed).cos;
            let acceleration = arc.course.flow.acceleration(turn.position, 0.0, forcing);
            let depth = face - turn.position;
            let speed = (2.0 * acceleration.abs() * depth.max(0.0)).sqrt();
            let at = arc.clock.after(arc.start, turn.elapsed);
            (depth, (arc.clock.time(at), speed))
        })
    });
    misses.min_by(|a, b| a.0.total_cmp(&b.0))
}
