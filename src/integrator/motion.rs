//! The loop: course, first crossing, next phase.

use std::cmp::Ordering;

use super::clock::{Clock, Instant};
use super::observer::{Arc, Crossing, CrossingKind, Observer};
use crate::error::MotionError;
use crate::events::{Found, Outlook, first_crossing};
use crate::flow::{Course, Departure, Node};
use crate::phases::{Exit, Law, Mode, Phase, PhaseKind, Phases, SPACING, Surface};

/// A state to start from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Position in m.
    pub position: f64,
    /// Velocity in m/s.
    pub velocity: f64,
}

impl Start {
    /// Refuses a state that is not finite.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`] naming the component.
    pub fn validate(&self) -> Result<(), MotionError> {
        for (name, value) in [("position", self.position), ("velocity", self.velocity)] {
            if !value.is_finite() {
                return Err(MotionError::NotFinite { name, value });
            }
        }
        Ok(())
    }
}

/// External force f = `value` + `rate` (t - start of the arc).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Force {
    /// Force in N.
    pub value: f64,
    /// Rate in N/s.
    pub rate: f64,
}

/// The exact motion of a scene, arc by arc.
///
/// An arc stays anchored at the crossing that it began with; asking for states on the way changes
/// nothing, so results do not depend on how a run is divided.
#[derive(Debug, Clone)]
pub struct Motion {
    phases: Phases,
    clock: Clock,
    mode: Mode,
    fed: bool,
    force: Force,
    start: Instant,
    now: Instant,
    course: Course,
    outlook: Outlook,
    hum: Hum,
}

/// Crossings of one and the same surface in a row, reversals left out.
#[derive(Debug, Clone, Copy, Default)]
struct Hum {
    surface: usize,
    crossings: u32,
}

/// Crossings in a row after which bounces of [`HUM_HEIGHT`] are no longer followed. At a preloaded
/// stop that is pressed with less than its preload, bounces shrink only by viscous damping: their
/// number grows beyond all bounds as their height goes to zero.
const HUM_CROSSINGS: u32 = 10_000;
/// Height of a bounce, relative to the length of the motion, that then counts as rest.
const HUM_HEIGHT: f64 = 1e-11;

impl Hum {
    fn count(&mut self, surface: usize) {
        if surface == self.surface {
            self.crossings += 1;
        } else {
            *self = Self {
                surface,
                crossings: 0,
            };
        }
    }

    /// Height below which a bounce counts as rest.
    fn resolution(&self) -> f64 {
        if self.crossings < HUM_CROSSINGS {
            SPACING
        } else {
            HUM_HEIGHT
        }
    }
}

impl Motion {
    /// A motion of `phases` from `start` at time `at`, with a strip fed.
    pub fn new(phases: Phases, clock: Clock, at: Instant, start: Start) -> Self {
        Self::with(phases, clock, at, start, Force::default(), true)
    }

    /// The same under an external force, with or without a strip.
    pub fn with(
        phases: Phases,
        clock: Clock,
        at: Instant,
        start: Start,
        force: Force,
        fed: bool,
    ) -> Self {
        let drive = clock.drive(at);
        let departure = Departure {
            position: start.position,
            velocity: start.velocity,
            drive,
            constant: 0.0,
            ramp: 0.0,
            balanced: false,
        };
        let course = Course::held(phases.held, departure);
        let push = phases.held.amplitude * drive.0 + force.value / phases.mass;
        let mode = phases.locate(start.position, start.velocity, push, fed);
        let outlook = Outlook::Never;
        let mut motion = Self {
            phases,
            clock,
            mode,
            fed,
            force,
            start: at,
            now: at,
            course,
            outlook,
            hum: Hum::default(),
        };
        motion.depart(start, drive, mode);
        motion
    }

    /// The present time.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// The clock of its drive.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// The phases it moves through.
    pub fn phases(&self) -> &Phases {
        &self.phases
    }

    /// What the mass does now.
    pub fn kind(&self) -> PhaseKind {
        self.phases.kind(self.mode)
    }

