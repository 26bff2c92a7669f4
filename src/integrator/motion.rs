//! A motion under way: its phase, its course, its present state.

use std::sync::Arc as Shared;

use super::arc::Arc;
use super::bounce_train::BounceTrain;
use super::clock::{Clock, Instant};
use super::external_force::Force;
use super::start::Start;
use crate::checked_scene::CheckedScene;
use crate::error::MotionError;
use crate::events::{NextEvent, is_clear_by_start_derivatives};
use crate::flow::{ArcSolution, Departure, DriveAngle, Polynomial};
use crate::phases::{Mode, Phase, PhaseKind, Phases, StopEnergy, Surface};

/// The exact motion of a scene, arc by arc.
///
/// An arc stays anchored at the crossing that it began with; asking for states on the way changes
/// nothing, so results do not depend on how a run is divided.
#[derive(Debug, Clone)]
pub struct Motion {
    pub(super) phases: Shared<Phases>,
    pub(super) clock: Clock,
    pub(super) mode: Mode,
    pub(super) fed: bool,
    /// The strip has been pierced since the clearance was last passed.
    pub(super) pierced: bool,
    pub(super) force: Force,
    pub(super) start: Instant,
    pub(super) now: Instant,
    pub(super) course: ArcSolution,
    pub(super) outlook: NextEvent,
    pub(super) bounce_train: BounceTrain,
    /// The present arc begins where it was put, which may be beyond the surfaces of its phase.
    pub(super) is_put: bool,
}

impl Motion {
    /// A motion of `scene` from `start` at time `at`, with a strip fed.
    ///
    /// # Errors
    /// [`MotionError::BeyondStop`] if it would start beyond a rigid stop.
    pub fn new(scene: &CheckedScene, at: Instant, start: Start) -> Result<Self, MotionError> {
        let through = (scene.phases().clone(), scene.clock());
        Self::with_force(through, at, start, Polynomial::default(), true)
    }

    /// A motion through phases under an external force in N that begins with the motion, with or without a strip.
    ///
    /// # Errors
    /// As [`Motion::new`].
    // In a call of its own the motion would be copied once more.
    #[inline(always)]
    pub(super) fn with_force(
        (phases, clock): (Shared<Phases>, Clock),
        at: Instant,
        start: Start,
        force: Polynomial,
        fed: bool,
    ) -> Result<Self, MotionError> {
        let position = start.position;
        let is_passed = |wall: &&Surface| position != wall.position && wall.is_reached(position);
        if let Some(&Surface { position: wall, .. }) = phases.walls().find(is_passed) {
            return Err(MotionError::BeyondStop { position, wall });
        }
        let drive = clock.drive(at);
        let departure = Departure {
            position: start.position,
            velocity: start.velocity,
            drive,
            forcing: Polynomial::default(),
            acceleration: None,
        };
        let course = ArcSolution::held(&phases.held, departure);
        let forcing = phases.forcing_per_mass(drive, &force);
        let mode = phases.mode_at(start.position, start.velocity, forcing, fed);
        let outlook = NextEvent::Never;
        let mut motion = Self {
            phases,
            clock,
            mode,
            fed,
            pierced: false,
            force: Force::new(force, at),
            start: at,
            now: at,
            course,
            outlook,
            bounce_train: BounceTrain::default(),
            is_put: false,
        };
        motion.begin_arc(start, drive, mode);
        Ok(motion)
    }

    /// Goes by the phase that it is known to move in where that is the one of a contact that has just been released, and
    /// rounding of its state has put it back before the release.
    pub fn assume_phase(&mut self, index: usize) {
        let known = self.phases.phases[index].id;
        if let Mode::Moving(located) = self.mode
            && let Some((released, _)) = self.phases[located].released
            && released == known
        {
            self.begin_arc(
                self.state(),
                self.clock.drive(self.now),
                Mode::Moving(known),
            );
        }
    }

    /// The present time.
    pub fn now(&self) -> Instant {
        self.now
    }

    /// Time in s since the present arc began.
    pub(crate) fn elapsed(&self) -> f64 {
        self.clock.elapsed(self.start, self.now)
    }

