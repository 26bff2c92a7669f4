//! What the tests of all rooms share: random machines, reference data, scenes, differences and programs.

#[cfg(target_os = "linux")]
mod faults;
pub mod machines;
pub mod meets;
mod near;
pub mod pages;
mod program;
pub mod random;
pub mod reference;
pub mod report;
pub mod scenes;
mod session;
mod signals;
pub mod tangent;
pub mod tolerance;

use std::path::{Path, PathBuf};

pub use machines::{machines, start_below, start_between, two_sided};
pub use meets::Meets;
pub use near::{assert_near, assert_relative, is_near};
pub use program::{Program, files, kill, words};
pub use random::cases;
pub use report::{Report, has_near, number, number_in, table, with_folders};
pub use scenes::{
    hertz, kelvin_voigt, loaded, piercing, preloaded, rigid_stop, slope, units, unloaded,
    with_changes,
};

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
