//! Tells the program where the libraries of its FMUs are, to hold them.
//!
//! Cargo links them into `deps` before it compiles the program. What only looks at the program's source
//! (`cargo check`, `cargo doc`) links nothing: there empty files stand in for them.

use std::fs::File;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::{env, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let own = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    // Of target/<profile>/build/softstop-<hash>/out.
    let profile = own.ancestors().nth(3).unwrap_or(Path::new(""));
    let (prefix, extension) = match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("windows") => ("", "dll"),
        Ok("macos") => ("lib", "dylib"),
        _ => ("lib", "so"),
    };
    for standard in ["fmi2", "fmi3"] {
        let name = format!("{prefix}softstop_{standard}.{extension}");
        let library = profile.join("deps").join(name);
        match File::create_new(&library) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(error),
            _ => println!(
                "cargo::rustc-env=SOFTSTOP_{}_LIBRARY={}",
                standard.to_uppercase(),
                library.display()
            ),
        }
    }
    Ok(())
}
