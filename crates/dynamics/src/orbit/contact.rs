//! One contact on its own: from the clearance to the clearance, with its tangent.

use std::ops::ControlFlow;
use std::sync::Arc as Shared;

use nalgebra::{Matrix2, Vector2};

use softstop::internals::{Beyond, Course, Mode, Motion, PhaseId, Phases, Surface, saltation};
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer, Start, Tangent,
};

/// Work that a contact may cost, in scan windows: a mass that bounces longer within it does not come back.
const MOST_WORK: u64 = 1 << 16;
/// Parts of a drive period in which the end of a contact is looked for.
const PARTS: f64 = 16.0;

/// The phases of a scene, as seen by a mass that comes to the clearance.
#[derive(Debug, Clone)]
pub(super) struct Face {
    pub phases: Shared<Phases>,
    pub clock: Clock,
    surface: Surface,
}

/// A contact from its impact on.
#[derive(Debug, Clone)]
pub(super) struct Passing {
    /// Change of the state right after the impact with its time, seen at a fixed time.
    pub by_time: Vector2<f64>,
    /// The same with its velocity.
    pub by_velocity: Vector2<f64>,
    /// The saltation of the impact.
    pub entry: Matrix2<f64>,
    /// From right after the impact to the free motion.
    pub tangent: Tangent,
    /// Velocity in m/s right after the impact.
    pub velocity_after: f64,
    /// Time in s from the impact until the mass is free again.
    pub lasting: f64,
    /// When it is.
    pub free_from: Instant,
    /// The free motion from there on, as if there were no stop.
    pub course: Course,
}

impl Face {
    /// None if there is no surface at the clearance.
    pub(super) fn new(phases: Shared<Phases>, clock: Clock) -> Option<Self> {
        let surface = *phases
            .surfaces
            .iter()
            .find(|surface| surface.is_clearance)?;
        Some(Self {
            phases,
            clock,
            surface,
        })
    }

    /// Where it is, in m.
    pub(super) fn position(&self) -> f64 {
        self.surface.position
    }

    /// Acceleration of the free motion at a state on the face.
    fn free_acceleration(&self, at: Instant, velocity: f64) -> f64 {
        self.acceleration(PhaseId::FREE, at, velocity)
    }

    fn acceleration(&self, phase: PhaseId, at: Instant, velocity: f64) -> f64 {
        let push = self.phases.held.amplitude * self.clock.drive(at).cos;
        self.phases
            .acceleration(phase, self.position(), velocity, push)
    }

    /// A motion from the face.
    pub(super) fn motion(&self, at: Instant, velocity: f64) -> Result<Motion, MotionError> {
        let start = Start::new(self.position(), velocity);
        Motion::new(self.phases.clone(), self.clock, at, start)
    }

    /// The contact that begins with an impact; none if the mass comes to rest in it or does not come
    /// back within `longest` s.
    pub(super) fn pass(
        &self,
        at: Instant,
        velocity: f64,
        longest: f64,
    ) -> Result<Option<Passing>, MotionError> {
        let before = self.free_acceleration(at, velocity);
        let mut contact = None;
        let (kind, velocity_after, after) = match self.surface.above {
            Beyond::Wall { restitution } => {
                let velocity_after = -restitution * velocity;
                let kind = CrossingKind::Rebound {
                    impact: true,
                    pierces: false,
                };
                let after = self.free_acceleration(at, velocity_after);
                (kind, velocity_after, after)
            }
            Beyond::Phase(_) => {
                let motion = contact.insert(self.motion(at, velocity)?);
                let Mode::Moving(phase) = motion.mode() else {
                    return Ok(None);
                };
                let kind = CrossingKind::Surface {
                    forward: true,
                    impact: true,
                    pierces: false,
                };
                (kind, velocity, self.acceleration(phase, at, velocity))
            }
        };
        if velocity_after == 0.0 {
            return Ok(None);
        }
        let entry = saltation(&Crossing {
            instant: at,
            kind,
            position: self.position(),
            velocity,
            velocity_after,
            acceleration_before: before,
            acceleration_after: after,
        });
        let exit = match contact {
            None => Some((Tangent::default(), at, velocity_after)),
            Some(motion) => self.exit(motion, longest)?,
        };
        let Some((tangent, free_from, velocity_free)) = exit else {
            return Ok(None);
        };
        let by_time = -Vector2::new(velocity_after, after);
        Ok(Some(Passing {
            by_time,
            by_velocity: Vector2::new(0.0, velocity_after / velocity),
            entry,
            tangent,
            velocity_after,
            lasting: self.clock.elapsed(at, free_from),
            free_from,
            course: self.motion(free_from, velocity_free)?.arc().course.clone(),
        }))
    }

    /// Follows a contact to its end: its tangent up to the free motion, when, and how fast.
    fn exit(
        &self,
        mut motion: Motion,
        longest: f64,
    ) -> Result<Option<(Tangent, Instant, f64)>, MotionError> {
        let at = motion.now();
        let mut exit = Exit {
            position: self.position(),
            tangent: Tangent::default(),
            found: None,
            effort: Effort::windows(MOST_WORK),
        };
        let part = self.clock.period() / PARTS;
        let mut until = at;
        while exit.found.is_none() && self.clock.elapsed(at, until) < longest {
            until = self.clock.after(until, part);
            if motion.watch(until, &mut exit)?.is_break() {
                break;
            }
        }
        let found = exit.found.filter(|(_, velocity)| *velocity < 0.0);
        Ok(found.map(|(instant, velocity)| (exit.tangent, instant, velocity)))
    }
}

/// Gathers the tangent until the mass is free again.
struct Exit {
    position: f64,
    tangent: Tangent,
    found: Option<(Instant, f64)>,
    effort: Effort,
}

impl Observer for Exit {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        if self.found.is_none() {
            self.tangent.arc(arc, elapsed);
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if self.found.is_some() {
            return;
        }
        self.tangent.crossing(crossing);
        let leaves = match crossing.kind {
            CrossingKind::Surface { forward, .. } => !forward,
            CrossingKind::Release | CrossingKind::Rest => true,
            _ => false,
        };
        if leaves && crossing.position == self.position {
            self.found = Some((crossing.instant, crossing.velocity_after));
        }
    }

    fn progress(&mut self, windows: u64) -> ControlFlow<()> {
        if self.found.is_some() {
            return ControlFlow::Break(());
        }
        self.effort.progress(windows)
    }
}
