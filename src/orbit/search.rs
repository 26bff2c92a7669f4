//! The z = 1 motion found from scratch.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::{Orbit, OrbitError, StroboscopicMap};
use crate::scene::Scene;

/// Speeds of the starts, in units of w times the length of the motion.
const SPEEDS: [f64; 9] = [0.3, 0.6, 0.9, 1.0, 1.1, 1.25, 1.6, 2.0, 3.0];
/// Directions of the starts in the plane (w x, x').
const DIRECTIONS: usize = 16;
/// Drive periods for which a start may settle before Newton's method takes over: few, which finds
/// motions with small basins, and more; and far more if neither finds any.
const SETTLING: [&[u64]; 2] = [&[2, 12], &[60]];

/// The stable z = 1 motion of a scene with the highest before-impact velocity, found from starts
/// spread over the plane of states.
///
/// # Errors
/// [`OrbitError::NotFound`] if no start leads to one; [`OrbitError::Motion`] if the scene is
/// invalid.
pub fn find(scene: &Scene) -> Result<Orbit, OrbitError> {
    let map = StroboscopicMap::new(scene, 1)?;
    for settling in SETTLING {
        let best = starts(scene)
            .flat_map(|start| settling.iter().map(move |periods| (start, *periods)))
            .filter_map(|(start, periods)| settle(scene, &map, start, periods))
            .max_by(|a, b| {
                a.before_impact_velocity()
                    .total_cmp(&b.before_impact_velocity())
            });
        if let Some(orbit) = best {
            return Ok(orbit);
        }
    }
    Err(OrbitError::NotFound {
        frequency: scene.excitation.frequency,
        clearance: scene.clearance,
    })
}

fn settle(
    scene: &Scene,
    map: &StroboscopicMap,
    start: Vector2<f64>,
    periods: u64,
) -> Option<Orbit> {
    let state = map.iterate(start, periods).ok()?;
    let orbit = Orbit::near(scene, state).ok()?;
    orbit.is_stable().then_some(orbit)
}

/// Starts on circles in (w x, x') about the origin.
fn starts(scene: &Scene) -> impl Iterator<Item = Vector2<f64>> + use<> {
    let w = scene.excitation.frequency;
    let drive = scene.excitation.amplitude / scene.mass / (w * w);
    let length = scene.clearance.abs().max(drive);
    SPEEDS.into_iter().flat_map(move |speed| {
        (0..DIRECTIONS).map(move |k| {
            let angle = TAU * k as f64 / DIRECTIONS as f64;
            speed * length * Vector2::new(angle.cos(), w * angle.sin())
        })
    })
}
