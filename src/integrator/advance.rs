//! The loop: from crossing to crossing, up to a time.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::arc::Arc;
use super::clock::Instant;
use super::crossing::{Crossing, CrossingKind};
use super::effort;
use super::motion::Motion;
use super::observer::Observer;
use super::reset::Reset;
use super::start::Start;
use crate::budget;
use crate::error::MotionError;
use crate::events::{FoundCrossing, Guard, NextEvent, first_crossing};
use crate::flow::{DriveAngle, FinePosition};
use crate::phases::{Mode, Phase};

/// Most crossings at one and the same instant: more than any row of bounces within the resolution of time.
const MAX_CROSSINGS_AT_ONCE: u32 = 1_000_000;
/// Crossings at once as which a Taylor step counts, of which a contact takes some tens, or the end of a row of bounces.
const CROSSINGS_PER_STEP: u32 = 100;
/// Most windows of work in one drive period, which take some seconds: four times as many as scanning one takes at the
/// fastest rate that a scene may have.
const MAX_PERIOD_WORK: u64 = 1 << 28;

impl Motion {
    /// Advances to `until`, or to where `observer` stops it, telling it of every finished arc and every crossing.
    ///
    /// # Errors
    /// [`MotionError::TimeBackwards`] if `until` lies in the past, [`MotionError::Unbounded`] if the
    /// motion grows beyond all bounds, [`MotionError::Stalled`] if crossings or steps pile up,
    /// [`MotionError::Endless`] if a drive period takes too much work, [`MotionError::OverBudget`] if a budget set around
    /// the call is spent; the motion is then known no further than its present time.
    pub fn advance(
        &mut self,
        until: Instant,
        observer: &mut dyn Observer,
    ) -> Result<(), MotionError> {
        self.watch(until, observer).map(drop)
    }

    /// Advances, and says whether `observer` stopped it. The present time is then that of a crossing, or lies on a long arc.
    ///
    /// # Errors
    /// As [`Motion::advance`].
    pub fn watch(
        &mut self,
        until: Instant,
        observer: &mut dyn Observer,
    ) -> Result<ControlFlow<()>, MotionError> {
        self.watch_before(until, None, observer)
    }

