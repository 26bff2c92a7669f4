//! A motion as points to draw.

use softstop::{MotionError, Scene, Start};

/// Fewest points of an arc.
const FEWEST: f64 = 8.0;

/// How far back what is near the stop goes, in units of the depth beyond it.
const NEAR: f64 = 6.0;
/// Least such depth, in units of the clearance.
const SHALLOW: f64 = 0.002;

/// A point of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// Time in drive periods.
    pub(super) periods: f64,
    pub(super) position: f64,
    pub(super) velocity: f64,
}

/// A motion from drive angle 0 on.
pub(super) struct Path {
    pub(super) points: Vec<Point>,
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
            let steps = (f64::from(fineness) * arc.duration / period)
                .ceil()
                .max(FEWEST) as u32;
            for step in 0..=steps {
                let after = arc.duration * f64::from(step) / f64::from(steps);
                let instant = clock.after(arc.start, after);
                let (position, velocity) = arc.course.at(after, clock.drive(instant));
                points.push(Point {
                    periods: clock.time(instant) / period,
                    position,
                    velocity,
                });
            }
        }
        let impacts = trajectory.impacts();
        Ok(Self {
            points,
            impacts: impacts
                .map(|touch| clock.time(touch.instant) / period)
                .collect(),
        })
    }

    /// Positions over time in drive periods.
    pub(super) fn positions(&self) -> Vec<(f64, f64)> {
        let place = |point: &Point| (point.periods, point.position);
        self.points.iter().map(place).collect()
    }

    /// The states from the stop back by [`NEAR`] times the depth that the motion reaches beyond it.
    pub(super) fn near(&self, clearance: f64) -> Vec<(f64, f64)> {
        let mut states = self.states();
        let highest = states.iter().map(|state| state.0).fold(clearance, f64::max);
        let depth = (highest - clearance).max(SHALLOW * clearance);
        states.retain(|state| state.0 > clearance - NEAR * depth);
        states
    }

    /// Velocities over positions.
    pub(super) fn states(&self) -> Vec<(f64, f64)> {
        let state = |point: &Point| (point.position, point.velocity);
        self.points.iter().map(state).collect()
    }
}
