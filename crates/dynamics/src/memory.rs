//! Stores of finished pieces of long work, by which interrupted work is resumed.

use std::io;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;
use softstop::internals::budget;

/// A store of finished pieces of long work.
pub trait Memory: Sync {
    /// The stored piece under this key, if there is one.
    fn recall_piece(&self, key: &[u8]) -> Option<Vec<u8>>;
    /// Stores a piece under a key.
    fn store_piece(&self, key: &[u8], piece: &[u8]);
}

/// The store of finished pieces, if there is one.
pub type OptionalMemory<'a> = Option<&'a dyn Memory>;

/// Computing time after which a part of long work is stored as one piece.
pub(crate) const PIECE_DURATION: Duration = Duration::from_millis(250);

/// The bytes of a key or a piece of work as a [`Memory`] stores them, in CBOR (RFC 8949).
///
/// # Errors
/// If the value refuses to be written.
pub fn to_bytes(value: &impl Serialize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    ciborium::into_writer(value, &mut bytes).map_err(io::Error::other)?;
    Ok(bytes)
}

/// The result of a piece of work: recalled if it is stored under its key, else computed and stored, unless the [`budget`] is
/// spent by then. It must follow from its key. What it costs is charged in both cases.
///
/// # Errors
/// Those of the work, which is not kept then.
pub fn recall_or_compute<T: Serialize + DeserializeOwned, E>(
    kept: OptionalMemory<'_>,
    key: &impl Serialize,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let Some((memory, key)) = kept.zip(to_bytes(key).ok()) else {
        return work();
    };
    let known = memory.recall_piece(&key);
    if let Some((cost, known)) = known.and_then(|bytes| ciborium::from_reader(&*bytes).ok()) {
        budget::charge(cost);
        return Ok(known);
    }
    let before = budget::windows_left();
    let done = work()?;
    let left = budget::windows_left();
    if left > 0
        && let Ok(bytes) = to_bytes(&(before - left, &done))
    {
        memory.store_piece(&key, &bytes);
    }
    Ok(done)
}
