//! Stops a motion right before a crossing, and lets the crossing happen when it is told to.

use std::ops::ControlFlow;

use super::clock::Instant;
use super::motion::Motion;
use super::simulation::{Checkpoint, CheckpointState, Simulation};
use super::{Effort, Observer};
use crate::error::MotionError;
use crate::events::NextEvent;
use crate::phases::Mode;

/// Most crossings at one instant that happen together; those of a longer row follow when they are told to.
const MAX_CROSSINGS_TOGETHER: u32 = 1000;

impl Motion {
    /// When the crossing happens that ends the present arc, as far as it is known.
    pub(super) fn next_crossing(&self) -> Option<Instant> {
        let elapsed = match (self.outlook, self.mode) {
            (NextEvent::Crossing(found), _) => found.elapsed,
            (NextEvent::Ends(elapsed), Mode::Chattering(_)) => elapsed,
            _ => return None,
        };
        Some(self.clock.after(self.start, elapsed))
    }

    /// True if a crossing happens at the present time that has not happened yet.
    pub(super) fn is_at_crossing(&self) -> bool {
        self.next_crossing() == Some(self.now)
    }

    /// Lets the crossing happen that the motion stands before.
    fn pass_pending_crossing(&mut self, observer: &mut dyn Observer) {
        match self.outlook {
            NextEvent::Crossing(found) => self.pass_crossing(found, observer),
            NextEvent::Ends(elapsed) => self.end_step(elapsed, observer),
            _ => {}
        }
    }

    /// Advances to where another motion is that has begun as this one, but for rounding: if that one stands at a crossing, this
    /// one stops right before it or lets it happen, as that one did.
    pub(crate) fn advance_like(
        &mut self,
        other: &Self,
        observer: &mut dyn Observer,
    ) -> Result<(), MotionError> {
        let (clock, now, near) = (self.clock, other.now, self.clock.resolution());
        let is_now = |at: Instant| clock.elapsed(at, now).abs() <= near;
        if !other.is_at_crossing() && !is_now(other.start) {
            return self.advance(now, observer);
        }
        let (halt, end) = (clock.after(now, -near), clock.after(now, near));
        while self.watch_before(end, Some(halt), observer)?.is_break() {
            let has_crossed = is_now(self.start) && self.mode == other.mode;
            if other.is_at_crossing() || has_crossed {
                break;
            }
            self.pass_pending_crossing(observer);
        }
        self.now = now;
        Ok(())
    }
}

impl Simulation {
    /// True if the machine stands right before a crossing.
    pub fn is_at_crossing(&self) -> bool {
        self.motion.is_at_crossing()
    }

    /// How far in s a crossing may lie beyond a time in s that is reached from now on, to happen at that time.
    pub(super) fn rounding_at(&self, time: f64) -> f64 {
        8.0 * f64::EPSILON * time.abs().max(time - self.now)
    }

    /// Advances as [`Simulation::watch`], but stops right before the first crossing that does not happen before the time
    /// `halt` in s; [`Simulation::cross`] lets it happen. One that is after `until` by rounding alone counts as before it.
    ///
    /// # Errors
    /// As [`Simulation::advance`].
    pub fn watch_before(
        &mut self,
        until: f64,
        halt: Option<f64>,
        observer: &mut dyn Observer,
    ) -> Result<ControlFlow<()>, MotionError> {
        self.check_reach(until)?;
        let clock = *self.motion.clock();
        let instant = clock.instant(until - self.epoch);
        let before = self.motion.now();
        let (mut end, mut last, mut stop) = (instant, until, None);
        if let Some(halt) = halt {
            let rounding = self.rounding_at(until);
            (end, last) = (clock.after(instant, rounding), until + rounding);
            stop = Some(clock.instant(halt - rounding - self.epoch));
        }
        // Equal times may be written as instants that differ in the last digit.
        if instant <= before || self.motion.advance_if_clear(end)? {
            if halt.is_some() && instant > before {
                self.motion.now = instant;
            }
            self.checkpoint = Checkpoint::OnArc(before);
            self.now = until;
            return Ok(ControlFlow::Continue(()));
        }
        let origin = CheckpointState {
            motion: self.motion.clone(),
            counts: self.counts,
            now: self.now,
        };
        let origin = Box::write(Box::new_uninit(), origin);
        let mut tallies = self.counts.observer(self.scene.mass);
        let mut observers = (&mut tallies, observer);
        match self.motion.watch_before(end, stop, &mut observers) {
            Ok(flow) => {
                self.checkpoint = Checkpoint::Before(origin);
                self.now = if flow.is_continue() {
                    if halt.is_some() && instant > self.motion.start {
                        self.motion.now = instant;
                    }
                    until
                } else {
                    self.time_of(self.motion.now()).clamp(self.now, last)
                };
                Ok(flow)
            }
            Err(error) => {
                (self.motion, self.counts) = (origin.motion, origin.counts);
                Err(error)
            }
        }
    }

    /// Lets the crossing happen that the machine stands before, with those that follow at the same instant; false if it
    /// stands before none. A motion that fails right after it fails in the next step.
    pub fn cross(&mut self, observer: &mut dyn Observer) -> bool {
        if !self.motion.is_at_crossing() {
            return false;
        }
        if let Checkpoint::OnArc(now) = self.checkpoint {
            let motion = Motion {
                now,
                ..self.motion.clone()
            };
            self.checkpoint = Checkpoint::Before(Box::new(CheckpointState {
                motion,
                counts: self.counts,
                now: self.time_of(now),
            }));
        }
        let mut tallies = self.counts.observer(self.scene.mass);
        let mut observers = (&mut tallies, observer);
        let now = self.motion.now;
        let near = self.motion.clock.after(now, self.motion.clock.resolution());
        for _ in 0..MAX_CROSSINGS_TOGETHER {
            self.motion.pass_pending_crossing(&mut observers);
            let next = self.motion.watch_before(near, Some(now), &mut observers);
            if !matches!(next, Ok(ControlFlow::Break(()))) {
                break;
            }
        }
        self.motion.now = self.motion.start;
        true
    }

    /// When the next crossing happens, in s, if that is not after `until` and found within an effort.
    pub fn next_crossing(&self, until: f64, effort: Effort) -> Option<f64> {
        let (mut motion, mut effort) = (self.motion.clone(), effort);
        let (instant, now) = (motion.clock.instant(until - self.epoch), motion.now);
        let outcome = motion.watch_before(instant, Some(now), &mut effort);
        let found = matches!(outcome, Ok(ControlFlow::Break(()))) && motion.is_at_crossing();
        found.then(|| self.time_of(motion.now).max(self.now))
    }
}
