//! One period of a motion, arc by arc, with the force of contact.

use softstop::internals::{Phase, work};
use softstop::{Arc, Clock, MotionError, Observer, PhaseKind, Start};
use softstop_dynamics::Orbit;

/// Fewest points of an arc.
const FEWEST: f64 = 24.0;

/// A point of the motion, in the paper's ratios.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub(super) time: f64,
    pub(super) position: f64,
    pub(super) velocity: f64,
    /// That of contact.
    pub(super) force: f64,
    pub(super) phase: PhaseKind,
}

/// One period of a periodic motion.
pub(super) struct Cycle {
    pub(super) orbit: Orbit,
    /// In order of time; those at which the phase changes stand twice.
    pub(super) points: Vec<Point>,
    /// Energy lost in the period.
    pub(super) dissipated: f64,
    /// The part of it lost while bodies touch.
    pub(super) dissipated_in_contact: f64,
}

impl Cycle {
    /// The period of an orbit from drive angle phi on, with so many points.
    pub(super) fn of(orbit: Orbit, points: u32) -> Result<Self, MotionError> {
        let mut motion = orbit.scene.motion(orbit.state().into())?;
        let end = Clock::at_cycle(orbit.periods);
        let mut recorder = Recorder {
            fineness: f64::from(points) / orbit.scene.period(),
            cycle: Self {
                orbit,
                points: Vec::new(),
                dissipated: 0.0,
                dissipated_in_contact: 0.0,
            },
        };
        motion.advance(end, &mut recorder)?;
        motion.tell_arc(&mut recorder);
        Ok(recorder.cycle)
    }

    /// Time for which bodies touch.
    pub(super) fn contact_time(&self) -> f64 {
        let same = self.points.chunk_by(|a, b| a.phase == b.phase);
        let touching = same.filter(|arc| arc[0].phase != PhaseKind::Free);
        let times = touching.map(|arc| arc[arc.len() - 1].time - arc[0].time);
        times.sum()
    }

    /// Where a phase is first entered.
    pub(super) fn first(&self, phase: PhaseKind) -> Option<&Point> {
        self.points.iter().find(|point| point.phase == phase)
    }

    /// Where it is last left.
    pub(super) fn last(&self, phase: PhaseKind) -> Option<&Point> {
        self.points.iter().rfind(|point| point.phase == phase)
    }
}

struct Recorder {
    /// Points per time.
    fineness: f64,
    cycle: Cycle,
}

impl Observer for Recorder {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        let cycle = &mut self.cycle;
        let lost = work(arc, cycle.orbit.scene.mass, elapsed).dissipated;
        cycle.dissipated += lost;
        if arc.kind != PhaseKind::Free {
            cycle.dissipated_in_contact += lost;
        }
        let begin = arc.begin();
        let steps = (self.fineness * elapsed).ceil().max(FEWEST) as u32;
        cycle.points.extend((0..=steps).map(|step| {
            let after = elapsed * f64::from(step) / f64::from(steps);
            let Start { position, velocity } = arc.at(after);
            let force = |phase: &Phase| phase.contact_force(position, velocity);
            Point {
                time: begin + after,
                position,
                velocity,
                force: arc.phase.map_or(0.0, force),
                phase: arc.kind,
            }
        }));
    }
}
