//! Restarts a motion on an arc of its own: through other phases, under another force or drive, beside its state.

use std::sync::Arc as Shared;

use super::clock::{Clock, Instant};
use super::external_force::Force;
use super::motion::Motion;
use super::start::Start;
use crate::error::MotionError;
use crate::flow::Polynomial;
use crate::phases::{Mode, Phases};

impl Motion {
    /// This motion, taken up in a state through phases under a clock, which says that it is now `at`.
    pub(super) fn restarted_through(
        &self,
        through: (Shared<Phases>, Clock),
        at: Instant,
        state: Start,
    ) -> Result<Self, MotionError> {
        let latched = self.is_latched();
        let motion = Self::with_force(through, at, state, self.force(), latched)?;
        Ok(Self {
            fed: self.fed,
            pierced: self.pierced,
            ..motion
        })
    }

    /// Goes on from here under another external force; true if a new arc begins. Phase, latched strip and
    /// bounces in a row stay as they are; only a held mass may be let go at once.
    pub(crate) fn set_force(&mut self, force: Polynomial) -> bool {
        self.restart_under(force, self.state())
    }

    /// Goes on under another drive as well, by the same laws under that drive and its clock, which says that it is now `at`.
    pub(super) fn set_drive(
        &mut self,
        (phases, clock): (Shared<Phases>, Clock),
        at: Instant,
        force: Polynomial,
    ) -> bool {
        let (state, elapsed) = (self.state(), self.elapsed());
        (self.phases, self.clock, self.now) = (phases, clock, at);
        self.start = clock.after(at, -elapsed);
        self.restart_under(force, state)
    }

    /// Begins an arc in a state under an external force, unless bounces go on under it to their rest.
    fn restart_under(&mut self, force: Polynomial, state: Start) -> bool {
        if self.keeps_bouncing(&force) {
            self.force = Force::new(force.shifted(-self.elapsed()), self.start);
            return false;
        }
        let drive = self.clock.drive(self.now);
        self.start = self.now;
        self.force = Force::new(force, self.now);
        match self.mode {
            // A step of the force lets the mass go with the acceleration that it brings.
            Mode::Held(hold) => {
                let forcing = self.forcing_per_mass(drive);
                self.mode = self.phases.mode_from_rest(hold, state.position, forcing);
            }
            Mode::Chattering(hold) => {
                let phase = self.phases.at_velocity(hold.outer_phase(), state.velocity);
                self.mode = Mode::Moving(phase);
            }
            // At rest on a surface the force decides which way it goes, if any.
            Mode::Moving(_) if state.velocity == 0.0 => {
                let forcing = self.forcing_per_mass(drive);
                let latched = self.is_latched();
                self.mode = self.phases.mode_at(state.position, 0.0, forcing, latched);
            }
            Mode::Moving(_) => {}
        }
        self.begin_arc(state, drive, self.mode);
        true
    }

    /// True if the mass bounces on a rigid stop towards its rest, and another force would not keep it
    /// from that: what is left of the bounces is too short for it to tell.
    fn keeps_bouncing(&self, force: &Polynomial) -> bool {
        let Mode::Chattering(hold) = self.mode else {
            return false;
        };
        let forcing = self
            .phases
            .forcing_per_mass(self.clock.drive(self.now), force);
        let left = self
            .phases
            .mode_from_rest(hold, self.course.departure.position, forcing);
        matches!(left, Mode::Held(_))
    }

    /// This motion at a time on its present arc, with an arc of its own from there on.
    pub(crate) fn restarted_at(&self, now: Instant) -> Self {
        let mut motion = Self {
            now,
            ..self.clone()
        };
        let elapsed = self.clock.elapsed(self.start, now);
        if elapsed > 0.0 && self.phase().is_some() {
            let state = motion.state();
            let finer = self
                .course
                .taylor_step()
                .map(|step| step.fine_position_at(elapsed));
            motion.force.next_arc(&self.clock, now, elapsed);
            motion.start = now;
            let departure = motion.arc_departure(state, self.clock.drive(now), self.mode, None);
            motion.begin_course(departure, self.mode, finer, None);
        }
        motion
    }
}
