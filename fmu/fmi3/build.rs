//! Links the unwinder of GCC into the library, so that it needs nothing but the C library.
//!
//! The standard library asks for `libgcc_s.so.1`, which machines without a compiler may lack. A
//! linker script of that name, found first, leads to the static half of GCC's runtime instead.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

const ARCHIVE: &str = "libgcc_eh.a";

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=Cargo.toml");
    let is = |name: &str, value: &str| env::var(name).is_ok_and(|found| found == value);
    if !(is("CARGO_CFG_TARGET_OS", "linux") && is("CARGO_CFG_TARGET_ENV", "gnu")) {
        return Ok(());
    }
    // For other machines the linker brings its own unwinder.
    if env::var("HOST") != env::var("TARGET") || unwinder().is_none() {
        return Ok(());
    }
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(folder.join("libgcc_s.so"), "INPUT(-lgcc_eh -lgcc)\n")?;
    println!("cargo::rustc-cdylib-link-arg=-L{}", folder.display());
    Ok(())
}

/// Where the C compiler keeps the static unwinder, if it has one.
fn unwinder() -> Option<PathBuf> {
    let output = Command::new("cc")
        .arg(format!("-print-file-name={ARCHIVE}"))
        .output()
        .ok()?;
    let path = String::from_utf8(output.stdout).ok()?;
    let path = Path::new(path.trim());
    path.is_absolute().then(|| path.to_owned())
}