    /// Advances as [`Motion::watch`], but stops right before the first crossing that does not happen before the instant
    /// `halt`: [`Motion::is_at_crossing`] then tells so.
    pub(super) fn watch_before(
        &mut self,
        until: Instant,
        halt: Option<Instant>,
        observer: &mut dyn Observer,
    ) -> Result<ControlFlow<()>, MotionError> {
        let finite = until.cycles.is_finite() && until.offset.is_finite();
        if !finite || until.partial_cmp(&self.now).is_none_or(Ordering::is_lt) {
            let (until, present) = (self.clock.time(until), self.clock.time(self.now));
            return Err(MotionError::TimeBackwards { until, present });
        }
        let mut at_once = 0;
        let (mut cycle, mut work) = (self.now.cycles, 0);
        while !self.advance_if_clear(until)? {
            let (elapsed, counts) = match self.outlook {
                NextEvent::Crossing(FoundCrossing { elapsed, .. }) => (elapsed, 1),
                NextEvent::Ends(elapsed) => (elapsed, CROSSINGS_PER_STEP),
                _ => (0.0, 0),
            };
            at_once = match self.is_instant(elapsed) {
                true => at_once + counts,
                false => 0,
            };
            if at_once > MAX_CROSSINGS_AT_ONCE {
                return Err(self.stalled());
            }
            if let Some(at) = self.next_crossing()
                && halt.is_some_and(|halt| at >= halt)
            {
                self.now = at;
                return Ok(ControlFlow::Break(()));
            }
            let windows = match self.outlook {
                NextEvent::Crossing(found) => {
                    self.pass_crossing(found, observer);
                    budget::charge(budget::CROSSING);
                    budget::CROSSING
                }
                NextEvent::Ends(elapsed) => {
                    self.end_step(elapsed, observer);
                    budget::TAYLOR_STEP
                }
                NextEvent::ClearUntil(node) => {
                    self.now = self.clock.after(self.start, node.elapsed);
                    effort::WINDOWS_PER_QUESTION.into()
                }
                NextEvent::Never | NextEvent::Unbounded(_) => 0,
            };
            if observer.progress(windows).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            if self.now.cycles != cycle {
                (cycle, work) = (self.now.cycles, 0);
            }
            work += windows;
            if work > MAX_PERIOD_WORK {
                return Err(self.endless());
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Tells `observer` of the arc that is under way, up to the present time.
    pub fn tell_arc(&self, observer: &mut dyn Observer) {
        observer.arc(&self.arc(), self.elapsed());
    }

    /// Moves on along the present arc if it reaches to `until`; false if something happens before, or may happen for
    /// all that is known. `until` does not lie in the past, unless by the rounding of a crossing.
    ///
    /// # Errors
    /// [`MotionError::Unbounded`].
    pub(super) fn advance_if_clear(&mut self, until: Instant) -> Result<bool, MotionError> {
        let horizon = self.clock.elapsed(self.start, until);
        if self.is_clear_at_once(horizon) {
            self.now = until;
            return Ok(true);
        }
        self.look_ahead(horizon)?;
        // Written such that a time that is not a number stops nothing.
        let ends = match &self.outlook {
            NextEvent::Crossing(found) => found.elapsed <= horizon,
            NextEvent::Ends(elapsed) => *elapsed <= horizon,
            NextEvent::ClearUntil(node) => node.elapsed < horizon,
            NextEvent::Never | NextEvent::Unbounded(_) => false,
        };
        if ends {
            return Ok(false);
        }
        if !self.course.is_bounded() {
            let (position, velocity) = self.course.state_at(horizon, self.clock.drive(until));
            if !(position.is_finite() && velocity.is_finite()) {
                let time = self.clock.time(until);
                return Err(MotionError::Unbounded { time, position });
            }
        }
        self.now = until;
        Ok(true)
    }

    /// True if a stretch of the present arc is too short for the clock to tell.
    pub(super) fn is_instant(&self, elapsed: f64) -> bool {
        elapsed < 0.25 * f64::EPSILON * self.clock.period()
            || self.clock.after(self.start, elapsed) == self.start
    }

    fn stalled(&self) -> MotionError {
        let (time, position) = (self.clock.time(self.start), self.course.departure.position);
        MotionError::Stalled { time, position }
    }

    fn endless(&self) -> MotionError {
        let (time, position) = (self.clock.time(self.now), self.course.departure.position);
        MotionError::Endless { time, position }
    }

    /// Searches the next event up to `horizon` seconds into the arc, unless it is known.
    fn look_ahead(&mut self, horizon: f64) -> Result<(), MotionError> {
        if let NextEvent::ClearUntil(node) = self.outlook
            && node.elapsed < horizon
        {
            let sight =
                node.elapsed + f64::from(effort::WINDOWS_PER_QUESTION) * self.course.flow.window;
            let resolved = sight > node.elapsed;
            let until = if resolved {
                horizon.min(sight)
            } else {
                horizon
            };
            let is_open = !budget::is_spent();
            let search = || first_crossing(&self.course, &self.present_guards(), node, until);
            let found = is_open.then(search);
            let found = found.filter(|_| !budget::is_spent());
            self.outlook = found.ok_or_else(|| MotionError::OverBudget {
                time: self.clock.time(self.now),
            })?;
        }
        if let NextEvent::Unbounded(node) = &self.outlook
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

    /// The guards that watch the present arc.
    pub(super) fn present_guards(&self) -> Cow<'_, [Guard]> {
        match self.mode {
            Mode::Moving(phase) => Cow::Borrowed(&self.phases[phase].guards),
            Mode::Held(hold) => {
                let since = &self.course.departure;
                let forcing = since.forcing.value() + self.phases.amplitude * since.drive.cos;
                Cow::Owned(self.phases.release_guards(hold, since.position, forcing))
            }
            Mode::Chattering(_) => Cow::Borrowed(&[]),
        }
    }

    /// Ends a Taylor step, or a row of summed bounces, and begins what follows.
    pub(super) fn end_step(&mut self, elapsed: f64, observer: &mut dyn Observer) {
        let drive = self.end_arc(elapsed, None, observer);
        let Mode::Chattering(hold) = self.mode else {
            return self.next_step(elapsed, drive);
        };
        let position = self.course.departure.position;
        let speed = self.course.chatter().map_or(0.0, |chatter| chatter.speed);
        let mode = self
            .phases
            .mode_from_rest(hold, position, self.forcing_per_mass(drive));
        let rest = Reset::new(position, 0.0, mode, CrossingKind::Rest);
        self.begin_after_reset(rest, Start::new(position, speed), drive, observer);
    }

    /// Ends the present arc, in the state that a crossing tells, tells the observer of it, and lets the next one begin
    /// there: the drive at that instant.
    fn end_arc(
        &mut self,
        elapsed: f64,
        state: Option<Start>,
        observer: &mut dyn Observer,
    ) -> DriveAngle {
        let at = self.clock.after(self.start, elapsed);
        let drive = self.clock.drive(at);
        let end = state.map(|state| (elapsed, state, drive));
        observer.arc(&Arc { end, ..self.arc() }, elapsed);
        self.force.next_arc(&self.clock, at, elapsed);
        (self.start, self.now) = (at, at);
        drive
    }

    /// The next Taylor step, from the very place at which the last one ended.
    fn next_step(&mut self, elapsed: f64, drive: DriveAngle) {
        let (position, velocity) = self.course.state_at(elapsed, drive);
        let finer = self
            .course
            .taylor_step()
            .map(|last| last.fine_position_at(elapsed));
        let (position, finer) = match (self.phase(), finer) {
            (Some(phase), Some(finer)) if phase.hertz.is_none() => confine(phase, position, finer),
            _ => (position, finer),
        };
        let state = Start::new(position, velocity);
        let departure = self.arc_departure(state, drive, self.mode, None);
        self.begin_course(departure, self.mode, finer, None);
    }

    /// Ends the arc at a crossing and begins the next one.
    pub(super) fn pass_crossing(&mut self, found: FoundCrossing, observer: &mut dyn Observer) {
        // A mass that leaves rest and is back at once has not moved.
        let moved = self.course.departure.velocity != 0.0 || !self.is_instant(found.elapsed);
        let velocity = match self.mode {
            Mode::Moving(phase) => self.phases.crossing_velocity(phase, &found),
            Mode::Held(_) | Mode::Chattering(_) => found.velocity,
        };
        let before = Start::new(found.position, velocity);
        let drive = self.end_arc(found.elapsed, Some(before), observer);
        if let Some(surface) = self.endless_surface(found.guard) {
            self.bounce_train.count_crossing(surface, found.velocity);
        }
        let landing = self.reset_after(&found, self.forcing_per_mass(drive), moved);
        self.update_pierced(landing.kind);
        self.begin_after_reset(landing, before, drive, observer);
    }

    /// Begins the arc after a reset, and tells of the crossing.
    fn begin_after_reset(
        &mut self,
        landing: Reset,
        before: Start,
        drive: DriveAngle,
        observer: &mut dyn Observer,
    ) {
        let (forcing, after) = (self.forcing_per_mass(drive), landing.state);
        let acceleration_before = self.acceleration_in(self.mode, before, forcing);
        match landing.chatter {
            Some(chatter) => {
                let departure = self.arc_departure(after, drive, landing.mode, None);
                self.begin_course(departure, landing.mode, None, Some(chatter));
            }
            None => self.begin_arc(after, drive, landing.mode),
        }
        observer.crossing(&Crossing {
            instant: self.start,
            kind: landing.kind,
            position: after.position,
            velocity: before.velocity,
            velocity_after: after.velocity,
            acceleration_before,
            acceleration_after: self.acceleration_in(landing.mode, after, forcing),
        });
    }
}

/// The place between two steps of a linear phase: within its surfaces, so that none is passed unseen by rounding.
fn confine(phase: &Phase, position: f64, finer: FinePosition) -> (f64, Option<FinePosition>) {
    let beside = if finer.low > 0.0 {
        position.next_up()
    } else if finer.low < 0.0 {
        position.next_down()
    } else {
        position
    };
    let inside = phase.confine_position(beside) == beside;
    (phase.confine_position(position), inside.then_some(finer))
}
