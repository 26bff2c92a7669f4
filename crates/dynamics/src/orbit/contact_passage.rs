//! The passage of a mass through contact on its own, from the clearance to the clearance, with its tangent.

use std::ops::ControlFlow;
use std::sync::Arc as Shared;

use nalgebra::Matrix2;

use softstop::internals::{
    ArcSolution, Beyond, Departure, Mode, Motion, PhaseId, Phases, Polynomial, Surface, saltation,
};
use softstop::{
    Arc, CheckedScene, Clock, Crossing, CrossingKind, Effort, Instant, MotionError, Observer,
    Start, Tangent,
};

/// Work that a passage through contact may cost, in scan windows, 4096 crossings: then the mass stays.
const MAX_CONTACT_WORK: u64 = 1 << 18;

/// The surface at the clearance, with its scene: where a passage through contact begins and ends.
#[derive(Debug, Clone)]
pub(super) struct ClearanceSurface {
    pub scene: CheckedScene,
    pub phases: Shared<Phases>,
    pub clock: Clock,
    surface: Surface,
}

/// A passage through contact, from its impact until the mass is free again, with the free motion after it and what an observer
/// gathered on the way (`T`).
#[derive(Debug, Clone)]
pub(super) struct ContactPassage<T = Tangent> {
    kind: CrossingKind,
    /// Velocity in m/s right after the impact.
    pub velocity_after: f64,
    /// The phase in which it moves right after the impact.
    phase: Option<PhaseId>,
    /// What an observer gathers from right after the impact to the free motion: the tangent.
    pub tangent: T,
    /// Time in s from the impact until the mass is free again.
    pub lasting: f64,
    /// Instant at which the mass is free again.
    pub free_from: Instant,
    /// The free motion from there on, as if there were no stop.
    pub course: ArcSolution,
}

impl ClearanceSurface {
    /// The surface at the clearance of a scene; none without a surface at the clearance, or with one below that the mass may meet.
    pub(super) fn new(scene: &CheckedScene) -> Option<Self> {
        let surfaces = scene.phases().surfaces.iter();
        let mut clearances = surfaces.filter(|surface| surface.is_clearance);
        let surface = *clearances.next().filter(|surface| surface.side > 0.0)?;
        if clearances.any(|surface| surface.side < 0.0) {
            return None;
        }
        Some(Self {
            scene: scene.clone(),
            phases: scene.phases().clone(),
            clock: scene.clock(),
            surface,
        })
    }

    /// The clearance in m.
    pub(super) fn surface_position(&self) -> f64 {
        self.surface.position
    }

    /// Acceleration in m/s^2 of the mass in a phase at the clearance, at an instant with a velocity in m/s.
    fn acceleration_at_clearance(&self, phase: PhaseId, at: Instant, velocity: f64) -> f64 {
        let forcing = self.phases.amplitude * self.clock.drive(at).cos;
        self.phases
            .acceleration(phase, self.surface_position(), velocity, forcing)
    }

    /// The free motion from the clearance, at an instant with a velocity in m/s, as if there were no stop.
    fn free_motion_from_clearance(&self, at: Instant, velocity: f64) -> ArcSolution {
        let free = &self.phases[PhaseId::FREE];
        let departure = Departure {
            position: self.surface_position(),
            velocity,
            drive: self.clock.drive(at),
            forcing: Polynomial::linear(free.law.force / self.phases.mass, 0.0),
            acceleration: None,
        };
        ArcSolution::new(&free.flow, departure)
    }

    /// A motion that begins at the clearance, at an instant with a velocity in m/s.
    pub(super) fn release(&self, at: Instant, velocity: f64) -> Result<Motion, MotionError> {
        let start = Start::new(self.surface_position(), velocity);
        Motion::new(&self.scene, at, start)
    }

    /// The passage through contact from an impact; none if the mass rests in it or stays longer than `longest` s.
    pub(super) fn pass_contact<T: Observer + Default>(
        &self,
        at: Instant,
        velocity: f64,
        longest: f64,
    ) -> Option<ContactPassage<T>> {
        let (kind, velocity_after) = match self.surface.beyond {
            Beyond::Wall { restitution } => {
                let (impact, pierces) = (true, false);
                let kind = CrossingKind::Rebound { impact, pierces };
                (kind, -restitution * velocity)
            }
            Beyond::Phase(_) => {
                let (forward, impact, pierces) = (true, true, false);
                let kind = CrossingKind::Surface {
                    forward,
                    impact,
                    pierces,
                };
                (kind, velocity)
            }
        };
        let passage = |phase, tangent, free_from, course| ContactPassage {
            kind,
            velocity_after,
            phase,
            tangent,
            lasting: self.clock.elapsed(at, free_from),
            free_from,
            course,
        };
        (velocity > 0.0).then_some(())?;
        if velocity_after < 0.0 {
            let course = self.free_motion_from_clearance(at, velocity_after);
            return Some(passage(Some(PhaseId::FREE), T::default(), at, course));
        }
        let mut motion = self.release(at, velocity_after).ok()?;
        let is_wall = matches!(self.surface.beyond, Beyond::Wall { .. });
        let phase = match motion.mode() {
            Mode::Moving(phase) => Some(phase),
            _ if is_wall => None,
            _ => return None,
        };
        if is_wall && phase.is_some() {
            let course = motion.arc().course.clone();
            return Some(passage(phase, T::default(), at, course));
        }
        let mut contact = ContactRecorder {
            position: self.surface_position(),
            gathered: T::default(),
            found: None,
            effort: Effort::windows(MAX_CONTACT_WORK),
        };
        let until = self.clock.after(at, longest);
        let _ = motion.watch(until, &mut contact).ok()?;
        let (free_from, velocity_free) = contact.found?;
        // A wall that takes all velocity lets the mass go from rest.
        let is_free = velocity_free < 0.0 || is_wall;
        let course = motion.arc().course.clone();
        is_free.then(|| passage(phase, contact.gathered, free_from, course))
    }

    /// Acceleration in m/s^2 right after the impact that a passage begins with, at an instant, in the phase that follows it: in
    /// contact, free after a rebound, 0 if the mass rests.
    pub(super) fn acceleration_after<T>(&self, at: Instant, passage: &ContactPassage<T>) -> f64 {
        let at_clearance =
            |phase| self.acceleration_at_clearance(phase, at, passage.velocity_after);
        passage.phase.map_or(0.0, at_clearance)
    }

    /// The saltation matrix of the impact, at an instant with a velocity in m/s, that a passage begins with.
    pub(super) fn entry_saltation<T>(
        &self,
        at: Instant,
        velocity: f64,
        passage: &ContactPassage<T>,
    ) -> Matrix2<f64> {
        saltation(&Crossing {
            instant: at,
            kind: passage.kind,
            position: self.surface_position(),
            velocity,
            velocity_after: passage.velocity_after,
            acceleration_before: self.acceleration_at_clearance(PhaseId::FREE, at, velocity),
            acceleration_after: self.acceleration_after(at, passage),
        })
    }
}

/// An observer of a contact that hands its arcs and crossings to another one, until the mass is free again.
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
