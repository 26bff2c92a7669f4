//! A motion arc by arc as points to draw, with the force of contact, its impacts and what it dissipates.

use softstop::internals::{Phase, work};
use softstop::{MotionError, PhaseKind, Scene, Start};

/// A point of a motion, in the paper's ratios.
#[derive(Debug, Clone, Copy)]
pub(super) struct PathPoint {
    pub(super) time: f64,
    pub(super) position: f64,
    pub(super) velocity: f64,
    /// That of contact.
    pub(super) force: f64,
    pub(super) phase: PhaseKind,
}

/// A motion from drive angle phi on.
#[derive(Debug, Default)]
pub(super) struct Path {
    /// In order of time; those at which the phase changes stand twice.
    pub(super) points: Vec<PathPoint>,
    /// When it hits.
    pub(super) impacts: Vec<f64>,
    /// Energy lost.
    pub(super) dissipated: f64,
    /// The part of it lost while bodies touch.
    pub(super) dissipated_in_contact: f64,
}

impl Path {
    /// The motion over drive periods, with so many points in each, and so many in an arc at least.
    pub(super) fn new(
        scene: &Scene,
        start: Start,
        periods: u64,
        (fineness, fewest): (u32, u32),
    ) -> Result<Self, MotionError> {
        let trajectory = scene.trajectory(start, periods)?;
        let clock = trajectory.clock;
        let mut path = Self {
            impacts: trajectory.timed_impacts().map(|it| it.0).collect(),
            ..Self::default()
        };
        for (arc, elapsed) in trajectory.arc_views() {
            let lost = work(&arc, scene.mass, elapsed).dissipated;
            path.dissipated += lost;
            if arc.kind != PhaseKind::Free {
                path.dissipated_in_contact += lost;
            }
            let steps = f64::from(fineness) * elapsed / clock.period();
            let steps = steps.ceil().max(f64::from(fewest)) as u32;
            path.points.extend((0..=steps).map(|step| {
                let after = elapsed * f64::from(step) / f64::from(steps);
                let Start { position, velocity } = arc.at(after);
                let force = |phase: &Phase| phase.contact_force(position, velocity);
                PathPoint {
                    time: clock.time(clock.after(arc.start, after)),
                    position,
                    velocity,
                    force: arc.phase.map_or(0.0, force),
                    phase: arc.kind,
                }
            }));
        }
        Ok(path)
    }

    /// Velocities over positions.
    pub(super) fn states(&self) -> Vec<(f64, f64)> {
        let points = self.points.iter();
        points.map(|at| (at.position, at.velocity)).collect()
    }

    /// The points of each phase in turn.
    pub(super) fn phases(&self) -> impl Iterator<Item = &[PathPoint]> {
        self.points.chunk_by(|a, b| a.phase == b.phase)
    }

    /// Where a phase is first entered.
    pub(super) fn first(&self, phase: PhaseKind) -> Option<&PathPoint> {
        self.points.iter().find(|point| point.phase == phase)
    }

    /// Where it is last left.
    pub(super) fn last(&self, phase: PhaseKind) -> Option<&PathPoint> {
        self.points.iter().rfind(|point| point.phase == phase)
    }
}