    /// The phase whose law holds now; none while the mass is held.
    pub fn phase(&self) -> Option<&Phase> {
        match self.mode {
            Mode::Moving(phase) => Some(&self.phases.phases[phase]),
            Mode::Held { .. } => None,
        }
    }

    /// External force and rate now.
    pub fn force(&self) -> Force {
        let elapsed = self.clock.elapsed(self.start, self.now);
        Force {
            value: self.force.value + self.force.rate * elapsed,
            rate: self.force.rate,
        }
    }

    /// Whether a strip will be met at the next crossing of the clearance.
    pub fn is_fed(&self) -> bool {
        self.fed
    }

    /// Position and velocity now.
    pub fn state(&self) -> Start {
        let elapsed = self.clock.elapsed(self.start, self.now);
        let (position, velocity) = self.course.at(elapsed, self.clock.drive(self.now));
        Start { position, velocity }
    }

    /// The arc that is under way.
    pub fn arc(&self) -> Arc<'_> {
        let law = self.phase();
        Arc {
            start: self.start,
            course: &self.course,
            phase: law,
            kind: self.kind(),
        }
    }

    /// Changes the feed of strips; it takes effect at the next upward crossing of the clearance.
    pub fn feed_strip(&mut self, fed: bool) {
        self.fed = fed;
    }

    /// Advances to `until`, telling `observer` of every finished arc and every crossing.
    ///
    /// # Errors
    /// [`MotionError::TimeBackwards`] if `until` lies in the past, [`MotionError::Unbounded`] if the
    /// motion grows beyond all bounds; the motion then stays where it was.
    pub fn advance(
        &mut self,
        until: Instant,
        observer: &mut impl Observer,
    ) -> Result<(), MotionError> {
        if until.partial_cmp(&self.now).is_none_or(Ordering::is_lt) {
            let (until, present) = (self.clock.time(until), self.clock.time(self.now));
            return Err(MotionError::TimeBackwards { until, present });
        }
        loop {
            let horizon = self.clock.elapsed(self.start, until);
            self.look_ahead(horizon)?;
            match self.outlook {
                Outlook::Crossing(found) if found.elapsed <= horizon => {
                    self.cross(found, observer);
                }
                _ => break,
            }
        }
        self.now = until;
        Ok(())
    }

    fn look_ahead(&mut self, horizon: f64) -> Result<(), MotionError> {
        if let Outlook::ClearUntil(node) = self.outlook
            && node.elapsed < horizon
        {
            self.outlook = self.search(node, horizon);
        }
        if let Outlook::Unbounded(node) = self.outlook
            && node.elapsed < horizon
        {
            let time = self.clock.time(self.clock.after(self.start, node.elapsed));
            return Err(MotionError::Unbounded {
                time,
                position: node.position,
            });
        }
        Ok(())
    }

    fn search(&self, node: Node, horizon: f64) -> Outlook {
        match self.mode {
            Mode::Moving(phase) => first_crossing(
                &self.course,
                &self.phases.phases[phase].guards,
                node,
                horizon,
            ),
            Mode::Held { forward, backward } => {
                let guards = self.phases.release_guards(forward, backward, node.position);
                first_crossing(&self.course, &guards, node, horizon)
            }
        }
    }

    fn cross(&mut self, found: Found, observer: &mut impl Observer) {
        observer.arc(&self.arc(), found.elapsed);
        let at = self.clock.after(self.start, found.elapsed);
        let drive = self.clock.drive(at);
        self.force.value += self.force.rate * found.elapsed;
        let push = self.phases.held.amplitude * drive.0 + self.force.value / self.phases.mass;
        if let Some(surface) = self.surface_of(found.guard) {
            self.hum.count(surface);
        }
        let landing = self.land(&found, push);
        let before = self.mode;
        self.start = at;
        self.now = at;
        self.depart(landing.state, drive, landing.mode);
        observer.crossing(&Crossing {
            instant: at,
            kind: landing.kind,
            position: landing.state.position,
            velocity: found.velocity,
            velocity_after: landing.state.velocity,
            acceleration_before: self.acceleration(before, found.position, found.velocity, push),
            acceleration_after: self.acceleration(
                landing.mode,
                landing.state.position,
                landing.state.velocity,
                push,
            ),
        });
    }

    /// The surface that a guard watches, if it watches one.
    fn surface_of(&self, guard: usize) -> Option<usize> {
        let Mode::Moving(phase) = self.mode else {
            return None;
        };
        match self.phases.phases[phase].exits[guard] {
            Exit::Forward(surface) | Exit::Backward(surface) => Some(surface),
            Exit::Reversal { .. } => None,
        }
    }

    /// State and mode right after a crossing.
    fn land(&self, found: &Found, push: f64) -> Landing {
        let phase = match self.mode {
            Mode::Moving(phase) => phase,
            Mode::Held { forward, backward } => {
                let phase = if found.guard == 0 { forward } else { backward };
                let state = Start {
                    position: found.position,
                    velocity: 0.0,
                };
                let mode = Mode::Moving(phase);
                return Landing {
                    state,
                    mode,
                    kind: CrossingKind::Release,
                };
            }
        };
        match self.phases.phases[phase].exits[found.guard] {
            Exit::Reversal { forward, backward } => {
                let mode = self
                    .phases
                    .leave_rest(forward, backward, found.position, push);
                let state = Start {
                    position: found.position,
                    velocity: 0.0,
                };
                Landing {
                    state,
                    mode,
                    kind: CrossingKind::Reversal,
                }
            }
            Exit::Forward(surface) => self.pass(surface, found.velocity.max(0.0), push, true),
            Exit::Backward(surface) => self.pass(surface, found.velocity.min(0.0), push, false),
        }
    }

    fn pass(&self, surface: usize, velocity: f64, push: f64, forward: bool) -> Landing {
        let at: &Surface = &self.phases.surfaces[surface];
        let mode = self
            .phases
            .at_surface(at, velocity, push, self.fed, self.hum.resolution());
        let held = matches!(mode, Mode::Held { .. });
        let fed = self.fed || at.above_unfed.is_none();
        let kind = CrossingKind::Surface {
            forward,
            impact: forward && at.is_clearance,
            pierces: forward && at.is_far_side && fed,
        };
        let velocity = if held { 0.0 } else { velocity };
        Landing {
            state: Start {
                position: at.position,
                velocity,
            },
            mode,
            kind,
        }
    }

    /// Begins an arc at the present start instant.
    fn depart(&mut self, state: Start, drive: (f64, f64), mode: Mode) {
        let released = matches!(self.mode, Mode::Held { .. }) && matches!(mode, Mode::Moving(_));
        let law = match mode {
            Mode::Moving(phase) => self.phases.phases[phase].law.force,
            Mode::Held { .. } => 0.0,
        };
        let departure = Departure {
            position: state.position,
            velocity: state.velocity,
            drive,
            constant: (law + self.force.value) / self.phases.mass,
            ramp: self.force.rate / self.phases.mass,
            balanced: released,
        };
        self.course = match mode {
            Mode::Moving(phase) => Course::new(self.phases.phases[phase].flow, departure),
            Mode::Held { .. } => Course::held(self.phases.held, departure),
        };
        self.mode = mode;
        self.outlook = Outlook::ClearUntil(self.course.start());
    }

    fn acceleration(&self, mode: Mode, position: f64, velocity: f64, push: f64) -> f64 {
        match mode {
            Mode::Held { .. } => 0.0,
            Mode::Moving(phase) => {
                let Law { force, .. } = self.phases.phases[phase].law;
                let flow = &self.phases.phases[phase].flow;
                flow.acceleration(position, velocity, push + force / self.phases.mass)
            }
        }
    }
}

/// State, mode and kind of a crossing, right after it.
struct Landing {
    state: Start,
    mode: Mode,
    kind: CrossingKind,
}
