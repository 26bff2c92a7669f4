//! Monitors of long work, which watch and stop it.

use std::ops::ControlFlow;

pub(crate) use crate::memory::PIECE_DURATION;
pub use crate::memory::{Memory, OptionalMemory, recall_or_compute, to_bytes};

/// A function that is told how much of some work is done, and of how much at most, and says whether the work goes on.
pub type Monitor<'a> = &'a (dyn Fn(u64, u64) -> ControlFlow<()> + Sync);

/// A [`Monitor`] that never stops the work.
pub fn unmonitored(_: u64, _: u64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The answer of a monitor that breaks if a condition holds, and continues otherwise.
pub fn stop_if(holds: bool) -> ControlFlow<()> {
    match holds {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}
