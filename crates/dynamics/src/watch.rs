//! One way to watch long work and to stop it.

use std::ops::ControlFlow;

/// Told how much is done, and of how much at most; asked whether to go on.
pub type Watcher<'a> = &'a (dyn Fn(u64, u64) -> ControlFlow<()> + Sync);

/// A [`Watcher`] that lets everything pass.
pub fn unwatched(_: u64, _: u64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Stops if something holds.
pub fn stop_if(holds: bool) -> ControlFlow<()> {
    match holds {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}
