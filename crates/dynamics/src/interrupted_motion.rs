//! The motion of a loaded machine through a gap of missing strips.

use crate::stroke_count::StrokeCount;
use crate::stroke_observer::StrokeObserver;
use softstop::internals::Motion;
use softstop::{CheckedScene, Instant, MotionError};

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
