//! The map over the drive periods of an orbit, with all that a continuation needs to know.

use std::sync::Arc as Shared;

use nalgebra::{DVector, Vector2};

use super::crossing_counts::{CountedCrossings, CrossingCounts};
use super::switching_surface::NearGrazing;
use crate::orbit::Monodromy;
use crate::record_trajectory::record_trajectory;
use crate::tolerance::ROUNDING;
use softstop::internals::{FrequencySensitivity, Motion};
use softstop::{
    Arc, CheckedScene, Clock, Effort, Instant, KeptArc, MotionError, Observer, Scene, Trajectory,
};

/// The period map of a state: its image after some drive periods from time 0, derivatives, and what happens on the way.
#[derive(Debug, Clone)]
pub(crate) struct PeriodMap {
    /// The unknowns that it belongs to.
    pub place: DVector<f64>,
    /// Where the map begins: the state, or the surface of a rigid stop for a state beyond it.
    pub start: Vector2<f64>,
    /// Exact Jacobian of the map.
    pub monodromy: Monodromy,
    /// Exact derivative of the image by the drive's frequency in m s/rad and m/rad, where a closed form has one.
    pub by_frequency: Option<Vector2<f64>>,
    /// Before-impact velocities in m/s, in order of time.
    pub impacts: Vec<f64>,
    /// How often the motion crosses what.
    pub counts: CrossingCounts,
    /// The slowest crossing of a surface.
    pub slowest: Option<NearGrazing>,
    /// Drive periods between time 0 and the nearest crossing before or after it; 0 if the mass is held at time 0.
    pub margin: f64,
    /// Arcs and crossings of the motion.
    pub trajectory: Shared<Trajectory>,
}

impl PeriodMap {
    /// The period map of a scene from unknowns and the state that they are; with its derivative by
    /// the drive's frequency if that is wanted.
    pub fn from_state(
        scene: CheckedScene,
        periods: u64,
        (place, state): (&DVector<f64>, Vector2<f64>),
        by_frequency: bool,
    ) -> Result<Self, MotionError> {
        let start = clamp_to_walls(&scene, state);
        let end = Clock::at_cycle(periods);
        let trajectory = record_trajectory(&scene, start, |motion, kept| {
            advance_over_periods(motion, end, kept)
        })?;
        let mut sensitivity = FrequencySensitivity::default();
        if by_frequency {
            trajectory.replay(&mut sensitivity);
        } else {
            trajectory.replay(&mut sensitivity.tangent);
        }
        let time = trajectory.clock.time(end);
        let change = |(arc, elapsed): (Arc<'_>, f64)| {
            sensitivity.at_drive_angle((&arc, elapsed), trajectory.end, time)
        };
        let by_frequency = by_frequency.then(|| change(trajectory.arc_views().last()?));
        let (lowest, highest) = scene.reach();
        let at_wall = start.x == lowest || start.x == highest;
        let margin = crossing_margin(&trajectory, periods);
        let crossings = CountedCrossings::of_motion(&scene, &trajectory);
        Ok(Self {
            place: place.clone(),
            start,
            // Whatever comes to rest at a rigid stop goes on alike.
            monodromy: match at_wall && margin == 0.0 {
                true => Monodromy::ZERO,
                false => Monodromy::from(&sensitivity.tangent),
            },
            by_frequency: by_frequency.flatten(),
            impacts: crossings.impact_velocities().collect(),
            counts: crossings.count_by_kind(&scene),
            slowest: crossings.slowest_crossing(),
            margin,
            trajectory: trajectory.into(),
        })
    }
}

/// Drive periods between time 0 and the nearest crossing before or after it; 0 if the mass is held at time 0.
fn crossing_margin(trajectory: &Trajectory, periods: u64) -> f64 {
    let begins = |arc: &&KeptArc| arc.start == Clock::at_cycle(0);
    let mut first = trajectory.arcs.iter().take_while(begins);
    if first.any(|arc| arc.course.is_held()) {
        return 0.0;
    }
    let period = trajectory.clock.period();
    let times = trajectory.crossings();
    let times = times.map(|it| it.instant.cycles + it.instant.offset / period);
    times.fold(f64::INFINITY, |margin, time| {
        margin.min(time).min(periods as f64 - time)
    })
}

/// The instant after half of so many drive periods of a scene.
pub(super) fn half_way_instant(scene: &Scene, periods: u64) -> Instant {
    Instant {
        offset: 0.5 * (periods % 2) as f64 * scene.period(),
        ..Clock::at_cycle(periods / 2)
    }
}

/// The state of a motion of a scene so many drive periods after one at time 0.
pub(super) fn state_after_periods(
    scene: &CheckedScene,
    state: Vector2<f64>,
    periods: f64,
) -> Result<Vector2<f64>, MotionError> {
    let clock = scene.clock();
    let mut motion = scene.motion(state.into())?;
    let end = clock.instant(periods * clock.period());
    advance_over_periods(&mut motion, end, &mut ())?;
    Ok(motion.state().into())
}

/// A state, moved to the surface of a rigid stop from beyond or from rest near it, so that the map stays continuous.
pub(crate) fn clamp_to_walls(scene: &Scene, state: Vector2<f64>) -> Vector2<f64> {
    let (lowest, highest) = scene.reach();
    let scales = scene.scales();
    let is_near = |wall: &f64| (wall - state.x).abs() < ROUNDING * scales.length;
    if let Some(wall) = [highest, lowest].into_iter().find(is_near)
        && state.y.abs() < ROUNDING * scales.speed()
    {
        return Vector2::new(wall, 0.0);
    }
    Vector2::new(state.x.min(highest).max(lowest), state.y)
}

/// Work that an orbit may cost per drive period, in scan windows: 32,000 crossings. A mass that bounces more often is
/// on its way to rest, and its motion is no orbit that could be followed.
const MAX_PERIOD_WORK: u64 = 1 << 21;

/// Carries a motion on to an instant, by a drive period at most.
///
/// # Errors
/// [`MotionError`] if it cannot be computed.
pub fn advance_in_period(
    motion: &mut Motion,
    until: Instant,
    observer: &mut dyn Observer,
) -> Result<(), MotionError> {
    let mut effort = Effort::windows(MAX_PERIOD_WORK);
    if motion
        .watch(until, &mut (observer, &mut effort))?
        .is_continue()
    {
        return Ok(());
    }
    Err(MotionError::Stalled {
        time: motion.clock().time(motion.now()),
        position: motion.state().position,
    })
}

/// Carries a motion from time 0 on, one drive period after the other, and by what is left of one to the end.
pub(super) fn advance_over_periods(
    motion: &mut Motion,
    end: Instant,
    observer: &mut dyn Observer,
) -> Result<(), MotionError> {
    for cycle in 1..=end.cycles as u64 {
        advance_in_period(motion, Clock::at_cycle(cycle), observer)?;
    }
    advance_in_period(motion, end, observer)
}
