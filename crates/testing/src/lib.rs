//! What the tests of all rooms share: random machines, reference data, scenes, differences and programs.

pub mod machines;
mod program;
pub mod random;
pub mod reference;
pub mod scenes;
pub mod tangent;

use std::path::{Path, PathBuf};

pub use machines::{machines, start_below};
pub use program::Program;
pub use random::cases;

/// A file of `docs`.
pub fn docs(name: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs")).join(name)
}
