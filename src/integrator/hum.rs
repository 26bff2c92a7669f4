//! Bounces without end: when they count as rest.

use crate::phases::SPACING;

/// Crossings of one and the same surface in a row, reversals left out.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Hum {
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
    /// Counts a crossing.
    pub fn count(&mut self, surface: usize) {
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
    pub fn resolution(&self) -> f64 {
        if self.crossings < HUM_CROSSINGS {
            SPACING
        } else {
            HUM_HEIGHT
        }
    }
}
