//! The points of a study, by their global index: what its axes are there, and which machine that is.

use std::ops::Range;

use softstop::Machine;

use super::file::Study;
use super::values::{Draw, share};

/// Points of a block.
pub(super) const BLOCK: u64 = 1024;

impl Study {
    /// How many blocks there are.
    pub(super) fn blocks(&self) -> u64 {
        self.points.div_ceil(BLOCK)
    }

    /// The points of a block.
    pub(super) fn block(&self, block: u64) -> Range<u64> {
        block * BLOCK..((block + 1) * BLOCK).min(self.points)
    }

    /// Tells the values of all axes at a point, each with the axis's number: the first axis changes slowest, samples
    /// fastest.
    pub(super) fn each_value(&self, point: u64, mut tell: impl FnMut(usize, f64)) {
        let samples = self.samples.unwrap_or(1);
        let (mut rest, sample) = (point / samples, point % samples);
        let mut dimension = [0; 2];
        for (number, axis) in self.axes.iter().enumerate() {
            if let Some(draw) = axis.draw() {
                let dimension = &mut dimension[usize::from(draw == Draw::Sobol)];
                tell(
                    number,
                    axis.drawn(share(draw, self.seed, sample, *dimension)),
                );
                *dimension += 1;
            }
        }
        for (number, axis) in self.axes.iter().enumerate().rev() {
            if let Some(count) = axis.values.count() {
                tell(number, axis.values.at(rest % count));
                rest /= count;
            }
        }
    }

    /// The machine at a point.
    pub fn machine_at(&self, point: u64) -> Machine {
        let mut machine = self.wordless.clone();
        self.each_value(point, |axis, value| {
            self.axes[axis].set(&mut machine, value)
        });
        machine
    }
}
