//! One period of a motion, arc by arc, with the force of contact.

use softstop::internals::{Law, work};
use softstop::{Arc, Clock, MotionError, Observer, PhaseKind};
use softstop_dynamics::orbit::Orbit;

use crate::figure7::chart::StrokePoint;

/// Fewest points of an arc.
const FEWEST: f64 = 24.0;

/// One period of a periodic motion.
pub(super) struct Stroke {
    /// Its points in order of time; those at which the phase changes stand twice.
    pub(super) points: Vec<StrokePoint>,
    /// Energy lost in the period, in J.
    pub(super) dissipated: f64,
    /// The part of it lost while bodies touch.
    pub(super) dissipated_in_contact: f64,
}

impl Stroke {
    /// The period of an orbit from drive angle phi on, with so many points.
    pub(super) fn of(orbit: &Orbit, points: u32) -> Result<Self, MotionError> {
        let mut motion = orbit.scene.motion(orbit.state().into())?;
        let mut recorder = Recorder {
            clock: *motion.clock(),
            mass: orbit.scene.mass,
            free: motion.phases().phases[0].law,
            fineness: f64::from(points) / orbit.scene.period(),
            stroke: Self {
                points: Vec::new(),
                dissipated: 0.0,
                dissipated_in_contact: 0.0,
            },
        };
        let end = Clock::at_cycle(orbit.periods);
        motion.advance(end, &mut recorder)?;
        let arc = motion.arc();
        recorder.arc(&arc, motion.clock().elapsed(arc.start, end));
        Ok(recorder.stroke)
    }

    /// Time in s for which bodies touch.
    pub(super) fn contact_time(&self) -> f64 {
        let same = self.points.chunk_by(|a, b| a.phase == b.phase);
        let touching = same.filter(|arc| arc[0].phase != PhaseKind::Free);
        touching
            .map(|arc| arc[arc.len() - 1].time - arc[0].time)
            .sum()
    }

    /// Velocity in m/s with which a phase is first entered.
    pub(super) fn velocity_into(&self, phase: PhaseKind) -> Option<f64> {
        let first = self.points.iter().find(|point| point.phase == phase)?;
        Some(first.velocity)
    }

    /// Velocity in m/s with which a phase is last left.
    pub(super) fn velocity_out_of(&self, phase: PhaseKind) -> Option<f64> {
        let last = self.points.iter().rfind(|point| point.phase == phase)?;
        Some(last.velocity)
    }
}

struct Recorder {
    clock: Clock,
    mass: f64,
    free: Law,
    /// Points per second.
    fineness: f64,
    stroke: Stroke,
}

impl Observer for Recorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let lost = work(arc, self.mass, &self.free, elapsed).dissipated;
        self.stroke.dissipated += lost;
        if arc.kind != PhaseKind::Free {
            self.stroke.dissipated_in_contact += lost;
        }
        let begin = self.clock.time(arc.start);
        let steps = (self.fineness * elapsed).ceil().max(FEWEST) as u32;
        for step in 0..=steps {
            let after = elapsed * f64::from(step) / f64::from(steps);
            let drive = self.clock.drive(self.clock.after(arc.start, after));
            let (position, velocity) = arc.course.at(after, drive);
            let force = arc.phase.map_or(0.0, |phase| {
                phase.contact_force(&self.free, position, velocity)
            });
            self.stroke.points.push(StrokePoint {
                time: begin + after,
                position,
                velocity,
                force,
                phase: arc.kind,
            });
        }
    }
}
