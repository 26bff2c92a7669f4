//! Time without drift: whole drive periods are counted, only the rest is a fraction.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::flow::DriveAngle;
use crate::scene::Scene;

/// 2 pi - TAU: the part of 2 pi that the double lacks.
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// A time: `cycles` whole drive periods and `offset` seconds, 0 <= offset < period.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Instant {
    /// Whole periods since time 0 (an integer; exact up to 2^53).
    pub cycles: f64,
    /// Seconds into the present period.
    pub offset: f64,
}

/// Counts drive periods. The drive angle depends on the offset alone, so that after any number of
/// periods it is as accurate as in the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    frequency: f64,
    /// Drive angle at time 0 in rad.
    pub phase: f64,
    period: f64,
    period_low: f64,
}

impl Scene {
    /// The clock of its drive.
    pub fn clock(&self) -> Clock {
        Clock::new(self.excitation.frequency, self.excitation.reduced_phase())
    }
}

impl Clock {
    /// The clock of the drive cos(`frequency` t + `phase`).
    pub fn new(frequency: f64, phase: f64) -> Self {
        let period = TAU / frequency;
        let rest = (-period).mul_add(frequency, TAU) + TAU_LOW;
        Self {
            frequency,
            phase,
            period,
            period_low: rest / frequency,
        }
    }

    /// The drive period in s.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Time in s that is too short for the clock to tell two instants apart.
    pub(super) fn resolution(&self) -> f64 {
        64.0 * f64::EPSILON * self.period()
    }

    /// The instant `time` seconds after time 0.
    pub fn instant(&self, time: f64) -> Instant {
        self.after(Self::at_cycle(0), time)
    }

    /// The instant at which `cycles` periods are complete.
    pub fn at_cycle(cycles: u64) -> Instant {
        Instant {
            cycles: cycles as f64,
            offset: 0.0,
        }
    }

    /// Seconds of the clock since time 0.
    pub fn time(&self, at: Instant) -> f64 {
        at.cycles
            .mul_add(self.period, at.cycles.mul_add(self.period_low, at.offset))
    }

    /// The instant `elapsed` seconds after `from`.
    #[inline]
    pub fn after(&self, from: Instant, elapsed: f64) -> Instant {
        let offset = from.offset + elapsed;
        if offset >= 0.0 && offset < self.period {
            return Instant { offset, ..from };
        }
        if offset >= self.period && offset < 2.0 * self.period {
            // Exact by Sterbenz, apart from the part of the period below its last digit.
            let offset = (offset - self.period - self.period_low).max(0.0);
            return Instant {
                cycles: from.cycles + 1.0,
                offset,
            };
        }
        self.carry_periods(from.cycles, offset)
    }

    /// The instant with whole periods carried from the offset into the cycles.
    fn carry_periods(&self, cycles: f64, offset: f64) -> Instant {
        let mut whole = (offset / self.period).floor();
        let mut offset = (-whole).mul_add(self.period, offset) - whole * self.period_low;
        if offset < 0.0 {
            (whole, offset) = (whole - 1.0, offset + self.period);
        }
        // What lacks less than one unit in the last place has been rounded up to the period itself.
        if offset >= self.period {
            (whole, offset) = (whole + 1.0, offset - self.period);
        }
        Instant {
            cycles: cycles + whole,
            offset,
        }
    }

    /// Seconds of the clock from one instant to another.
    #[inline]
    pub fn elapsed(&self, from: Instant, to: Instant) -> f64 {
        let cycles = to.cycles - from.cycles;
        if cycles == 0.0 {
            to.offset - from.offset
        } else {
            cycles * self.period + (to.offset - from.offset + cycles * self.period_low)
        }
    }

    /// The drive angle at an instant of the clock.
    #[inline]
    pub fn drive(&self, at: Instant) -> DriveAngle {
        DriveAngle::at(self.frequency * at.offset + self.phase)
    }
}
