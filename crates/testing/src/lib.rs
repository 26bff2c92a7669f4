//! What the tests of all rooms share: random machines, reference data, scenes, differences and programs.

#[cfg(target_os = "linux")]
mod faults;
pub mod machines;
pub mod meets;
pub mod pages;
mod program;
pub mod random;
pub mod reference;
pub mod scenes;
mod signals;
pub mod tangent;
pub mod tolerance;

use std::path::{Path, PathBuf};

pub use machines::{machines, start_below};
pub use meets::Meets;
pub use program::{Program, words};
pub use random::cases;
pub use scenes::{loaded, unloaded};

/// A file of `docs`.
pub fn docs(name: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs")).join(name)
}

/// Makes a test of each example, which holds what it asserts: name and path, relative to the file of the call.
#[macro_export]
macro_rules! examples {
    ($($name:ident: $path:literal),*) => {
        $(
            #[path = $path]
            mod $name;
        )*
        $(
            #[test]
            fn $name() -> Result<(), Box<dyn std::error::Error>> {
                $name::main()
            }
        )*
    };
}
