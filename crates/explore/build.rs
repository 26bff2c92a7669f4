//! Puts the engine of the explorer's page into the program if `cargo xtask explorer` has built it and nothing that it is
//! built from has changed since; otherwise an empty file stands in for it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;
use std::{env, fs, io};

const SOURCES: [&str; 5] = [
    "../../src",
    "../lanes/src",
    "../dynamics/src",
    "../explorer/src",
    "../../Cargo.lock",
];

fn main() -> io::Result<()> {
    let sources = SOURCES.iter().map(Path::new).filter(|it| it.exists());
    for place in sources.clone().chain([Path::new("assets/explorer")]) {
        println!("cargo::rerun-if-changed={}", place.display());
    }
    let built = Path::new("assets/explorer/engine.wasm.gz");
    let is_fresh = changed(built) > sources.filter_map(changed).max();
    let engine = if is_fresh {
        fs::read(built)?
    } else {
        Vec::new()
    };
    let own = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(own.join("engine.wasm.gz"), engine)
}

/// When a file was changed last, or the youngest one of a folder.
fn changed(path: &Path) -> Option<SystemTime> {
    match fs::read_dir(path) {
        Ok(entries) => entries.flatten().filter_map(|it| changed(&it.path())).max(),
        Err(_) => fs::metadata(path).ok()?.modified().ok(),
    }
}
