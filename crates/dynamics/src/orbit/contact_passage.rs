//! The passage of a mass through contact on its own, from the clearance to the clearance, with its tangent.

use std::ops::ControlFlow;
use std::sync::Arc as Shared;

use nalgebra::{Matrix2, Vector2};

use softstop::internals::{
    ArcSolution, Beyond, Departure, Mode, Motion, PhaseId, Phases, Polynomial, Surface, saltation,
};
use softstop::{
    Arc, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer, Start, Tangent,
};

/// Work that a passage through contact may cost, in scan windows, 4096 crossings: then the mass stays.
const MAX_CONTACT_WORK: u64 = 1 << 18;

/// The face at the clearance, with the phases of its scene: where a passage through contact begins and ends.
#[derive(Debug, Clone)]
pub(super) struct ContactFace {
    pub phases: Shared<Phases>,
    pub clock: Clock,
    surface: Surface,
}

/// A passage through contact, from its impact until the mass is free again, with its derivatives.
#[derive(Debug, Clone)]
pub(super) struct ContactPassage {
    /// Change of the state right after the impact with its time, seen at a fixed time.
    pub by_time: Vector2<f64>,
    /// Change of the state right after the impact with its velocity.
    pub by_velocity: Vector2<f64>,
    /// The saltation matrix of the impact.
    pub entry: Matrix2<f64>,
    /// Tangent from right after the impact to the free motion.
    pub tangent: Tangent,
    /// Velocity in m/s right after the impact.
    pub velocity_after: f64,
    /// Time in s from the impact until the mass is free again.
    pub lasting: f64,
    /// Instant at which the mass is free again.
    pub free_from: Instant,
    /// The free motion from there on, as if there were no stop.
    pub course: ArcSolution,
}

impl ContactFace {
    /// The face of a scene's phases; none without a surface at the clearance, or with one below that the mass may meet.
    pub(super) fn new(phases: Shared<Phases>, clock: Clock) -> Option<Self> {
        let surfaces = phases.surfaces.iter();
        let mut clearances = surfaces.filter(|surface| surface.is_clearance);
        let surface = *clearances.next().filter(|surface| surface.side > 0.0)?;
        if clearances.any(|surface| surface.side < 0.0) {
            return None;
        }
        Some(Self {
            phases,
            clock,
            surface,
        })
    }

    /// Position of the face in m.
    pub(super) fn face_position(&self) -> f64 {
        self.surface.position
    }

    /// Acceleration in m/s^2 of the free mass at the face, at an instant with a velocity in m/s.
    fn free_acceleration_at_face(&self, at: Instant, velocity: f64) -> f64 {
        self.acceleration_at_face(PhaseId::FREE, at, velocity)
    }

    /// Acceleration in m/s^2 of the mass in a phase at the face, at an instant with a velocity in m/s.
    fn acceleration_at_face(&self, phase: PhaseId, at: Instant, velocity: f64) -> f64 {
        let push = self.phases.amplitude * self.clock.drive(at).cos;
        self.phases
            .acceleration(phase, self.face_position(), velocity, push)
    }

    /// The free motion from the face, at an instant with a velocity in m/s, as if there were no stop.
    fn free_course(&self, at: Instant, velocity: f64) -> ArcSolution {
        let free = &self.phases[PhaseId::FREE];
        let departure = Departure {
            position: self.face_position(),
            velocity,
            drive: self.clock.drive(at),
            push: Polynomial::linear(free.law.force / self.phases.mass, 0.0),
            acceleration: None,
        };
        ArcSolution::new(&free.flow, departure)
    }

    /// A motion that begins at the face, at an instant with a velocity in m/s.
    pub(super) fn release(&self, at: Instant, velocity: f64) -> Result<Motion, MotionError> {
        let start = Start::new(self.face_position(), velocity);
        Motion::new(self.phases.clone(), self.clock, at, start)
    }

    /// The passage through contact from an impact; none if the mass rests in it or stays longer than `longest` s.
    pub(super) fn pass_contact(
        &self,
        at: Instant,
        velocity: f64,
        longest: f64,
    ) -> Result<Option<ContactPassage>, MotionError> {
        let before = self.free_acceleration_at_face(at, velocity);
        let mut contact = self.begin_contact(at, velocity)?;
        let Some(entry) = self.enter_contact(at, velocity, contact.as_ref()) else {
            return Ok(None);
        };
        let (velocity_after, after) = (entry.velocity_after, entry.acceleration);
        let saltation = saltation(&Crossing {
            instant: at,
            kind: entry.kind,
            position: self.face_position(),
            velocity,
            velocity_after,
            acceleration_before: before,
            acceleration_after: after,
        });
        let begin = (at, velocity_after);
        let Some(exit) = self.exit_contact::<Tangent>(begin, contact.as_mut(), longest)? else {
            return Ok(None);
        };
        let by_time = -Vector2::new(velocity_after, after);
        Ok(Some(ContactPassage {
            by_time,
            by_velocity: Vector2::new(0.0, velocity_after / velocity),
            entry: saltation,
            tangent: exit.gathered,
            velocity_after,
            lasting: self.clock.elapsed(at, exit.instant),
            free_from: exit.instant,
            course: exit.course,
        }))
    }

