//! The z = 1 motion found from scratch.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::{Orbit, OrbitError};
use softstop::internals::Scales;
use softstop::{Scene, Start};
use softstop_lanes::{Job, Machine, Watch};

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
    let machines = [Machine::new(scene)?];
    for settling in SETTLING {
        let best = settled(&machines, starts(scene), settling)
            .into_iter()
            .filter_map(|state| Orbit::near(scene, state).ok())
            .filter(Orbit::is_stable)
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

/// Where the starts have come to after each of these numbers of periods, in ascending order; those that lead
/// nowhere are left out.
fn settled(
    machines: &[Machine],
    starts: impl Iterator<Item = Start>,
    periods: &[u64],
) -> Vec<Vector2<f64>> {
    let last = periods.last().copied().unwrap_or(0);
    let jobs: Vec<Job> = starts
        .map(|start| Job {
            machine: 0,
            start,
            periods: last,
        })
        .collect();
    let mut stages = Stages {
        periods,
        states: Vec::new(),
    };
    softstop_lanes::run(machines, &jobs, &mut stages);
    stages.states
}

/// Keeps the states after some numbers of periods.
struct Stages<'a> {
    periods: &'a [u64],
    states: Vec<Vector2<f64>>,
}

impl Watch for Stages<'_> {
    const PERIODS: bool = true;

    fn period(&mut self, _: usize, cycle: u64, state: Start) {
        if self.periods.contains(&cycle) {
            self.states
                .push(Vector2::new(state.position, state.velocity));
        }
    }
}

/// Starts on circles in (w x, x') about the origin.
fn starts(scene: &Scene) -> impl Iterator<Item = Start> + use<> {
    let Scales { length, rate } = scene.motion_scales();
    SPEEDS.into_iter().flat_map(move |speed| {
        (0..DIRECTIONS).map(move |k| {
            let angle = TAU * k as f64 / DIRECTIONS as f64;
            Start::new(
                speed * length * angle.cos(),
                speed * length * (rate * angle.sin()),
            )
        })
    })
}
