//! Bounces without end: when they count as rest.

use serde::{Deserialize, Serialize};

use crate::phases::{RestThreshold, SurfaceId};

/// Restitution above which bounces shrink by viscous damping rather than by the impacts: they then come
/// to no end in finite time, as those on a preloaded stop, and in too many impacts for lanes.
pub const MAX_RESTITUTION: f64 = 1.0 - 1.0 / (1u64 << 16) as f64;

/// A row of bounces: crossings of one and the same surface, reversals left out, none of them twice as fast as one before it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct BounceTrain {
    surface: SurfaceId,
    crossings: u32,
    /// Highest and lowest speed in the row, in m/s.
    fastest: f64,
    slowest: f64,
}

impl Default for BounceTrain {
    fn default() -> Self {
        Self {
            surface: SurfaceId::default(),
            crossings: 0,
            fastest: 0.0,
            slowest: f64::INFINITY,
        }
    }
}

/// Crossings in a row after which faint bounces are no longer followed. At a preloaded stop that is
/// pressed with less than its preload, bounces shrink only by viscous damping: their number grows
/// beyond all bounds as their height goes to zero.
const MAX_FOLLOWED_BOUNCES: u32 = 10_000;

impl BounceTrain {
    /// Counts a crossing of a surface.
    pub fn count_crossing(&mut self, surface: SurfaceId, velocity: f64) {
        let speed = velocity.abs();
        if surface != self.surface || speed > 2.0 * self.slowest {
            *self = Self {
                surface,
                ..Self::default()
            };
        }
        self.crossings = self.crossings.saturating_add(1);
        self.fastest = self.fastest.max(speed);
        self.slowest = self.slowest.min(speed);
    }

    /// The bounces that count as rest after this row.
    pub fn rest_threshold(&self) -> RestThreshold {
        if self.crossings < MAX_FOLLOWED_BOUNCES {
            return RestThreshold::ROUNDING;
        }
        let length = f64::from(self.crossings) / f64::from(MAX_FOLLOWED_BOUNCES);
        // Heights shrink with the square of the length: so the train ends after some millions of crossings at the latest.
        let faint = 1e-11 * length * length;
        RestThreshold {
            height: faint,
            slowest: faint.sqrt() * self.fastest,
        }
    }
}