    /// True if the present arc has just begun and provably goes on beyond `horizon`. Where it ends is left to the next
    /// advance, so that one with a crossing does not pay for two.
    pub(super) fn is_clear_at_once(&self, horizon: f64) -> bool {
        let Mode::Moving(phase) = self.mode else {
            return false;
        };
        horizon <= self.course.flow.window
            && self.now == self.start
            && matches!(self.outlook, NextEvent::ClearUntil(_))
            && is_clear_by_start_derivatives(&self.course, &self.phases[phase].guards, horizon)
    }

    /// The clock of its drive.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Which phase holds, or what holds the mass.
    pub fn mode(&self) -> Mode {
        self.mode
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
        self.mode.phase().map(|phase| &self.phases[phase])
    }

    /// The energy that the stop has stored in the present phase, as a function of the position.
    pub fn store(&self) -> &StopEnergy {
        let phase = match self.mode {
            Mode::Moving(phase) => phase,
            Mode::Held(hold) | Mode::Chattering(hold) => hold.outer_phase(),
        };
        &self.phases[phase].store
    }

    /// External force in N from now on.
    pub fn force(&self) -> Polynomial {
        self.force.seen_from(&self.clock, self.now, self.elapsed())
    }

    /// Position and velocity now.
    pub fn state(&self) -> Start {
        let drive = self.clock.drive(self.now);
        let (position, velocity) = self.course.state_at(self.elapsed(), drive);
        let bounding = self.phase().filter(|_| !self.is_put);
        let confine = |phase: &Phase| phase.confine_position(position);
        Start::new(bounding.map_or(position, confine), velocity)
    }

    /// The arc that is under way.
    pub fn arc(&self) -> Arc<'_> {
        let phase = self.phase();
        Arc {
            start: self.start,
            clock: &self.clock,
            course: &self.course,
            phase,
            kind: self.kind(),
            side: match (phase, self.mode.sticking()) {
                (Some(phase), _) => phase.side,
                (None, Some(hold)) => self.phases.side_of_hold(hold),
                (None, None) => 1.0,
            },
            end: None,
        }
    }

    /// True if all that this motion goes by is, to the last bit, what one of the same scene went by some whole drive periods
    /// before: then what follows repeats, to the last bit, what followed there.
    pub fn repeats(&self, before: &Self) -> bool {
        let since_arc = |it: &Self| {
            (
                it.now.cycles - it.start.cycles,
                it.now.offset,
                it.start.offset,
            )
        };
        let held = |it: &Self| {
            (
                it.mode,
                it.fed,
                it.pierced,
                it.is_put,
                it.bounce_train,
                it.outlook,
            )
        };
        let force = *self.force.on_arc();
        since_arc(self) == since_arc(before)
            && held(self) == held(before)
            && (force, force.is_linear()) == (*before.force.on_arc(), true)
            && self.course == before.course
    }

    /// Carries a motion that repeats what it went by on by whole drive periods.
    pub fn skip_periods(&mut self, periods: u64) {
        self.start.cycles += periods as f64;
        self.now.cycles += periods as f64;
    }

    /// Whether the strip's phases hold now, or would at the next crossing of the clearance.
    pub(super) fn is_latched(&self) -> bool {
        match self.mode {
            Mode::Moving(phase) => self.phases.belongs_to_strip(phase),
            Mode::Held(hold) | Mode::Chattering(hold) => {
                let mut phases = hold.phases();
                phases.find_map(|phase| self.phases.belongs_to_strip(phase))
            }
        }
        .unwrap_or(self.fed)
    }

    /// Switches the feed of strips on or off; it takes effect at the next upward crossing of the clearance.
    pub fn feed_strip(&mut self, fed: bool) {
        self.fed = fed;
    }

    /// Forcing of drive and external force per mass, in m/s^2, at the start of the present arc.
    pub(super) fn forcing_per_mass(&self, drive: DriveAngle) -> f64 {
        self.phases.forcing_per_mass(drive, self.force.on_arc())
    }

    /// Acceleration in m/s^2 in a mode.
    pub(super) fn acceleration_in(&self, mode: Mode, at: Start, forcing: f64) -> f64 {
        let Start { position, velocity } = at;
        let moving = |phase| self.phases.acceleration(phase, position, velocity, forcing);
        mode.phase().map_or(0.0, moving)
    }
}
