//! Bounces without end: when they count as rest.

use crate::phases::Threshold;

/// Crossings of one and the same surface in a row, reversals left out.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Hum {
    surface: usize,
    crossings: u32,
    /// Highest speed in the row, in m/s.
    fastest: f64,
}

/// Crossings in a row after which faint bounces are no longer followed. At a preloaded stop that is
/// pressed with less than its preload, bounces shrink only by viscous damping: their number grows
/// beyond all bounds as their height goes to zero.
const PATIENCE: u32 = 10_000;
/// Height of a bounce, relative to the highest of the row and to the position of the surface, that
/// then counts as rest. It grows with the square of the row's length, as heights shrink with it: so
/// the row ends after some millions of crossings at the latest.
const FAINT: f64 = 1e-11;

impl Hum {
    /// Counts a crossing.
    pub fn count(&mut self, surface: usize, velocity: f64) {
        if surface != self.surface {
            *self = Self {
                surface,
                ..Self::default()
            };
        }
        self.crossings = self.crossings.saturating_add(1);
        self.fastest = self.fastest.max(velocity.abs());
    }

    /// What counts as rest after this row.
    pub fn threshold(&self) -> Threshold {
        if self.crossings < PATIENCE {
            return Threshold::ROUNDING;
        }
        let length = f64::from(self.crossings) / f64::from(PATIENCE);
        let faint = FAINT * length * length;
        Threshold {
            height: faint,
            slowest: faint.sqrt() * self.fastest,
        }
    }
}
