//! Tells the program where the library of its FMUs is, to hold it.
//!
//! Cargo links it into `deps` before it compiles the program. What only looks at the program's source
//! (`cargo check`, `cargo doc`) links nothing: there an empty file stands in for it.

use std::fs::File;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::{env, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let own = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    // Of target/<profile>/build/softstop-<hash>/out.
    let profile = own.ancestors().nth(3).unwrap_or(Path::new(""));
    let name = match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("windows") => "softstop_fmu.dll",
        Ok("macos") => "libsoftstop_fmu.dylib",
        _ => "libsoftstop_fmu.so",
    };
    let library = profile.join("deps").join(name);
    match File::create_new(&library) {
        Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(error),
        _ => println!(
            "cargo::rustc-env=SOFTSTOP_FMU_LIBRARY={}",
            library.display()
        ),
    }
    Ok(())
}
