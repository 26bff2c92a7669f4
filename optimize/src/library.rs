//! The library of every FMU that this program writes.

use anyhow::{Result, ensure};
use softstop_fmu::package::{HOST_PLATFORM, Library};

/// Compiled along with this program, from the same engine.
static BYTES: &[u8] = include_bytes!(env!("SOFTSTOP_FMU_LIBRARY"));

/// The FMU's library for this machine.
///
/// # Errors
/// If this program was built without it.
pub fn library() -> Result<Library> {
    ensure!(
        !BYTES.is_empty(),
        "cannot make the FMU: this program was built without its library; build it with `cargo build` \
         or `cargo install --path optimize` in the folder of its source"
    );
    Ok(Library {
        platform: HOST_PLATFORM.to_owned(),
        bytes: BYTES.to_vec(),
    })
}
