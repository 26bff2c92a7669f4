//! The strokes that a motion misses, and the motion through a gap of missing strips.

use std::ops::ControlFlow;

use crate::monitor::stop_if;
use softstop::internals::Motion;
use softstop::{CheckedScene, Crossing, Instant, MotionError, Observer};

/// Counts the strokes that a motion misses: an impact that comes n drive periods after the last one and not one has
/// missed n - 1, whatever the drive angles at which they come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeCount {
    last: f64,
    missed: u64,
}

impl StrokeCount {
    /// The count from an impact on, at a time in drive periods.
    pub const fn after_impact(impact: f64) -> Self {
        Self {
            last: impact,
            missed: 0,
        }
    }

    /// Counts the strokes missed before an impact at a time in drive periods.
    pub fn record_impact(&mut self, time: f64) {
        self.missed = self.missed_strokes(time);
        self.last = time;
    }

    /// Strokes missed up to a time in drive periods.
    pub fn missed_strokes(&self, time: f64) -> u64 {
        self.missed + ((time - self.last).round() as u64).saturating_sub(1)
    }
}

/// Counts the strokes of a motion, and stops it where the mass leaves strip or stop.
pub(crate) struct StrokeObserver<'a> {
    pub clearance: f64,
    /// The drive period in s.
    pub period: f64,
    pub strokes: &'a mut StrokeCount,
    /// Whether the motion stops where the mass leaves strip or stop.
    pub stops: bool,
    /// True once it has left them.
    pub left: bool,
}

impl Observer for StrokeObserver<'_> {
    fn crossing(&mut self, crossing: &Crossing) {
        self.left |= crossing.position == self.clearance && crossing.velocity_after < 0.0;
        if crossing.kind.is_impact() {
            let Instant { cycles, offset } = crossing.instant;
            self.strokes.record_impact(cycles + offset / self.period);
        }
    }

    fn progress(&mut self, _: u64) -> ControlFlow<()> {
        stop_if(self.stops && self.left)
    }
}

/// Drive periods for which the mass may stay beyond the clearance before strips change all the same.
const MAX_PERIODS_BEYOND: u64 = 16;

/// A motion through a gap of missing strips, with time in drive periods from where the gap began.
pub(crate) struct InterruptedMotion {
    pub motion: Motion,
    pub clearance: f64,
    /// The instant at which the gap begins.
    pub begin: Instant,
    /// Drive periods that are complete since then.
    pub periods: u64,
    /// Its strokes, by times since the orbit's time 0.
    pub strokes: StrokeCount,
}

impl InterruptedMotion {
    /// Goes on with the scene with or without strips, from where the mass is clear of them.
    pub fn switch_strips(&mut self, to: &CheckedScene) -> Result<(), MotionError> {
        let last = self.periods + MAX_PERIODS_BEYOND;
        while self.motion.state().position >= self.clearance && self.periods < last {
            if self.advance_period(true)? {
                break;
            }
        }
        self.motion = Motion::new(to, self.motion.now(), self.motion.state())?;
        Ok(())
    }

    /// Advances by a drive period, or, if that `stops` it, to where the mass leaves strip or stop: true then.
    pub fn advance_period(&mut self, stops: bool) -> Result<bool, MotionError> {
        let cycles = self.begin.cycles + (self.periods + 1) as f64;
        let left = self.count_strokes(
            Instant {
                cycles,
                ..self.begin
            },
            stops,
        )?;
        self.periods += u64::from(!left);
        Ok(left)
    }

    /// Advances the motion with missing strips and counts its strokes; true if it stopped as strip or stop was left.
    pub fn count_strokes(&mut self, until: Instant, stops: bool) -> Result<bool, MotionError> {
        let mut watch = StrokeObserver {
            clearance: self.clearance,
            period: self.motion.clock().period(),
            strokes: &mut self.strokes,
            stops,
            left: false,
        };
        Ok(self.motion.watch(until, &mut watch)?.is_break())
    }
}