    /// The end of the contact from an impact, without its tangent: when the mass is free, and its free motion.
    pub(super) fn leave_contact(
        &self,
        at: Instant,
        velocity: f64,
        longest: f64,
    ) -> Result<Option<(Instant, ArcSolution)>, MotionError> {
        let mut contact = self.begin_contact(at, velocity)?;
        let Some(entry) = self.enter_contact(at, velocity, contact.as_ref()) else {
            return Ok(None);
        };
        let begin = (at, entry.velocity_after);
        let exit = self.exit_contact::<()>(begin, contact.as_mut(), longest)?;
        Ok(exit.map(|exit| (exit.instant, exit.course)))
    }

    /// The motion in contact after an impact; none where the face is rigid.
    fn begin_contact(&self, at: Instant, velocity: f64) -> Result<Option<Motion>, MotionError> {
        match self.surface.beyond {
            Beyond::Wall { .. } => Ok(None),
            Beyond::Phase(_) => self.release(at, velocity).map(Some),
        }
    }

    /// The impact that a contact begins with; none if the mass rests from there on.
    fn enter_contact(
        &self,
        at: Instant,
        velocity: f64,
        contact: Option<&Motion>,
    ) -> Option<ContactEntry> {
        let entry = match (self.surface.beyond, contact.map(Motion::mode)) {
            (Beyond::Wall { restitution }, _) => {
                let velocity_after = -restitution * velocity;
                ContactEntry {
                    kind: CrossingKind::Rebound {
                        impact: true,
                        pierces: false,
                    },
                    velocity_after,
                    acceleration: self.free_acceleration_at_face(at, velocity_after),
                }
            }
            (Beyond::Phase(_), Some(Mode::Moving(phase))) => ContactEntry {
                kind: CrossingKind::Surface {
                    forward: true,
                    impact: true,
                    pierces: false,
                },
                velocity_after: velocity,
                acceleration: self.acceleration_at_face(phase, at, velocity),
            },
            _ => return None,
        };
        (entry.velocity_after != 0.0).then_some(entry)
    }

    /// Follows a contact from right after its impact to its end.
    fn exit_contact<T: Observer + Default>(
        &self,
        begin: (Instant, f64),
        contact: Option<&mut Motion>,
        longest: f64,
    ) -> Result<Option<ContactExit<T>>, MotionError> {
        let (gathered, found) = match contact {
            None => (T::default(), Some(begin)),
            Some(motion) => self.follow_contact(motion, longest)?,
        };
        let Some((instant, velocity)) = found.filter(|(_, velocity)| *velocity < 0.0) else {
            return Ok(None);
        };
        Ok(Some(ContactExit {
            gathered,
            instant,
            course: self.free_course(instant, velocity),
        }))
    }

    /// Follows a mass in contact until it is free: what an observer gathers, when that is, and its velocity in m/s.
    fn follow_contact<T: Observer + Default>(
        &self,
        motion: &mut Motion,
        longest: f64,
    ) -> Result<(T, Option<(Instant, f64)>), MotionError> {
        let at = motion.now();
        let mut contact = ContactRecorder {
            position: self.face_position(),
            gathered: T::default(),
            found: None,
            effort: Effort::windows(MAX_CONTACT_WORK),
        };
        let _ = motion.watch(self.clock.after(at, longest), &mut contact)?;
        Ok((contact.gathered, contact.found))
    }
}

/// The impact that begins a contact.
struct ContactEntry {
    kind: CrossingKind,
    /// Velocity in m/s right after it.
    velocity_after: f64,
    /// Acceleration in m/s^2 right after it.
    acceleration: f64,
}

/// The end of a contact: what was gathered up to there, when the mass is free, and its free motion from there on.
struct ContactExit<T> {
    gathered: T,
    instant: Instant,
    course: ArcSolution,
}

/// An observer of a contact that gathers until the mass is free again.
struct ContactRecorder<T> {
    position: f64,
    gathered: T,
    found: Option<(Instant, f64)>,
    effort: Effort,
}

impl<T: Observer> Observer for ContactRecorder<T> {
    fn arc(&mut self, arc: &Arc<'_>, elapsed: f64) {
        if self.found.is_none() {
            self.gathered.arc(arc, elapsed);
        }
    }

    fn crossing(&mut self, crossing: &Crossing) {
        if self.found.is_some() {
            return;
        }
        self.gathered.crossing(crossing);
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
