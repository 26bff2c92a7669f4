//! Puts a C library that Cargo links for a dependency into the crate that depends on it.

use std::env;
use std::path::{Path, PathBuf};

use proc_macro::TokenStream;

/// The bytes of the C library of a dependency, named by its crate. They are none where Cargo links no library: in `cargo check`
/// and `cargo doc`, and for systems without shared libraries.
///
/// Cargo tells the compiler where the Rust library of a dependency is (`--extern NAME=PATH`); the C library lies beside it.
/// No build script can find it: scripts run before libraries are linked, and those of packages from a registry have a hash in
/// their names.
#[proc_macro]
pub fn c_library(name: TokenStream) -> TokenStream {
    let expression = match find(&name.to_string()) {
        Some(path) => format!("include_bytes!({path:?})"),
        None => "&[]".to_owned(),
    };
    expression.parse().unwrap_or_default()
}

fn find(name: &str) -> Option<PathBuf> {
    let path_of = |argument: String| {
        argument
            .strip_prefix(name)?
            .strip_prefix('=')
            .map(PathBuf::from)
    };
    let rust_library = env::args_os()
        .filter_map(|it| path_of(it.into_string().ok()?))
        .find(|it| it.extension().is_some_and(|it| it == "rlib"))?;
    let unix_name = rust_library.file_stem()?.to_str()?;
    let windows_name = unix_name.strip_prefix("lib")?;
    let names = [
        format!("{unix_name}.so"),
        format!("{unix_name}.dylib"),
        format!("{windows_name}.dll"),
    ];
    let folder = rust_library.parent().unwrap_or(Path::new(""));
    names
        .map(|it| folder.join(it))
        .into_iter()
        .find(|it| it.exists())
}
