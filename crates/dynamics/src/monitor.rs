//! One way to watch long work, to stop it, and to take it up again.

use std::ops::ControlFlow;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;
use softstop::internals::budget;

/// Told how much is done, and of how much at most; asked whether to go on.
pub type Monitor<'a> = &'a (dyn Fn(u64, u64) -> ControlFlow<()> + Sync);

/// A [`Monitor`] that lets everything pass.
pub fn unmonitored(_: u64, _: u64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Stops if something holds.
pub fn stop_if(holds: bool) -> ControlFlow<()> {
    match holds {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    }
}

/// Keeps finished pieces of long work for the day on which it is taken up again.
pub trait Memory: Sync {
    /// The piece under this key, if it is known.
    fn recall(&self, key: &[u8]) -> Option<Vec<u8>>;
    /// Keeps a piece.
    fn keep(&self, key: &[u8], piece: &[u8]);
}

/// Where pieces are kept, if anywhere.
pub type Kept<'a> = Option<&'a dyn Memory>;

/// How long work takes whose result is kept as a piece.
pub(crate) const PIECE: Duration = Duration::from_millis(250);

/// A piece of work: recalled if it is known, else done now and kept, unless the [`budget`] is spent by then. It must
/// follow from its key. What it costs is charged in both cases.
///
/// # Errors
/// Those of the work, which is not kept then.
pub fn piece<T: Serialize + DeserializeOwned, E>(
    kept: Kept<'_>,
    key: &impl Serialize,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let Some((memory, key)) = kept.zip(rmp_serde::to_vec(key).ok()) else {
        return work();
    };
    let known = memory.recall(&key);
    if let Some((cost, known)) = known.and_then(|bytes| rmp_serde::from_slice(&bytes).ok()) {
        budget::charge(cost);
        return Ok(known);
    }
    let before = budget::windows_left();
    let done = work()?;
    let left = budget::windows_left();
    if left > 0
        && let Ok(bytes) = rmp_serde::to_vec(&(before - left, &done))
    {
        memory.keep(&key, &bytes);
    }
    Ok(done)
}
