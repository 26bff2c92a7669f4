//! Guesses of the impacts of a periodic orbit from the motion from a state near it.

use nalgebra::Vector2;

use super::{StroboscopicMap, TimedImpact};
use crate::tolerance::NEAR_GRAZING;
use softstop::internals::turning_points;
use softstop::{CheckedScene, MotionError, PhaseKind, Trajectory};

/// Guesses of the impacts of an orbit: those of the motion from a state, with its nearest miss, less the weakest.
pub(super) fn guess_impacts(
    scene: &CheckedScene,
    state: Vector2<f64>,
    periods: u64,
) -> Result<Vec<Vec<TimedImpact>>, MotionError> {
    let motion = StroboscopicMap::new(scene, periods).trajectory(state)?;
    let impacts: Vec<TimedImpact> = motion.timed_impacts().collect();
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

/// The nearest miss of the clearance: the distance d by which a turn misses it, in m, with the time in s and the speed in m/s of an
/// impact at a clearance 2 d smaller.
fn nearest_miss(motion: &Trajectory, clearance: f64) -> Option<(f64, TimedImpact)> {
    let free = motion
        .arc_views()
        .filter(|(arc, _)| arc.kind == PhaseKind::Free);
    let misses = free.flat_map(|(arc, elapsed)| {
        let back = turning_points(arc.course, elapsed, true).filter(|turn| turn.back);
        back.map(move |turn| {
            let forcing = arc.course.flow.amplitude * arc.drive(turn.elapsed).cos;
            let acceleration = arc.course.flow.acceleration(turn.position, 0.0, forcing);
            let depth = clearance - turn.position;
            let speed = (2.0 * acceleration.abs() * depth.max(0.0)).sqrt();
            let at = arc.clock.after(arc.start, turn.elapsed);
            (depth, (arc.clock.time(at), speed))
        })
    });
    misses.min_by(|a, b| a.0.total_cmp(&b.0))
}
