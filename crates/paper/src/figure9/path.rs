//! A motion as points to draw.

use super::CLEARANCE;
use softstop::{MotionError, Scene, Start};

/// Fewest points of an arc.
const FEWEST: f64 = 8.0;
/// How far back what is near the stop goes, in units of the depth beyond it.
const NEAR: f64 = 6.0;
/// Least such depth, in units of the clearance.
pub(super) const SHALLOW: f64 = 0.002;

/// A motion from drive angle 0 on.
pub(super) struct Path {
    /// Time in drive periods, position, velocity.
    pub(super) points: Vec<[f64; 3]>,
    /// When it hits, in drive periods.
    pub(super) impacts: Vec<f64>,
}

impl Path {
    /// The motion from a start over drive periods, with so many points in each.
    pub(super) fn of(
        scene: &Scene,
        start: Start,
        periods: u64,
        fineness: u32,
    ) -> Result<Self, MotionError> {
        let trajectory = scene.trajectory(start, periods)?;
        let clock = trajectory.clock;
        let period = clock.period();
        let mut points = Vec::new();
        for arc in &trajectory.arcs {
            let steps = f64::from(fineness) * arc.duration / period;
            let steps = steps.ceil().max(FEWEST) as u32;
            points.extend((0..=steps).map(|step| {
                let after = arc.duration * f64::from(step) / f64::from(steps);
                let instant = clock.after(arc.start, after);
                let (position, velocity) = arc.course.at(after, clock.drive(instant));
                [clock.time(instant) / period, position, velocity]
            }));
        }
        let impacts = trajectory.impacts();
        let impacts = impacts.map(|touch| clock.time(touch.instant) / period);
        Ok(Self {
            points,
            impacts: impacts.collect(),
        })
    }

    /// Positions over time in drive periods.
    pub(super) fn positions(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|at| (at[0], at[1])).collect()
    }

    /// Velocities over positions.
    pub(super) fn states(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|at| (at[1], at[2])).collect()
    }

    /// The states from the stop back by [`NEAR`] times the depth that the motion reaches beyond it.
    pub(super) fn near(&self) -> Vec<(f64, f64)> {
        let mut states = self.states();
        let highest = states.iter().map(|state| state.0).fold(CLEARANCE, f64::max);
        let depth = (highest - CLEARANCE).max(SHALLOW * CLEARANCE);
        states.retain(|state| state.0 > CLEARANCE - NEAR * depth);
        states
    }
}
